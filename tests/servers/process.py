"""A program as a process of its own, started again when it dies where a container engine would do so."""

import contextlib
import os
import signal
import socket
import subprocess
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import psutil

ROOT = Path(__file__).parents[2]


def free_port() -> int:
    """A port nobody listens on now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


def wait_until(condition: Callable[[], object], what: str, seconds: float = 60) -> None:
    """Wait for it to hold; an OSError means not yet."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with contextlib.suppress(OSError):
            if condition():
                return
        time.sleep(0.05)
    raise TimeoutError(f"It took too long: {what}")


class Program:
    """One program, watched by a thread; `restart` starts it again whenever it ends by itself or is killed."""

    PAUSE = 0.3  # before it is started again [s]

    def __init__(
        self, name: str, command: Sequence[str], *, folder: Path, environment: Mapping[str, str], restart: bool = False
    ) -> None:
        self.name = name
        self.starts = 0
        self._command = list(command)
        self._log = folder / f"{name}.log"
        self._environment = {**os.environ, **environment}
        self._restart = restart
        self._ended = threading.Event()
        self._may_live = threading.Event()
        self._may_live.set()
        self._process = self._spawn()
        self._watch = threading.Thread(target=self._keep, daemon=True)
        self._watch.start()

    @property
    def pid(self) -> int:
        """Of the process that runs now, or ran last."""
        return self._process.pid

    @property
    def running(self) -> bool:
        """Whether it runs now."""
        return self._process.poll() is None

    @property
    def log(self) -> str:
        """All it said, in all its lives."""
        return self._log.read_text(errors="replace")

    def children(self) -> list[psutil.Process]:
        """The processes it started, and theirs."""
        try:
            return psutil.Process(self.pid).children(recursive=True)
        except psutil.NoSuchProcess:
            return []

    def kill(self, *, stays_dead: bool = False) -> None:
        """Kill -9 its process, and only that one: what it started is left alone, as a crash would leave it."""
        if stays_dead:
            self._may_live.clear()
        self._process.kill()
        self._process.wait()

    def revive(self) -> None:
        """Let it be started again, where it was to stay dead."""
        self._may_live.set()

    def end(self, seconds: float = 15) -> int | None:
        """End it in order, for good; returns its exit code, None where it had to be killed."""
        self._ended.set()
        self._may_live.set()
        left = self.children()
        code: int | None = None
        if self.running:
            self._process.send_signal(signal.SIGTERM)
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = self._process.wait(seconds)
        for process in left:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        self._process.kill()
        self._process.wait()
        self._watch.join()
        return code

    def _spawn(self) -> "subprocess.Popen[bytes]":
        self.starts += 1
        with self._log.open("ab") as log:
            return subprocess.Popen(self._command, cwd=ROOT, env=self._environment, stdout=log, stderr=log)

    def _keep(self) -> None:
        while True:
            self._process.wait()
            if not self._restart or self._ended.wait(self.PAUSE):
                return
            self._may_live.wait()
            if self._ended.is_set():
                return
            self._process = self._spawn()
