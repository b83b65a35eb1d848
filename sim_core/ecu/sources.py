"""The C sources of the ECU's program."""

from pathlib import Path

SOURCES = Path(__file__).parent / "source"
CONTROLLER = ("ridelab_controller.c", "ridelab_dual.c")
