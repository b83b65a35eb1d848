"""The service as its users start it: `python -m backend` in a process of its own."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx
import psutil
import pytest

ROOT = Path(__file__).parents[2]


@dataclass
class Process:
    """A started service."""

    process: subprocess.Popen[str]
    client: httpx.Client

    def workers(self) -> list[psutil.Process]:
        """Its worker processes, by their command line."""
        found = []
        for child in psutil.Process(self.process.pid).children(recursive=True):
            with contextlib.suppress(psutil.Error):  # it may end meanwhile
                if "spawn_main" in " ".join(child.cmdline()):
                    found.append(child)
        return found

    def cpu_times(self) -> dict[int, float]:
        """Processor time of each worker so far [s]."""
        times = {}
        for worker in self.workers():
            with contextlib.suppress(psutil.Error):
                spent = worker.cpu_times()
                times[worker.pid] = spent.user + spent.system
        return times

    def wait_until_warm(self, count: int, seconds: float = 90) -> None:
        """Wait for so many workers of which none computes (or warms up) for half a second."""
        end, before, quiet = time.monotonic() + seconds, self.cpu_times(), 0
        while quiet < 5:
            assert time.monotonic() < end, "the workers did not get warm"
            time.sleep(0.1)
            now = self.cpu_times()
            still = now.keys() == before.keys() and sum(now.values()) - sum(before.values()) < 0.02
            quiet = quiet + 1 if still and len(now) == count else 0
            before = now

    def wait_for_busy(self, among: set[int] | None = None, seconds: float = 60) -> psutil.Process:
        """The worker that computes, once one does."""
        end, before = time.monotonic() + seconds, self.cpu_times()
        while time.monotonic() < end:
            for pid, spent in self.cpu_times().items():
                if (among is None or pid in among) and spent - before.get(pid, spent) > 0.15:
                    return psutil.Process(pid)
            time.sleep(0.01)
        raise TimeoutError("No worker computes")

    def wait_until_ready(self, seconds: float = 90) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if self.client.get("/readyz").status_code == 200:
                    return
            except httpx.TransportError:
                pass
            assert self.process.poll() is None, "the service ended"
            time.sleep(0.05)
        raise TimeoutError("The service did not get ready")

    def kill(self) -> None:
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


Start = Callable[..., Process]


def starter(folder: Path) -> Iterator[Start]:
    """Starts services on free ports and one data directory, and ends what is left of them."""
    started: list[Process] = []

    def start_one(*, ready: bool = True, **environment: str) -> Process:
        command = [sys.executable, "-W", "error", "-m", "backend", "--port", "0", "--data-dir", str(folder / "data")]
        log = folder / f"log-{len(started)}"
        with log.open("w") as sink:
            process = subprocess.Popen(
                command, cwd=ROOT, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=sink, text=True
            )
        assert process.stdout is not None
        line = process.stdout.readline()
        address = re.fullmatch(r"Ridelab is at (http://127\.0\.0\.1:\d+)\n", line)
        assert address, f"{line!r} {log.read_text()}"
        service = Process(process=process, client=httpx.Client(base_url=address[1], timeout=90))
        started.append(service)
        if ready:
            service.wait_until_ready()
        return service

    yield start_one
    for service in started:
        service.client.close()
        if service.process.poll() is None:
            service.kill()
        if service.process.stdout is not None:
            service.process.stdout.close()


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Start a service; one data directory for the whole test."""
    yield from starter(tmp_path)


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Process]:
    """One service for every test that only kills its workers: it has to get over each."""
    for start_one in starter(tmp_path_factory.mktemp("shared")):
        yield start_one(RIDELAB_WORKERS="2")
