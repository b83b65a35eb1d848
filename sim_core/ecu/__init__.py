"""Hardware in the loop: a controller apart from the plant, which meets it through converters, with delay and losses.

`loop` drives the plant, `calibration` holds what the ECU's program knows, `model` is the ECU in NumPy. The ECU itself
is C and lives in the service, which hands the loop a connection to it; the core does no input or output.
"""
