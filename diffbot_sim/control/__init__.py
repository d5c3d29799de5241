"""From wanted motion to wheel forces, and motions worth wanting. Knows no clock and no message."""
