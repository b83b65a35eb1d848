"""A drive recorded in a car: its signals, where it lies on a road, and its result beside those of simulated drives."""
