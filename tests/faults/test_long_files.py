"""Long answers of a service: they take no memory, and a killed one leaves no file for long."""

from pathlib import Path

import pytest

from tests.faults.conftest import Process
from tests.servers.downloads import Watch, download, opened, proportional_mb, spooled
from tests.servers.process import wait_until

# A CSV of 38 MB; the drill has longer ones.
SCENARIO = {"road": {"length": 400}, "speed": {"initial_speed_kmh": 5, "target_speed_kmh": 5}}
SIZE = 38.4


@pytest.mark.thorough
def test_a_table_takes_no_memory_and_a_killed_service_leaves_no_file(service: Process, database: Path) -> None:
    folder = database.parent.parent
    service.wait_until_warm()
    body = {"scenario": SCENARIO, "strategies": ["passive"]}
    run = service.client.post("/api/v1/runs", json=body).json()["id"]
    path = f"/runs/{run}/series?format=csv"
    download(service, path, "127.0.0.2")  # after which modules are imported
    before = {pid: proportional_mb(pid) for pid in (service.pid, *(each.pid for each in service.workers()))}
    with Watch(service) as watch:
        _, count, complete = download(service, path, "127.0.0.2")
    assert complete
    assert abs(count / 1e6 - SIZE) < 1
    growth = {pid: watch.peaks[pid] - size for pid, size in before.items()}
    assert growth[service.pid] < SIZE / 4
    # A run's own arrays take 65 bytes a sample of 134 in the table; both at once were 3.6 times the table.
    assert max(growth.values()) < 2 * SIZE

    with opened(service, path, "127.0.0.3") as connection:
        assert connection.recv(12) == b"HTTP/1.1 200"
        assert len(spooled(folder)) == 1
        service.kill()
        assert len(spooled(folder)) == 1
        service.wait_until_ready()
        wait_until(lambda: not spooled(folder), "the next one removes it")
