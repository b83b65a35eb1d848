"""Of several services on one PostgreSQL one drives the jobs. Where it hangs another one does, and nothing is twice.

The role is an ordinary one, as a service has it. The database's clock decides what is old; tests/drill/test_clocks.py
lets all clocks jump.
"""

import asyncio
import contextlib
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
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
from tests.servers import loops
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT

PASSWORD = "of-an-ordinary-role"  # noqa: S105


@pytest.fixture
def url(postgres: Postgres) -> str:
    """A database whose owner is no administrator."""
    address = make_url(postgres.new_database())
    role = f"owner_of_{address.database}"
    postgres.execute(f"CREATE ROLE {role} LOGIN PASSWORD '{PASSWORD}'")
    postgres.execute(f"ALTER DATABASE {address.database} OWNER TO {role}")
    return address.set(username=role, password=PASSWORD).render_as_string(hide_password=False)


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


def test_a_clock_that_jumps_ahead_makes_nothing_old_for_a_day(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The database's; the machine's own, which nobody sets, goes on."""
    now, seconds = datetime(2026, 3, 1, tzinfo=UTC), 0.0
    monkeypatch.setattr(sqlite, "_now", lambda: f"{now:%Y-%m-%d %H:%M:%S.%f}")
    monkeypatch.setattr(retention, "time", SimpleNamespace(monotonic=lambda: seconds))
    road = MeasuredRoad.of(np.zeros(100))
    with contextlib.closing(Store(f"sqlite:///{tmp_path / 'ridelab.sqlite'}")) as store:
        store.migrate()
        store.roads.save(road)
        removal = Retention(store, Settings(data_dir=Path("unused"), retention_days=30), store.write)

        def there() -> bool:
            loops.run(removal.apply)
            return road.id in store.roads.load([road.id])

        for days in (400, -400, 40):
            assert there()
            now, seconds = now + timedelta(days=days, seconds=600), seconds + 600
            assert there()
        now, seconds = now + timedelta(seconds=BELIEVED_AFTER), seconds + BELIEVED_AFTER
        assert not there()
