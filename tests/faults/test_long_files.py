"""Long answers of a service in a process of its own: they take no memory, and a killed one leaves no file for long."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.faults.conftest import Process
from tests.servers.downloads import Watch, download, opened, proportional_mb, spooled
from tests.servers.process import wait_until

# A CSV of 38 MB; the drill has longer ones.
SCENARIO = {"road": {"length": 400}, "speed": {"initial_speed_kmh": 5, "target_speed_kmh": 5}}
SIZE = 38.4


@pytest.fixture
def process(tmp_path: Path) -> Iterator[Process]:
    process = Process(tmp_path, "service", RIDELAB_WORKERS="2")
    try:
        process.wait_until_ready()
        yield process
    finally:
        process.client.close()
        process.end()


def test_a_table_takes_no_memory_and_a_killed_service_leaves_no_file(process: Process, tmp_path: Path) -> None:
    process.wait_until_warm()
    body = {"scenario": SCENARIO, "strategies": ["passive"]}
    run = process.client.post("/api/v1/runs", json=body).json()["id"]
    path = f"/runs/{run}/series?format=csv"
    download(process, path, "127.0.0.2")  # after which modules are imported
    before = {pid: proportional_mb(pid) for pid in (process.pid, *(each.pid for each in process.workers()))}
    with Watch(process) as watch:
        _, count, complete = download(process, path, "127.0.0.2")
    assert complete
    assert abs(count / 1e6 - SIZE) < 1
    growth = {pid: watch.peaks[pid] - size for pid, size in before.items()}
    assert growth[process.pid] < SIZE / 4
    # A run's own arrays take 65 bytes a sample of 134 in the table; both at once were 3.6 times the table.
    assert max(growth.values()) < 2 * SIZE

    with opened(process, path, "127.0.0.3") as connection:
        assert connection.recv(12) == b"HTTP/1.1 200"
        assert len(spooled(tmp_path)) == 1
        process.kill()
        assert len(spooled(tmp_path)) == 1
        process.wait_until_ready()
        wait_until(lambda: not spooled(tmp_path), "the next one removes it")
