"""The connection to an ECU in a process of its own: frame and answer in turn, over its standard input and output.

The process ends when the plant hangs up, whatever ended the plant.
"""

import socket
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from backend.command_error import CommandError
from backend.ecu import tables
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW
from sim_core.ecu.program import Ecu, Frame, Reply
from sim_core.vehicle.half_car import STATES

GREETING = b"RIDELAB2"
PATIENCE = 10.0  # the program has so long for an answer, on a busy machine [s]
END = 3.0  # and so long to end by itself [s]
LIMITED, UNFINISHED = 1, 2  # flags, ridelab_controller.h
_HELLO = struct.Struct("<8sI")
_ANSWER = struct.Struct("<IiiiIfI")


class EcuError(CommandError):
    """The ECU's program does not start, is another one or does not work."""


class ProcessEcu(Ecu):
    """An ECU at the other end of a socket."""

    def __init__(self, connection: socket.socket, calibration: Calibration) -> None:
        self._connection = connection
        self._answers = connection.makefile("rb")
        self._length = STATES + len(PREVIEW) * calibration.preview_length

    def greet(self, fingerprint: int) -> None:
        """Check whose tables the program says it has.

        Raises:
            EcuError: It has another scenario's tables, or is no such program.
        """
        greeting, theirs = self._receive(_HELLO)
        if greeting != GREETING:
            raise EcuError("That is not an ECU's program of Ridelab")
        if theirs != fingerprint:
            raise EcuError("The program has another scenario's tables")

    def exchange(self, frame: Frame) -> Reply:
        """Send a frame and wait for its answer.

        Raises:
            EcuError: No answer, or not one to this frame.
        """
        if len(frame.codes) != self._length:
            raise ValueError("A frame has as many codes as the tables say")
        with suppress(OSError):
            self._connection.sendall(struct.pack("<Ii", frame.step, frame.stage) + frame.codes.astype("<i4").tobytes())
        step, front, rear, flags, iterations, slack, operations = self._receive(_ANSWER)
        if step != frame.step or flags < 0 or not np.isfinite(slack):
            raise EcuError("The ECU's program answered what nobody asked")
        return Reply(
            commands=(front, rear),
            limited=bool(flags & LIMITED),
            iterations=iterations,
            unfinished=bool(flags & UNFINISHED),
            slack=slack,
            operations=operations,
        )

    def _receive(self, layout: struct.Struct) -> tuple[Any, ...]:
        try:
            content = self._answers.read(layout.size)
        except TimeoutError:
            raise EcuError(f"The ECU's program did not answer within {self._connection.gettimeout():g} s") from None
        except OSError:
            content = b""
        if len(content) < layout.size:
            raise EcuError("The ECU's program ended before the drive did")
        return layout.unpack(content)


@contextmanager
def connected(calibration: Calibration, program: Path, *, patience: float = PATIENCE) -> Iterator[ProcessEcu]:
    """Start a process of the ECU's program, ready for the first frame; it is ended afterwards.

    Args:
        calibration: Its tables.
        program: Its file, built from exported sources with these tables.
        patience: It has so long for an answer [s].

    Raises:
        EcuError: It does not start, or is not ours.
    """
    ours, theirs = socket.socketpair()
    with ours:
        with theirs:
            end = theirs.fileno()
            try:
                process = subprocess.Popen([program], stdin=end, stdout=end, stderr=subprocess.DEVNULL)  # noqa: S603  # our own program, no shell
            except OSError as error:
                raise EcuError(f"The ECU's program does not start ({error.strerror})") from None
        try:
            ours.settimeout(patience)
            ecu = ProcessEcu(ours, calibration)
            ecu.greet(tables.fingerprint(calibration))
            yield ecu
        finally:
            with suppress(OSError):
                ours.shutdown(socket.SHUT_RDWR)
            try:
                process.wait(END)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
