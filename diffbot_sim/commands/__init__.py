"""Offline commands, one file each: the docstring's first line is its help.

A command offers `add_arguments(parser)` and `run(arguments)`. Files that start with an
underscore are no commands.
"""
