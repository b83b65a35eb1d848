"""The database server goes away and comes back: nothing that was answered is lost, and nobody has to help.

That a connection cut in order and one cut by a kill are both found again is shown in tests/api/test_store.py.
"""

from collections.abc import Iterator
from contextlib import ExitStack, suppress

import psutil
import pytest

from tests.faults.conftest import Process, starter
from tests.faults.test_batches import finished, state, submit
from tests.faults.test_disk_full import LONG_BATCH, SHORT, check_refused, halted, post, refused_batch
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT, wait_until

RESTS = ("The jobs rest", "Another service leads the jobs now")  # the driver's words where it lost the database


@pytest.fixture(scope="module")
def service(postgres: Postgres, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Process]:
    """On a server that runs again afterwards."""
    database = postgres.new_database()
    for start_one in starter(tmp_path_factory.mktemp("store-down")):
        yield start_one(RIDELAB_DATABASE_URL=database)
    postgres.start()


def test_while_it_is_away_answers_are_503_and_then_as_before(service: Process, postgres: Postgres) -> None:
    stored = post(service, 1).json()
    postgres.kill()
    for _ in range(3):
        check_refused(post(service, 2))
        check_refused(service.client.get(f"/api/v1/runs/{stored['id']}"))
        refused_batch(service, "when-away")
        assert service.client.get("/healthz").status_code == 200
        assert service.client.get("/api/v1/schema").status_code == 200
        unready = service.client.get("/readyz")
        assert unready.status_code == 503
        assert unready.json()["store"] is False
    live = service.client.post("/api/v1/live", json={"scenario": SHORT, "strategies": ["lqr"], "points": 50})
    assert live.status_code == 200, "dragging needs no database"
    postgres.start()
    service.wait_until_ready()
    again = service.client.get(f"/api/v1/runs/{stored['id']}")
    assert again.status_code == 200
    assert {**again.json(), "strategies": None} == {**stored, "strategies": None}
    assert post(service, 2).status_code == 200
    submit(service, SHORT, 3, **{"Idempotency-Key": "when-away"})


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    """Closes what a test opens."""
    with ExitStack() as stack:
        yield stack


def test_a_running_batch_and_its_stream_go_on_when_it_is_back(
    service: Process, postgres: Postgres, stack: ExitStack
) -> None:
    batch_id = submit(service, {"road": {"length": 121.9}}, LONG_BATCH)
    process, logged = halted(service, batch_id), len(service.log)
    stream = service.client.stream("GET", f"/api/v1/batches/{batch_id}/events", timeout=HANG_TIMEOUT)
    events = stack.enter_context(stream).iter_lines()
    assert next(events)
    postgres.kill()
    with suppress(psutil.NoSuchProcess):  # who no longer leads ends what it computes
        process.resume()
    # What is computed meanwhile cannot be stored: it is computed again, once this service leads again.
    wait_until(lambda: any(words in service.log[logged:] for words in RESTS), "the driver has found out")
    assert service.client.get("/healthz").status_code == 200
    check_refused(service.client.get(f"/api/v1/batches/{batch_id}"))
    postgres.start()
    service.wait_until_ready()
    assert 0 < state(service, batch_id)["done"] < LONG_BATCH
    finished(service, batch_id, LONG_BATCH)
    assert '"done"' in [line for line in events if line.startswith("data:")][-1], "who follows its events hears of it"
