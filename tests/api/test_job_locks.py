"""Jobs on PostgreSQL, where transactions that change the same rows at once wait for one another."""

import asyncio
from dataclasses import replace

import pytest
from sqlalchemy import text

from backend.store import Store
from backend.store.jobs import lock
from tests.api.test_job_store import BATCH, computed, rows
from tests.servers import loops
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT
from tests.there import there

CHILD = replace(BATCH, id="child", parent_id=BATCH.id)


@pytest.fixture
def store(server_store: Store) -> Store:
    """One with a queued job and another that this one submitted."""
    for job in (BATCH, CHILD):
        server_store.jobs.create(job, rows())
    return server_store


async def waiting(store: Store, count: int) -> None:
    """Wait until so many transactions wait for others."""
    locked = text(
        "SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock' AND datname = current_database()"
    )
    async with asyncio.timeout(HANG_TIMEOUT):
        while True:
            with store.reading() as connection:
                if connection.execute(locked).scalar_one() >= count:
                    return
            await asyncio.sleep(0.01)


def test_a_job_goes_on_while_another_transaction_has_its_parent(store: Store) -> None:
    """Whoever cancels the parent has it, and waits for this job."""
    with store.writing() as connection:
        lock(connection, BATCH.id)
        store.jobs.start(CHILD.id)
        store.job_runs.save(CHILD.id, computed("key-0"), "1", {1: "too steep"})
        store.jobs.set_label(CHILD.id, "mine")
    job = there(store.jobs.load(CHILD.id))
    assert (job.state, job.done, job.failed, job.label) == ("running", 1, 1, "mine")


def test_a_transaction_that_is_rolled_back_for_a_deadlock_is_begun_again(postgres: Postgres, store: Store) -> None:
    before = postgres.log.count("deadlock detected")

    async def use() -> None:
        with store.writing() as other:
            other.exec_driver_sql("SET LOCAL deadlock_timeout = '1h'")  # it is the other one that looks, and is ended
            lock(other, CHILD.id)
            with store.writing() as first:
                lock(first, BATCH.id)
                cancelling = asyncio.create_task(store.write(store.jobs.cancel, BATCH.id))
                await waiting(store, 1)
                asking = asyncio.create_task(asyncio.to_thread(lock, other, BATCH.id))
                await waiting(store, 2)
            await asking
        await cancelling

    loops.run(use)
    assert [there(store.jobs.load(job.id)).state for job in (BATCH, CHILD)] == ["cancelled", "cancelled"]
    assert postgres.log.count("deadlock detected") == before + 1
