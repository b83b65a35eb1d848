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

from backend.hil import build, tables
from backend.hil.build import EcuError
from sim_core.half_car import STATES
from sim_core.hil.calibration import Calibration
from sim_core.hil.channels import PREVIEW
from sim_core.hil.ecu import Ecu, Frame, Reply

GREETING = b"RIDELAB1"
TOKEN = 32
START = 15.0  # the process has so long to connect, on a busy machine [s]
ANSWER = 10.0  # and so long for an answer in lock-step [s]
LOOK = 0.2  # between two looks whether it still lives [s]
GREETED = 1.0  # whoever connects has so long to name the token [s]
END = 3.0  # and so long to end by itself [s]
LIMITED, UNFINISHED = 1, 2  # flags, ridelab_controller.h
_HELLO = struct.Struct(f"<8s{TOKEN}sI")
_ANSWER = struct.Struct("<IiiiIfI")


class ProcessEcu(Ecu):
    """An ECU at the other end of a socket."""

    def __init__(self, connection: socket.socket, known: Calibration) -> None:
        self._connection = connection
        self._length = STATES + len(PREVIEW) * known.preview_length
        self.computing_ns: list[int] = []  # by answer, the program's own time

    def exchange(self, frame: Frame) -> Reply:
        """Send and wait.

        Raises:
            EcuError: No answer, or not one to this frame.
        """
        self.send(frame)
        return self.receive(frame.step)

    def send(self, frame: Frame) -> None:
        """Send a frame.

        Raises:
            EcuError: The program is gone.
        """
        if len(frame.codes) != self._length:
            raise ValueError("A frame has as many codes as the tables say")
        try:
            self._connection.sendall(struct.pack("<Ii", frame.step, frame.stage) + frame.codes.astype("<i4").tobytes())
        except OSError:
            raise EcuError("The ECU's program ended in the middle of the drive") from None

    def receive(self, step: int) -> Reply:
        """The answer to that frame.

        Raises:
            EcuError: It did not come in time, or it is none.
        """
        content = received(self._connection, _ANSWER.size)
        answered, front, rear, flags, iterations, slack, nanoseconds = _ANSWER.unpack(content)
        if answered != step or flags < 0 or not np.isfinite(slack):
            raise EcuError("The ECU's program answered what nobody asked")
        self.computing_ns.append(nanoseconds)
        return Reply(
            commands=(front, rear),
            limited=bool(flags & LIMITED),
            iterations=iterations,
            unfinished=bool(flags & UNFINISHED),
            slack=slack,
        )


def received(connection: socket.socket, length: int) -> bytes:
    """So many bytes.

    Raises:
        EcuError: They did not come.
    """
    content = bytearray()
    while len(content) < length:
        try:
            piece = connection.recv(length - len(content))
        except TimeoutError:
            raise EcuError(f"The ECU's program did not answer within {connection.gettimeout():g} s") from None
        except OSError:
            piece = b""
        if not piece:
            raise EcuError("The ECU's program ended in the middle of the drive")
        content += piece
    return bytes(content)


@contextmanager
def connected(known: Calibration, program: Path | None = None, *, patience: float = ANSWER) -> Iterator[ProcessEcu]:
    """A new process of the ECU's program, ready for the first frame; it is gone afterwards.

    Args:
        known: Its tables.
        program: One that has these tables compiled in; without one Ridelab's, which loads them.
        patience: It has so long for an answer [s].

    Raises:
        EcuError: It cannot be built, does not start, or is not ours.
    """
    path, content = (build.program(), tables.loaded(known)) if program is None else (program, b"")
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
            connection = _greeted(listener, process, token, content, tables.fingerprint(known))
            with connection:
                listener.close()
                connection.settimeout(patience)
                yield ProcessEcu(connection, known)
        finally:
            _end(process)


def _greeted(
    listener: socket.socket, process: "subprocess.Popen[bytes]", token: bytes, content: bytes, expected: int
) -> socket.socket:
    """The connection of the process that has the token; others are turned away."""
    assert process.stdin is not None  # noqa: S101  # it was asked for
    with suppress(BrokenPipeError), process.stdin:  # a program that ended already is noticed below
        process.stdin.write(token + content)
    end = time.monotonic() + START
    listener.settimeout(LOOK)
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
            greeting, given, found = _HELLO.unpack(received(connection, _HELLO.size))
        except EcuError:
            greeting, given, found = b"", b"", 0
        if greeting == GREETING and hmac.compare_digest(given, token):
            if found == expected:
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
