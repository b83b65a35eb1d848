"""A connection that is closed while its client sends."""

import asyncio
import errno
from typing import Any

from backend.http.lingering import LingeringTransport
from tests.servers import loops


class Reset:
    """A transport whose client resets the connection just before this side is shut."""

    def __init__(self, ended: asyncio.Event) -> None:
        self.abort = ended.set

    def is_closing(self) -> bool:
        return False

    def resume_reading(self) -> None:
        pass

    def write_eof(self) -> None:
        raise OSError(errno.ENOTCONN, "Transport endpoint is not connected")


def test_one_that_is_reset_just_then_ends_all_the_same() -> None:
    async def closed() -> None:
        ended = asyncio.Event()
        transport: Any = Reset(ended)
        LingeringTransport(transport, lambda: True, 0.0).close()
        await ended.wait()

    loops.run(closed)
