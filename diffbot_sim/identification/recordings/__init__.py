"""Runs as identification uses them: cut, thinned, timed, started."""
