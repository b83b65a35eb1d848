"""Clocks that differ or jump: the database's decides what rows say and what is old; the drill lets all of them jump."""

from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime, timedelta
from email.utils import parsedate_to_datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from backend.db import sqlite
from backend.jobs import retention
from backend.jobs.retention import BELIEVED_AFTER, Retention
from backend.settings import Settings
from backend.store import Store
from sim_core.scenario.measured import MeasuredRoad
from tests.api.test_job_store import BATCH
from tests.faults.clock import Clock
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, submit
from tests.servers import loops
from tests.servers.postgres import Postgres
from tests.servers.process import wait_until

AHEAD = 30 * 86400  # [s]
SHORT = {"road": {"length": 121.3, "bump": {"start": 80}}}


@pytest.fixture
def ahead(postgres: Postgres, tmp_path: Path) -> Iterator[Process]:
    """A replica whose clock is a month ahead, and which removes what is older than a day."""
    clock = Clock(tmp_path)
    clock.set(AHEAD)
    url = postgres.new_database()
    with closing(Store(url)) as store:
        store.migrate()
        long_ago(store)
    variables = {"RIDELAB_DATABASE_URL": url, "RIDELAB_RETENTION_DAYS": "1", **clock.environment}
    with Process(tmp_path, "ahead", **variables) as service:
        service.wait_until_ready()
        yield service


def long_ago(store: Store) -> None:
    """A result that is old by every clock, and one that is new by the database's."""
    row = "INSERT INTO results VALUES ('{}', 'lv', '0.4.0', 'ok', '{{}}', 1, now() - interval '{}')"
    with store.writing() as connection:
        for name, age in (("old", "3 days"), ("new", "1 hour")):
            connection.exec_driver_sql(row.format(name, age))


@pytest.mark.thorough
def test_a_replica_that_is_ahead_dates_nothing_and_removes_nothing_of_today(ahead: Process) -> None:
    shown = parsedate_to_datetime(ahead.client.get("/healthz").headers["date"])
    assert shown > datetime.now(UTC) + timedelta(seconds=AHEAD / 2), "the replica's clock is ahead"
    begun = datetime.now(UTC) - timedelta(minutes=1)
    run = ahead.client.post("/api/v1/runs", json={"scenario": SHORT, "strategies": ["passive"]}).json()
    link = ahead.client.post("/api/v1/links", json={"run_id": run["id"]}).json()
    batch_id = submit(ahead, SHORT, 2)
    finished(ahead, batch_id, 2)
    batch = ahead.client.get(f"/api/v1/batches/{batch_id}").json()
    opened = ahead.client.get(f"/api/v1/links/{link['slug']}").json()
    times = [batch[name] for name in ("created_at", "started_at", "finished_at")]
    times += [opened[name] for name in ("created_at", "computed_at")]
    for each in times:
        assert begun < datetime.fromisoformat(each) < datetime.now(UTC) + timedelta(minutes=1)
    assert times[:3] == sorted(times[:3])
    removed = 'ridelab_removed_total{what="results"} '
    wait_until(lambda: f"{removed}1.0" in ahead.client.get("/metrics").text, "what is old was removed")
    assert ahead.client.get(f"/api/v1/batches/{batch_id}").status_code == 200


class Jumping:
    """The database's clock, and this machine's, which nobody sets [s]."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now, self.seconds = datetime(2026, 3, 1, tzinfo=UTC), 0.0
        monkeypatch.setattr(sqlite, "_now", lambda: f"{self.now:%Y-%m-%d %H:%M:%S.%f}")
        monkeypatch.setattr(retention, "time", SimpleNamespace(monotonic=lambda: self.seconds))

    def goes_on(self, seconds: float) -> None:
        """As clocks do."""
        self.now, self.seconds = self.now + timedelta(seconds=seconds), self.seconds + seconds


@pytest.fixture
def jumping(monkeypatch: pytest.MonkeyPatch) -> Jumping:
    return Jumping(monkeypatch)


@pytest.fixture
def store(jumping: Jumping, tmp_path: Path) -> Iterator[Store]:
    with closing(Store(f"sqlite:///{tmp_path / 'ridelab.sqlite'}")) as store:
        store.migrate()
        yield store


def test_a_clock_that_jumps_ahead_makes_nothing_old_for_a_day(store: Store, jumping: Jumping) -> None:
    road = MeasuredRoad.of(np.zeros(100))
    store.roads.save(road)
    removal = Retention(store, Settings(data_dir=Path("unused"), retention_days=30), store.write)

    def there() -> bool:
        loops.run(removal.apply)
        return road.id in store.roads.load([road.id])

    for jump in (timedelta(days=400), timedelta(days=-400), timedelta(days=40)):
        assert there()
        jumping.now += jump
        jumping.goes_on(600)
        assert there()
    jumping.goes_on(BELIEVED_AFTER)
    assert not there()


def test_a_clock_that_is_set_back_ends_no_job_before_it_began(store: Store, jumping: Jumping) -> None:
    job, _ = store.jobs.create(BATCH)
    for change in (store.jobs.start, store.jobs.cancel):
        jumping.now -= timedelta(hours=1)
        change(job.id)
    ended = store.jobs.load(job.id)
    assert ended is not None
    assert ended.created_at == ended.started_at == ended.finished_at


def test_a_login_that_was_ended_stays_so_when_a_clock_was_ahead(store: Store, jumping: Jumping) -> None:
    store.logins.end("ours")
    jumping.now += timedelta(days=400)
    store.logins.end("another")
    assert store.logins.has_ended("ours")
