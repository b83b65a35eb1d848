"""Hardware in the loop: the ECU's C program, built, connected to the plant, measured and exported."""
