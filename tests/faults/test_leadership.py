"""Of several services on one PostgreSQL one drives the jobs. Where it hangs another one does, and nothing is twice.

The role is an ordinary one, as a service has it. Clocks that differ or jump: the database's decides what rows say and
what is old; the drill lets all of them jump.
"""

import asyncio
import contextlib
import os
import signal
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime, timedelta
from email.utils import parsedate_to_datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from sqlalchemy import make_url, text

from backend.db import sqlite
from backend.jobs import leadership, retention
from backend.jobs.leadership import Leadership, LeadershipLostError
from backend.jobs.retention import BELIEVED_AFTER, Retention
from backend.settings import Settings
from backend.store import Store
from sim_core.scenario.measured import MeasuredRoad
from tests.api.test_job_store import BATCH, rows
from tests.faults.clock import Clock
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, state, submit
from tests.servers import loops
from tests.servers.leader import leader
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT, wait_until

RUNS = 150
COUNTS = text(
    "SELECT count(*), count(DISTINCT result_key), count(key) FROM job_runs LEFT JOIN results ON key = result_key"
)
HASTY = """
import sys
from backend.__main__ import main
from backend.jobs import leadership

leadership.BEAT = leadership.RETRY = 0.5
leadership.HUNG = 4.0
sys.exit(main())
"""
PASSWORD = "of-an-ordinary-role"  # noqa: S105


@pytest.fixture
def url(postgres: Postgres) -> str:
    """A database whose owner is no administrator."""
    address = make_url(postgres.new_database())
    role = f"owner_of_{address.database}"
    postgres.execute(f"CREATE ROLE {role} LOGIN PASSWORD '{PASSWORD}'")
    postgres.execute(f"ALTER DATABASE {address.database} OWNER TO {role}")
    return address.set(username=role, password=PASSWORD).render_as_string(hide_password=False)


class Hasty(Process):
    """A service that takes a leader for hanging after four seconds instead of twelve."""

    PROGRAM = ("-c", HASTY)


@pytest.fixture
def replicas(url: str, tmp_path: Path) -> Iterator[list[Hasty]]:
    """Two, on one database."""
    variables = {"RIDELAB_DATABASE_URL": url}
    with contextlib.ExitStack() as started:
        both = [started.enter_context(Hasty(tmp_path, f"api-{number}", **variables)) for number in range(2)]
        for each in both:
            each.wait_until_ready()
        yield both


@pytest.fixture
def stores(url: str) -> Iterator[tuple[Store, Store]]:
    with contextlib.closing(Store(url)) as first, contextlib.closing(Store(url)) as second:
        first.migrate()
        yield first, second


async def led(of: Leadership, until: asyncio.Event, got: asyncio.Event) -> None:
    async with of.held():
        got.set()
        await until.wait()


def test_a_leader_that_hangs_loses_the_lead_and_can_write_nothing_more(
    stores: tuple[Store, Store], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(leadership, "BEAT", HANG_TIMEOUT)  # it hangs
    monkeypatch.setattr(leadership, "RETRY", 0.1)
    monkeypatch.setattr(leadership, "HUNG", 1.0)
    first, second = stores
    job = first.jobs.create(BATCH, rows())[0]

    async def work() -> None:
        old, new, got, end = Leadership(first), Leadership(second), asyncio.Event(), asyncio.Event()
        with first.engine.connect() as unfinished:
            async with old.held():
                await old.confirm()
                await old.write(first.jobs.start, job.id)
                unfinished.execute(text("UPDATE jobs SET label = 'by the old one'"))  # its row is locked
                waiting = asyncio.create_task(led(new, end, got))
                async with asyncio.timeout(HANG_TIMEOUT):
                    await got.wait()
                await new.write(second.jobs.set_label, job.id, "by the new one")
                with pytest.raises(LeadershipLostError):
                    await old.write(first.jobs.cancel, job.id)
                with pytest.raises(LeadershipLostError):
                    await old.confirm()
                end.set()
                await waiting
            unfinished.invalidate()

    loops.run(work)
    now = second.jobs.load(job.id)
    assert now is not None
    assert (now.state, now.label) == ("running", "by the new one")


def test_a_leader_that_has_nothing_to_do_keeps_the_lead(
    stores: tuple[Store, Store], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(leadership, "BEAT", 0.1)
    monkeypatch.setattr(leadership, "RETRY", 0.1)
    monkeypatch.setattr(leadership, "HUNG", 1.0)
    first, second = stores

    async def work() -> None:
        old, new, got, end = Leadership(first), Leadership(second), asyncio.Event(), asyncio.Event()
        async with old.held():
            waiting = asyncio.create_task(led(new, end, got))
            await asyncio.sleep(1.5)  # longer than one that hangs would keep it
            assert not got.is_set()
            await old.confirm()
        async with asyncio.timeout(HANG_TIMEOUT):
            await got.wait()
        end.set()
        await waiting

    loops.run(work)


@pytest.mark.thorough
def test_a_batch_goes_on_when_its_leader_is_stopped_and_nothing_is_twice_when_it_wakes(
    replicas: list[Process], url: str
) -> None:
    with contextlib.closing(Store(url)) as store:
        stopped = leader(url, replicas)
        (other,) = (each for each in replicas if each is not stopped)
        batch = submit(other, {"road": {"length": 121.7}}, RUNS)
        wait_until(lambda: state(other, batch)["done"] > 0, "the batch begins", pause=0.01)
        os.kill(stopped.pid, signal.SIGSTOP)
        try:
            # Until then the server may still commit what the stopped one had sent.
            wait_until(lambda: leader(url, replicas) is other, "the other one drives")
            before = state(other, batch)["done"]
            assert before < RUNS, "the test needs a longer batch"
            wait_until(lambda: state(other, batch)["done"] > before, "the batch goes on")
        finally:
            os.kill(stopped.pid, signal.SIGCONT)
        wait_until(lambda: "Another service leads the jobs now" in stopped.log, "the old one has stepped down")
        wait_until(lambda: state(other, batch)["state"] == "done", "the batch ends")
        assert stopped.client.get(f"/api/v1/batches/{batch}").json()["done"] == RUNS
        assert leader(url, replicas) is other
        with store.reading() as connection:
            counts = connection.execute(COUNTS).one()
        assert set(counts) == {RUNS}
        numbers = [event.number for event in store.job_events.of(batch, 0)]
        assert numbers == list(range(1, len(numbers) + 1))
    for each in replicas:
        assert "Traceback" not in each.log, each.log[-5000:]


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
