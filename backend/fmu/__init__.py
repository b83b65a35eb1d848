"""A scenario's controller or vehicle as an FMU for co-simulation: its program, numbers and description."""
