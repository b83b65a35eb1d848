"""A scenario's controller or vehicle as an FMU for co-simulation: its C behind FMI, described and compiled."""
