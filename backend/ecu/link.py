"""The connection to an ECU in a process of its own: TCP on this machine, frame and answer in turn.

The plant listens on a port nobody knew before and gives a token to the one process it starts; whoever connects without
it is turned away. The process ends when the plant hangs up, whatever ended the plant.
"""

import hmac
import secrets
import socket
import struct
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np

from backend.ecu import build, tables
from backend.ecu.build import EcuError
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.vehicle.half_car import STATES

GREETING = b"RIDELAB1"
TOKEN = 32
START = 15.0  # the process has so long to connect, on a busy machine [s]
ANSWER = 10.0  # and so long for an answer in lock-step [s]
ALIVE_POLL_INTERVAL = 0.2  # between two looks whether it still lives [s]
GREETED = 1.0  # whoever connects has so long to name the token [s]
END = 3.0  # and so long to end by itself [s]
_GONE = "The ECU's program ended in the middle of the drive"
LIMITED, UNFINISHED = 1, 2  # flags, ridelab_controller.h
_HELLO = struct.Struct(f"<8s{TOKEN}sI")
_ANSWER = struct.Struct("<IiiiIfII")


class ProcessEcu(Ecu):
    """An ECU at the other end of a socket.

    `operations` and `computing_ns` grow by one with each answer: as the program counted and timed itself.
    """

    def __init__(self, connection: socket.socket, calibration: Calibration, patience: float) -> None:
        self._connection = connection
        self._length = STATES + len(PREVIEW) * calibration.preview_length
        self._patience = patience
        self._pending = bytearray()
        self.operations: list[int] = []
        self.computing_ns: list[int] = []

    def exchange(self, frame: Frame) -> Reply:
        """Send a frame and wait for its answer.

        Raises:
            EcuError: No answer, or not one to this frame.
        """
        self.send(frame)
        answer = self.receive(time.monotonic() + self._patience)
        if answer is None:
            raise EcuError(f"The ECU's program did not answer within {self._patience:g} s")
        step, reply = answer
        if step != frame.step:
            raise EcuError("The ECU's program answered what nobody asked")
        return reply

    def send(self, frame: Frame) -> None:
        """Send a frame.

        Raises:
            EcuError: The program is gone.
        """
        if len(frame.codes) != self._length:
            raise ValueError("A frame has as many codes as the tables say")
        try:
            self._connection.settimeout(self._patience)
            self._connection.sendall(struct.pack("<Ii", frame.step, frame.stage) + frame.codes.astype("<i4").tobytes())
        except OSError:
            raise EcuError(_GONE) from None

    def receive(self, deadline: float) -> tuple[int, Reply] | None:
        """The next answer and its step, or None where none is complete at the deadline (monotonic) [s].

        Raises:
            EcuError: The program is gone, or says what it should not.
        """
        while len(self._pending) < _ANSWER.size:
            self._connection.settimeout(max(deadline - time.monotonic(), 1e-6))
            try:
                piece = self._connection.recv(_ANSWER.size - len(self._pending))
            except TimeoutError:
                return None
            except OSError:
                piece = b""
            if not piece:
                raise EcuError(_GONE)
            self._pending += piece
        step, front, rear, flags, iterations, slack, operations, nanoseconds = _ANSWER.unpack(self._pending)
        self._pending.clear()
        if flags < 0 or not np.isfinite(slack):
            raise EcuError("The ECU's program answered what nobody asked")
        self.operations.append(operations)
        self.computing_ns.append(nanoseconds)
        reply = Reply(
            commands=(front, rear),
            limited=bool(flags & LIMITED),
            iterations=iterations,
            unfinished=bool(flags & UNFINISHED),
            slack=slack,
        )
        return step, reply


@contextmanager
def connected(
    calibration: Calibration, program: Path | None = None, *, patience: float = ANSWER
) -> Iterator[ProcessEcu]:
    """A new process of the ECU's program, ready for the first frame; ended afterwards.

    Args:
        calibration: Its tables.
        program: One that has these tables compiled in; without one Ridelab's, which loads them.
        patience: It has so long for an answer [s].

    Raises:
        EcuError: It cannot be built, does not start, or is not ours.
    """
    path, content = (build.program(), tables.loaded(calibration)) if program is None else (program, b"")
    token = secrets.token_bytes(TOKEN)
    with socket.create_server(("127.0.0.1", 0), backlog=8) as listener:
        port = listener.getsockname()[1]
        try:
            process = subprocess.Popen(  # noqa: S603  # our own program, no shell
                [path, str(port)], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
        except OSError as error:
            raise EcuError(f"The ECU's program does not start ({error.strerror})") from None
        try:
            connection = _greeted(listener, process, token, content, tables.fingerprint(calibration))
            with connection:
                listener.close()
                yield ProcessEcu(connection, calibration, patience)
        finally:
            _end(process)


def _greeted(
    listener: socket.socket, process: "subprocess.Popen[bytes]", token: bytes, content: bytes, expected: int
) -> socket.socket:
    """The connection of the process that has the token; others are closed."""
    assert process.stdin is not None  # noqa: S101  # it was asked for
    with suppress(BrokenPipeError), process.stdin:  # a program that ended already is noticed below
        process.stdin.write(token + content)
    end = time.monotonic() + START
    listener.settimeout(ALIVE_POLL_INTERVAL)
    while time.monotonic() < end:
        try:
            connection, _ = listener.accept()
        except TimeoutError:
            if process.poll() is not None:
                raise EcuError(f"The ECU's program ended at its start (code {process.returncode})") from None
            continue
        connection.settimeout(GREETED)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            greeting, sent_token, sent_checksum = _HELLO.unpack(connection.recv(_HELLO.size, socket.MSG_WAITALL))
        except (OSError, struct.error):
            greeting, sent_token, sent_checksum = b"", b"", 0
        if greeting == GREETING and hmac.compare_digest(sent_token, token):
            if sent_checksum == expected:
                return connection
            connection.close()
            raise EcuError("The program has another scenario's tables")
        connection.close()
    raise EcuError("The ECU's program did not connect in time")


def _end(process: "subprocess.Popen[bytes]") -> None:
    """Wait for the process, which has been hung up on; kill it where it stays."""
    try:
        process.wait(END)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
