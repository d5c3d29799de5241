"""Differential-drive simulation with real friction, and what recorded drives teach it."""

__version__ = '0.1.0'
