"""Forces that no effect accounts for, whatever their law."""
