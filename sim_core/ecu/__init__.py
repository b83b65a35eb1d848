"""Hardware in the loop: a controller apart from the plant, which meets it through converters, with delay and losses.

`controller` measures, converts and waits, `calibration` holds what the ECU's program knows, `program` calls that
program, whose C (`source`) is part of the core's library. Who has it elsewhere hands the controller a connection to it.
"""
