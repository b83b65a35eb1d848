"""The service as its users start it: `python -m backend` in a process of its own."""

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path

import httpx
import psutil
import pytest

from backend.compute.workers import RESERVED
from backend.store import Store
from tests.data import release
from tests.servers.process import HANG_TIMEOUT, Api, is_worker, wait_until


class Process(Api):
    """A started service."""

    def __init__(self, folder: Path, name: str, **environment: str) -> None:
        few = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1"}  # each takes half a second of a core to start
        super().__init__(folder, name=name, **{"PYTHONWARNINGS": "error", **few, **environment})
        self.client = httpx.Client(base_url=self.url, timeout=HANG_TIMEOUT)

    def end(self) -> int | None:
        """End it, and its client."""
        self.client.close()
        return super().end()

    def workers(self, nice: int = 0) -> list[psutil.Process]:
        """Its processes for interactive runs, or (`NICE`) those for batches."""
        workers, niceness = [], min(19, psutil.Process().nice() + nice)
        for child in self.children():
            with contextlib.suppress(psutil.Error):  # it may end meanwhile
                if is_worker(child) and child.nice() == niceness:
                    workers.append(child)
        return workers

    def cpu_times(self, nice: int = 0) -> dict[psutil.Process, float]:
        """Processor time of each worker so far [s]."""
        times = {}
        for worker in self.workers(nice):
            with contextlib.suppress(psutil.Error):
                spent = worker.cpu_times()
                times[worker] = spent.user + spent.system
        return times

    def wait_until_warm(self) -> None:
        """Wait for all workers of a service that has two, all of them warm and without work."""
        count = 2 + RESERVED
        idle = f'ridelab_workers{{state="idle"}} {count}.0'
        wait_until(
            lambda: len(self.workers()) == count and idle in self.client.get("/metrics").text, "the workers are warm"
        )

    def wait_for_busy(self, nice: int = 0, other_than: psutil.Process | None = None) -> psutil.Process:
        """A worker that computes, once one does."""
        before, busy = self.cpu_times(nice), list[psutil.Process]()

        def look() -> bool:
            now = self.cpu_times(nice)
            candidates = now.keys() - {other_than}
            busy.extend(worker for worker in candidates if now[worker] - before.get(worker, now[worker]) > 0.15)
            return bool(busy)

        wait_until(look, "a worker computes", pause=0.01)
        return busy[0]

    def finish(self) -> None:
        """Wait until every job that waits or runs has ended."""
        for kind in ("batches", "tunings"):
            for state in ("planning", "queued", "running"):
                for job in self.client.get(f"/api/v1/{kind}?state={state}").raise_for_status().json()[kind]:
                    self.client.get(f"/api/v1/{kind}/{job['id']}/events")  # a stream that ends with it


Start = Callable[..., Process]


def starter(folder: Path) -> Iterator[Start]:
    """Starts services on one data directory, and ends what is left of them."""
    started: list[Process] = []

    def start_one(**environment: str) -> Process:
        started.append(Process(folder, f"api-{len(started)}", **environment))
        started[-1].wait_until_ready()
        return started[-1]

    try:
        yield start_one
    finally:
        for service in started:
            service.end()


@pytest.fixture(scope="session")
def database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The database of core 0.4.0, killed in the middle of a batch and a tuning."""
    folder = tmp_path_factory.mktemp("shared") / "data"
    folder.mkdir()
    store = Store(f"sqlite:///{folder}/ridelab.sqlite")
    release.restore(store)
    store.close()
    return folder / "ridelab.sqlite"


@pytest.fixture(scope="session")
def service(database: Path) -> Iterator[Process]:
    """One service for every test it can outlive: workers killed, batches cancelled, no room on the disk."""
    limits = {"RIDELAB_WORKERS": "2", "RIDELAB_MAX_REQUEST_COST": "1000"}
    controllers = database.parent.parent / "controllers"
    controllers.mkdir()
    release.write_controllers(controllers)
    for start in starter(database.parent.parent):
        started = start(**limits, RIDELAB_CONTROLLERS=str(controllers))
        started.finish()
        yield started
