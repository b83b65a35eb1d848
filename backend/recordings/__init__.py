"""Recorded drives: read from CSV, stored by content, shown as strategies beside the simulated ones."""
