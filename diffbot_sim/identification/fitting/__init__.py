"""Models fitted to recordings, and what their errors tell of small changes."""
