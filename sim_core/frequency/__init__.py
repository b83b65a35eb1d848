"""What the closed loop does by itself: its modes and whether it is stable."""
