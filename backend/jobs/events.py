"""A job's events as server-sent events, as they happen: with numbers, replay and a heartbeat."""

import asyncio
import contextlib
from collections.abc import AsyncGenerator, AsyncIterator

from fastapi.sse import format_sse_event
from sqlalchemy.exc import SQLAlchemyError

from backend.gate import Gate
from backend.store import Store
from backend.store.job_events import EVENTS_AT_ONCE

JOB_POLL_INTERVAL = 1.0  # between two looks for events of other processes [s]
HEARTBEAT = 15.0  # a comment so often keeps a silent stream open [s]
RECONNECT = 2000  # a browser that lost the stream comes back after so long [ms]


async def server_sent(store: Store, job_id: str, after: int, gate: Gate, client: str) -> AsyncIterator[bytes]:
    """The stream's pieces, from the event behind number `after` to the one with the final state.

    Raises:
        TooManyRequestsError: The client has too many streams open.
        BusyError: The service has.
    """
    stream = _stream(store, job_id, after, gate, client)
    # The first piece now: a refusal is still an answer of its own, and from here on the stream ends itself.
    return _with_first(await anext(stream), stream)


async def _stream(store: Store, job_id: str, after: int, gate: Gate, client: str) -> AsyncGenerator[bytes, None]:
    clock = asyncio.get_running_loop().time
    with gate.streams.hold(client, 1), store.commits.following(job_id) as changes:
        yield f"retry: {RECONNECT}\n\n".encode()
        sent = clock()
        while True:
            changes.clear()
            try:
                events, ended = await store.read(store.job_events.news, job_id, after)
            except SQLAlchemyError:  # /readyz and the log have why; who reads this stream need not come again
                events, ended = [], False
            for event in events:
                after, sent = event.number, clock()
                yield format_sse_event(data_str=event.data, event=event.kind, id=str(event.number))
            if ended:
                return
            if len(events) == EVENTS_AT_ONCE:
                continue
            if clock() - sent > HEARTBEAT:
                sent = clock()
                yield b": still here\n\n"
            await changes.wait(JOB_POLL_INTERVAL)


async def _with_first(first: bytes, rest: AsyncGenerator[bytes, None]) -> AsyncIterator[bytes]:
    async with contextlib.aclosing(rest):
        yield first
        async for piece in rest:
            yield piece
