"""The inner loop: from wanted motion to wheel forces. Knows no clock and no message."""
