"""What follows from a structure that was chosen: errors, intervals, agreement, advice."""
