"""The core's C: what has to be done once for each step, sample or limit, and where it is loaded."""
