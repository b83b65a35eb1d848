"""Hardware in the loop: a controller apart from the plant, which meets it through converters, with delay and losses.

`controller` measures, converts and waits, `calibration` holds what the ECU's program knows, `program` calls the program,
whose C (`source`) is part of the core's library. Whoever has the program elsewhere hands the controller a connection to it.
"""
