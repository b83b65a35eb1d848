"""Streams of a batch's events: beside other jobs, while the database is away, and as HEAD asks for them."""

import asyncio
from typing import Any

import pytest
from sqlalchemy.exc import OperationalError

from backend.jobs.events import server_sent
from tests.api.test_batches import LONG, events, submit
from tests.servers.batches import wait_for
from tests.servers.process import HANG_TIMEOUT, wait_until


def test_a_stream_outlives_a_database_that_is_away(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    batch = wait_for(
        service, submit(service, {"list": [{"road.bump.height": 0.05}]}, strategies=["passive"]).json()["id"]
    )
    store = service.services.store
    heard, news, fails = events(service, batch["id"]), store.job_events.news, iter([True, True, False])

    def unreliable(*arguments: Any) -> Any:
        if next(fails, False):
            raise OperationalError("SELECT", {}, Exception("the server is gone"))
        return news(*arguments)

    monkeypatch.setattr(store.job_events, "news", unreliable)
    assert events(service, batch["id"]) == heard


def test_a_stream_reads_nothing_when_another_job_changes(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    store, reads = service.services.store, asyncio.Queue[str]()

    def news(job_id: str, _: int) -> tuple[list[Any], bool]:
        service.loop.call_soon_threadsafe(reads.put_nowait, job_id)
        return [], False

    monkeypatch.setattr("backend.jobs.events.JOB_POLL_INTERVAL", HANG_TIMEOUT)
    monkeypatch.setattr(store.job_events, "news", news)

    async def follow() -> int:
        stream = aiter(await server_sent(store, "mine", 0, service.services.gate, "somebody"))
        await anext(stream)
        rest = asyncio.ensure_future(anext(stream))
        await reads.get()
        for _ in range(5):
            store.changed("another")
            await asyncio.sleep(0.02)
        others = reads.qsize()
        store.changed("mine")
        await reads.get()
        rest.cancel()
        await asyncio.wait({rest})
        return others

    assert service.inside(follow()) == 0


def test_head_of_the_events_of_a_running_batch_is_answered_at_once(service: Any) -> None:
    batch = submit(service, {"grid": {"road.seed": list(range(1, 1001))}}, scenario=LONG, strategies=["lv"]).json()
    path = f"/api/v1/batches/{batch['id']}"
    head = service.head(f"{path}/events")
    assert (head.status_code, head.headers["content-type"]) == (200, "text/event-stream; charset=utf-8")
    wait_until(lambda: not service.services.gate.load["streams"], "the stream has ended")
    assert service.post(f"{path}/cancel").json()["done"] < 1000
