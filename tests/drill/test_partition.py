"""Two replicas on one PostgreSQL; the network swallows what the one that drives the jobs and the database send.

With shipped time limits. Printed is how long who asks the cut-off replica waits for its 503, how soon the other one
drives the jobs, and how soon the first one answers when the network is whole again.
"""

import contextlib
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import pytest
from sqlalchemy import make_url, text

from backend.jobs.leadership import LOCK_ID
from backend.store import Store
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, state, submit
from tests.servers.forwarder import DIRECTIONS, Direction, Forwarder
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT, wait_until

RUNS = 800  # of the batch
ASKING = 40  # at once
LONGEST = 20.0  # for a 503: one time limit for the answer and one for a new connection, and room for a busy machine [s]


@pytest.fixture
def forwarders(postgres: Postgres) -> Iterator[list[Forwarder]]:
    with contextlib.ExitStack() as opened:
        yield [opened.enter_context(contextlib.closing(Forwarder(postgres.port))) for _ in range(2)]


@pytest.fixture
def url(postgres: Postgres) -> str:
    return postgres.new_database()


@pytest.fixture
def replicas(url: str, forwarders: list[Forwarder], tmp_path: Path) -> Iterator[list[Process]]:
    with contextlib.ExitStack() as started:
        both: list[Process] = []
        for number, forwarder in enumerate(forwarders):
            address = make_url(url).set(port=forwarder.port).render_as_string(hide_password=False)
            variables = {"RIDELAB_DATABASE_URL": address}
            both.append(started.enter_context(Process(tmp_path, f"api-{number}", **variables)))
            both[-1].wait_until_ready()
        yield both


@pytest.mark.timeout(300)
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_the_leader_is_cut_off(
    replicas: list[Process], forwarders: list[Forwarder], url: str, direction: Direction
) -> None:
    cut_off, other = replicas  # the first one to start drives the jobs
    batch = submit(other, {"road": {"length": 121.7}}, RUNS)
    wait_until(lambda: state(other, batch)["done"] > 0, "the batch begins", pause=0.01)
    waits: list[float] = []

    def ask(_: int) -> None:
        begun = time.monotonic()
        with httpx.Client(base_url=cut_off.url, timeout=HANG_TIMEOUT) as client:
            assert client.get(f"/api/v1/batches/{batch}").status_code == 503
        waits.append(time.monotonic() - begun)

    with contextlib.closing(Store(url)) as store:
        before = leader(store)
        with forwarders[0].blocked(direction), ThreadPoolExecutor(ASKING) as clients:
            begun = time.monotonic()
            asked = [clients.submit(ask, number) for number in range(ASKING)]
            wait_until(lambda: leader(store) not in (None, before), "the other one drives")
            taken_over = time.monotonic() - begun
            for each in asked:
                each.result()
        begun = time.monotonic()
        cut_off.wait_until_ready()
        healed = time.monotonic() - begun
        finished(other, batch, RUNS)
        assert leader(store) not in (None, before)
    print(
        f"{direction} cut: 503 after {min(waits):.1f} to {max(waits):.1f} s, the other one drives after "
        f"{taken_over:.1f} s, ready {healed:.1f} s after the end"
    )
    assert max(waits) < LONGEST
    assert "Traceback" not in cut_off.log, cut_off.log[-5000:]


def leader(store: Store) -> str | None:
    """The name of the connections of the one who drives the jobs; None for a moment between two."""
    query = "SELECT application_name FROM pg_locks JOIN pg_stat_activity USING (pid) WHERE objid = :id AND granted"
    with store.reading() as connection:
        name: str | None = connection.execute(text(query), {"id": LOCK_ID}).scalar()
    return name
