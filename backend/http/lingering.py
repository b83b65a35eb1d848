"""Closing a connection whose client still sends: reset at once, the client would lose its answer."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from typing import Any

MAX_DROPPED = 32 * 1024 * 1024  # of what a client sends after its answer; beyond it is reset all the same [bytes]


class LingeringTransport:
    """A connection's transport; `close` shuts only this side while the client sends on, and drops what still comes.

    Args:
        transport: The connection's own.
        still_sends: Whether a part of the client's request has not come yet.
        seconds: For which it drops what comes, before it resets the connection.
    """

    def __init__(self, transport: asyncio.Transport, still_sends: Callable[[], bool], seconds: float) -> None:
        self._transport = transport
        self._still_sends = still_sends
        self._seconds = seconds
        self._dropped = 0
        self._lingers = False

    def __getattr__(self, name: str) -> Any:
        """All the rest is the transport's own."""
        return getattr(self._transport, name)

    @property
    def lingers(self) -> bool:
        """Whether this side is shut, and what comes has to be dropped."""
        return self._lingers

    def is_closing(self) -> bool:
        """Whether nothing more can be sent."""
        return self._lingers or self._transport.is_closing()

    def close(self) -> None:
        """Send what was written, and close as soon as the client has stopped sending."""
        if self.is_closing():
            return
        if not self._still_sends():
            self._transport.close()
            return
        self._lingers = True
        self._transport.resume_reading()
        asyncio.get_running_loop().call_later(self._seconds, self._transport.abort)
        with suppress(OSError):  # the client has reset it just now
            self._transport.write_eof()

    def drop(self, size: int) -> None:
        """Count bytes that came after the answer; too many of them end the connection."""
        self._dropped += size
        if self._dropped > MAX_DROPPED:
            self._transport.abort()
