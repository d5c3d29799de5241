"""The errors of the paper, each with a demonstration, one file each."""
