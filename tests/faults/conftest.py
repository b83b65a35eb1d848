"""The service as its users start it: `python -m backend` in a process of its own."""

import contextlib
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx
import psutil
import pytest

from backend.store import Store
from tests.data import release
from tests.servers.process import ROOT, wait_until

PAGE = '<!doctype html><html><head><meta charset="utf-8"><title>Ridelab</title></head><body></body></html>'


@dataclass
class Process:
    """A started service."""

    process: subprocess.Popen[str]
    client: httpx.Client
    log_file: Path

    @property
    def log(self) -> str:
        """All it logged so far."""
        return self.log_file.read_text(errors="replace")

    def family(self) -> list[psutil.Process]:
        """The processes it started, and theirs."""
        return psutil.Process(self.process.pid).children(recursive=True)

    def workers(self, nice: int = 0) -> list[psutil.Process]:
        """Its processes for interactive runs, or (`NICE`) those for batches."""
        found = []
        for child in self.family():
            with contextlib.suppress(psutil.Error):  # it may end meanwhile
                if "spawn_main" in " ".join(child.cmdline()) and child.nice() == nice:
                    found.append(child)
        return found

    def cpu_times(self, nice: int = 0) -> dict[psutil.Process, float]:
        """Processor time of each worker so far [s]."""
        times = {}
        for worker in self.workers(nice):
            with contextlib.suppress(psutil.Error):
                spent = worker.cpu_times()
                times[worker] = spent.user + spent.system
        return times

    def wait_until_warm(self, count: int) -> None:
        """Wait for so many workers of which none computes (or warms up) for half a second."""
        before, quiet = self.cpu_times(), 0

        def still() -> bool:
            nonlocal before, quiet
            now = self.cpu_times()
            same = now.keys() == before.keys() and sum(now.values()) - sum(before.values()) < 0.02
            quiet = quiet + 1 if same and len(now) == count else 0
            before = now
            return quiet == 5

        wait_until(still, "the workers are warm", 90, pause=0.1)

    def wait_for_busy(self, nice: int = 0, among: psutil.Process | None = None) -> psutil.Process:
        """The worker that computes, once one does, or that one does."""
        before, busy = self.cpu_times(nice), list[psutil.Process]()

        def look() -> bool:
            now = self.cpu_times(nice)
            chosen = now if among is None else now.keys() & {among}
            busy.extend(worker for worker in chosen if now[worker] - before.get(worker, now[worker]) > 0.15)
            return bool(busy)

        wait_until(look, "a worker computes", pause=0.01)
        return busy[0]

    def is_ready(self) -> bool:
        """Whether it says so now."""
        with contextlib.suppress(httpx.TransportError):
            return self.client.get("/readyz").status_code == 200
        return False

    def is_idle(self) -> bool:
        """Whether no job waits or runs."""
        lists = [(kind, state) for kind in ("batches", "tunings") for state in ("queued", "running")]
        return not any(self.client.get(f"/api/v1/{kind}?state={state}").json()[kind] for kind, state in lists)

    def end(self) -> None:
        """Kill it and all it started, whatever became of it."""
        self.client.close()
        for process in self.family() if self.process.poll() is None else ():
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        self.process.kill()
        self.process.wait()
        assert self.process.stdout is not None
        self.process.stdout.close()


Start = Callable[..., Process]


def starter(folder: Path) -> Iterator[Start]:
    """Starts services on free ports and one data directory, and ends what is left of them."""
    started: list[Process] = []

    def start_one(**environment: str) -> Process:
        command = [sys.executable, "-W", "error", "-m", "backend", "--port", "0", "--data-dir", str(folder / "data")]
        log = folder / f"log-{len(started)}"
        with log.open("w") as sink:
            process = subprocess.Popen(
                command, cwd=ROOT, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=sink, text=True
            )
        service = Process(process=process, client=httpx.Client(timeout=90), log_file=log)
        started.append(service)
        assert process.stdout is not None
        line = process.stdout.readline()
        address = re.fullmatch(r"Ridelab is at (http://127\.0\.0\.1:\d+)\n", line)
        assert address, f"{line!r} {service.log}"
        service.client.base_url = httpx.URL(address[1])
        wait_until(service.is_ready, "the service is ready", 90)
        return service

    try:
        yield start_one
    finally:
        for service in started:
            service.end()


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Start a service; one data directory for the whole test."""
    yield from starter(tmp_path)


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A built frontend, as far as the service cares."""
    folder = tmp_path_factory.mktemp("dist")
    (folder / "index.html").write_text(PAGE)
    return str(folder)


@pytest.fixture(scope="session")
def database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What core 0.2.0 left when it was killed in the middle of a batch and a tuning."""
    folder = tmp_path_factory.mktemp("shared") / "data"
    folder.mkdir()
    store = Store(f"sqlite:///{folder}/ridelab.sqlite")
    release.restore(store)
    store.close()
    return folder / "ridelab.sqlite"


@pytest.fixture(scope="session")
def start_beside(database: Path) -> Iterator[Start]:
    """Start a service on the database of `service`."""
    yield from starter(database.parent.parent)


@pytest.fixture(scope="session")
def service(start_beside: Start, built: str) -> Process:
    """One service for every test it can outlive: workers killed, batches cancelled, no room on the disk."""
    workers = {"RIDELAB_WORKERS": "2", "RIDELAB_BATCH_WORKERS": "1"}
    started = start_beside(**workers, RIDELAB_MAX_REQUEST_COST="1000", RIDELAB_FRONTEND_DIR=built)
    wait_until(started.is_idle, "it finishes what it found unfinished", 90)
    return started
