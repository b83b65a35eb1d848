"""A program as a process of its own, started again when it dies where a container engine would do so; the service."""

import contextlib
import os
import signal
import socket
import ssl
import subprocess
import sys
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Self

import httpx
import psutil

ROOT = Path(__file__).parents[2]
# The limit of every wait of every test [s]. It ends what hangs: a machine that is busy never reaches it.
HANG_TIMEOUT = 600.0
FORK_SERVER = "multiprocessing.forkserver"  # in the command line of what workers are forked from, and in theirs


# For plain HTTP no certificate is needed; without this httpx reads all it knows for every request, 20 ms of a core.
_NO_CERTIFICATES = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
_reserved: list[socket.socket] = []


def reserved_port() -> int:
    """A port of this machine for a server of ours, which may end and come back; nobody else gets it meanwhile.

    A socket stays bound to it and never listens. While it is there the system gives the port to nobody who wants any
    one, and to a server that asks for this very one and sets SO_REUSEADDR, as all do that are started here.
    """
    holder = socket.socket()
    holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    holder.bind(("127.0.0.1", 0))
    _reserved.append(holder)  # as long as this process lives
    return int(holder.getsockname()[1])


def request(method: str, url: str, *, timeout: float = HANG_TIMEOUT, **options: Any) -> httpx.Response:
    """The answer to one request to a server of this machine."""
    return httpx.request(method, url, timeout=timeout, verify=_NO_CERTIFICATES, **options)


def wait_until(condition: Callable[[], object], what: str, *, pause: float = 0.1) -> None:
    """Wait for it to hold, looking ever less often, at last every `pause` [s]; an OSError means not yet."""
    end, wait = time.monotonic() + HANG_TIMEOUT, 0.005
    while time.monotonic() < end:
        with contextlib.suppress(OSError):
            if condition():
                return
        time.sleep(wait)
        wait = min(1.2 * wait, pause)
    raise TimeoutError(f"It hangs: {what}")


def is_worker(process: psutil.Process) -> bool:
    """Whether it computes for a service: it was forked from a warm process, and has its command line."""
    parent = process.parent()
    return parent is not None and all(FORK_SERVER in " ".join(each.cmdline()) for each in (process, parent))


class Ends(ABC):
    """What ends with the block that it is used in."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    @abstractmethod
    def end(self) -> object:
        """End it, whatever became of it."""


class Program(Ends):
    """One program, watched by a thread; `restart` starts it again whenever it ends by itself or is killed."""

    PAUSE = 0.3  # before it is started again [s]

    def __init__(
        self, name: str, command: Sequence[str], *, folder: Path, environment: Mapping[str, str], restart: bool = False
    ) -> None:
        self.name = name
        self._command = list(command)
        self._log = folder / f"{name}.log"
        self._environment = {**os.environ, **environment}
        self._restart = restart
        self._lock = threading.Lock()  # held while it is started again, or told not to be
        self._ended = threading.Event()
        self._may_live = threading.Event()
        self._may_live.set()
        self._process = self._spawn()
        self._watch = threading.Thread(target=self._keep, daemon=True)
        self._watch.start()

    @property
    def pid(self) -> int:
        """The id of the process that runs now, or ran last."""
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
        with self._lock:
            if stays_dead:
                self._may_live.clear()
            process = self._process
        process.kill()
        process.wait()

    def revive(self) -> None:
        """Let it be started again, where it was to stay dead."""
        self._may_live.set()

    def terminate(self, *, stays_dead: bool = False) -> int:
        """End its process in order; its exit code. It is started again where it would be after a crash."""
        with self._lock:
            if stays_dead:
                self._may_live.clear()
            process = self._process
        process.send_signal(signal.SIGTERM)
        return process.wait(HANG_TIMEOUT)

    def end(self) -> int | None:
        """End it in order, for good; returns its exit code, None where it had to be killed."""
        with self._lock:
            self._ended.set()
        self._may_live.set()
        left = self.children()
        code: int | None = None
        if self.running:
            self._process.send_signal(signal.SIGTERM)
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = self._process.wait(HANG_TIMEOUT)
        for process in left:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        self._process.kill()
        self._process.wait()
        self._watch.join()
        return code

    def _spawn(self) -> "subprocess.Popen[bytes]":
        with self._log.open("ab") as log:
            return subprocess.Popen(self._command, cwd=ROOT, env=self._environment, stdout=log, stderr=log)

    def _keep(self) -> None:
        while True:
            self._process.wait()
            if not self._restart or self._ended.wait(self.PAUSE):
                return
            self._may_live.wait()
            with self._lock:
                if self._ended.is_set():
                    return
                if self._may_live.is_set():
                    self._process = self._spawn()


class Api(Program):
    """One replica as an operator runs it, on a port that stays; `PROGRAM` is what Python runs."""

    PROGRAM: Sequence[str] = ("-m", "backend")

    def __init__(self, folder: Path, *, name: str = "api", **environment: str) -> None:
        self.port = reserved_port()
        command = [sys.executable, *self.PROGRAM, "--port", str(self.port), "--data-dir", str(folder / "data")]
        super().__init__(name, command, folder=folder, environment=environment, restart=True)

    @property
    def url(self) -> str:
        """Where it serves."""
        return f"http://127.0.0.1:{self.port}"

    @property
    def ready(self) -> bool:
        """Whether it says so now."""
        with contextlib.suppress(httpx.TransportError):
            return request("GET", f"{self.url}/readyz").status_code == 200
        return False

    def wait_until_ready(self) -> None:
        """Wait for it."""
        wait_until(lambda: self.ready, f"{self.name} is ready")


def ask(url: str, method: str, path: str, **options: Any) -> Any:
    """The JSON of an answer with a good status; while the service is down or full it is asked again."""
    end = time.monotonic() + HANG_TIMEOUT
    while time.monotonic() < end:
        with contextlib.suppress(httpx.TransportError):
            answer = request(method, f"{url}/api/v1{path}", **options)
            if answer.is_success:
                return answer.json()
            assert answer.status_code in (429, 502, 503, 504), f"{answer.status_code} {answer.text}"
        time.sleep(0.2)
    raise TimeoutError(f"{url} did not answer {method} {path}")
