"""Which effects of the library the recordings speak for."""
