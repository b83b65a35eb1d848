"""Services a command works with: those at an address, or a private one that ends with the command."""

import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from backend.cli.options import SERVER_VARIABLE
from backend.cli.reporting import InputError, UnavailableError, nothing_submitted, terminal
from backend.client import Ridelab
from backend.client.address import without_login

START = 90.0  # the private service gets so long to start [s]; it takes one or two
END = 15.0  # and so long to end; the service itself promises ten
_ADDRESS = re.compile(r"^Ridelab is at (http://\S+)$", re.MULTILINE)
_FOLDER = Path(__file__).parents[2]


def child_environment() -> dict[str, str]:
    """The environment in which `python -P -m backend` finds this very package, whatever the current folder holds."""
    paths = [str(_FOLDER), os.environ.get("PYTHONPATH", "")]
    kept = {name: value for name, value in os.environ.items() if name != SERVER_VARIABLE}  # no setting of a service
    return {**kept, "PYTHONPATH": os.pathsep.join(path for path in paths if path)}


class Services:
    """Connections, made when they are first needed and closed together; a context manager.

    Args:
        server: Address of the service to work with; None starts a private one.
        data_dir: Where a private one keeps its database; None is its own default.
    """

    def __init__(self, server: str | None, data_dir: Path | None) -> None:
        self._server = server
        self._data_dir = data_dir
        self._open: dict[str | None, Ridelab] = {}
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.close()

    @property
    def private(self) -> bool:
        """Whether the service ends with the command."""
        return self._server is None

    @property
    def started(self) -> bool:
        """Whether a private service runs now."""
        return None in self._open

    def at(self, server: str | None = None) -> Ridelab:
        """The client of the service there; None is the one the command works with.

        Raises:
            InputError: That is no address.
            UnavailableError: The private service does not start.
        """
        address = server or self._server
        if server is not None and self._server is not None and server == without_login(self._server).rstrip("/"):
            address = self._server  # messages show addresses without their login
        if address not in self._open:
            url = address if address is not None else self._stack.enter_context(private(self._data_dir))
            try:
                self._open[address] = self._stack.enter_context(Ridelab(url))
            except ValueError as error:
                raise InputError(f"--server or RIDELAB_SERVER: {error}") from None
        return self._open[address]


@contextmanager
def private(data_dir: Path | None) -> Iterator[str]:
    """A service on a free port of this machine, ended with the block; gives its address.

    Raises:
        UnavailableError: It does not start; the message is its own.
        typer.Exit: Ctrl-C came while it started, and that has been said.
    """
    options = [] if data_dir is None else ["--data-dir", str(data_dir)]
    command = [sys.executable, "-P", "-m", "backend.cli.embedded", *options]
    with tempfile.TemporaryFile() as log:
        process = subprocess.Popen(  # noqa: S603  # our own module and a path, no shell
            command,
            stdin=subprocess.PIPE,
            stdout=log,
            stderr=log,
            env=child_environment(),
            start_new_session=True,  # Ctrl-C is the command's: it may still need the service to cancel
        )
        try:
            try:
                address = _wait(process, log)
            except KeyboardInterrupt:
                raise nothing_submitted() from None
            yield address
        finally:
            _end(process)


def _wait(process: subprocess.Popen[bytes], log: IO[bytes]) -> str:
    """The address the service prints once it serves."""
    end = time.monotonic() + START
    with terminal() as console, console.status("Starting a private service") if console.is_terminal else ExitStack():
        while time.monotonic() < end:
            ended = process.poll() is not None
            text = os.pread(log.fileno(), 1 << 20, 0).decode(errors="replace")
            found = _ADDRESS.search(text)
            if found is not None:
                return found[1]
            if ended:
                raise UnavailableError(_said(text))
            time.sleep(0.02)
    raise UnavailableError(f"The private service did not start within {START:.0f} s")


def _said(log: str) -> str:
    """Why it did not start: what it says to people, or its last log entry."""
    lines = [line for line in log.splitlines() if line.strip()]
    plain = [line for line in lines if not line.startswith("{")]
    return "\n".join(plain or lines[-1:]) or "The private service ended without a word"


def _end(process: subprocess.Popen[bytes]) -> None:
    if process.stdin is not None:
        process.stdin.close()
    try:
        process.wait(END)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
