"""Server-sent events of something that is stored, as they happen: with numbers, replay and a heartbeat."""

import asyncio
import contextlib
from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable, Sequence
from typing import Protocol

from fastapi.sse import format_sse_event

from backend.http.admission import Admission

LOOK = 0.4  # between two looks for events [s]
HEARTBEAT = 15.0  # a comment so often keeps a silent stream open [s]
RECONNECT = 2000  # a browser that lost the stream comes back after so long [ms]


class StoredEvent(Protocol):
    """What is told; `data` is JSON text."""

    @property
    def number(self) -> int:
        """Its place in the order."""

    @property
    def kind(self) -> str:
        """What it tells."""

    @property
    def data(self) -> str:
        """The telling."""


async def server_sent(
    *,
    ended: Callable[[], Awaitable[bool]],
    events: Callable[[int], Awaitable[Sequence[StoredEvent]]],
    after: int,
    admission: Admission,
    client: str,
) -> AsyncIterator[bytes]:
    """The stream's pieces.

    Args:
        ended: Whether nothing more will happen.
        events: Those behind a number.
        after: Where to begin.
        admission: Counts open streams.
        client: Who listens.

    Raises:
        TemporaryError: Too many streams are open.
    """
    stream = _stream(ended, events, after, admission, client)
    # The first piece now: a refusal is still an answer of its own, and from here on the stream ends itself.
    return _with_first(await anext(stream), stream)


async def _stream(
    ended: Callable[[], Awaitable[bool]],
    events: Callable[[int], Awaitable[Sequence[StoredEvent]]],
    after: int,
    admission: Admission,
    client: str,
) -> AsyncGenerator[bytes, None]:
    clock = asyncio.get_running_loop().time
    with admission.streaming(client):
        yield f"retry: {RECONNECT}\n\n".encode()
        spoke = clock()
        while True:
            last = await ended()  # before the events: none can come behind those of what has ended
            for event in await events(after):
                after, spoke = event.number, clock()
                yield format_sse_event(data_str=event.data, event=event.kind, id=str(event.number))
            if last:
                return
            if clock() - spoke > HEARTBEAT:
                spoke = clock()
                yield b": still here\n\n"
            await asyncio.sleep(LOOK)


async def _with_first(first: bytes, rest: AsyncGenerator[bytes, None]) -> AsyncIterator[bytes]:
    async with contextlib.aclosing(rest):
        yield first
        async for piece in rest:
            yield piece
