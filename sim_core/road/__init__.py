"""The road: its profile, measured ones, and what a sensor sees of it."""
