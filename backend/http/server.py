"""HTTP/1.1 by uvicorn, with additional time limits and a bound on connections.

What never reaches the application (a malformed or slow head, one connection too many) is answered here, with the same
security headers and the same kind of problem.
"""

import asyncio
import logging
import socket
import struct
import sys
import termios
from fcntl import ioctl
from typing import TYPE_CHECKING, Any, cast
from uuid import uuid4

import h11
import uvicorn
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware
from uvicorn.protocols.http.h11_impl import H11Protocol

from backend.http.client_key import client_key
from backend.http.connections import Connections, Served
from backend.http.guard import CLOSE, HEADERS, HEALTH_ONLY
from backend.http.lingering import LingeringTransport
from backend.http.problems import RETRY_SOON, problem
from backend.http.request_log import HEADER
from backend.http.unread import UnreadAnswers
from backend.settings import Settings

if TYPE_CHECKING:
    from fastapi import FastAPI

logger = logging.getLogger(__name__)

MAX_UNREAD = 96 * 1024 * 1024  # of all answers that wait in memory for slow readers [bytes]
KEEP_ALIVE = 30  # longer than clients and proxies keep theirs, or one may send just as the other closes [s]
RESET_ON_CLOSE = struct.pack("ii", 1, 0)


class GuardedProtocol(H11Protocol):
    """One connection. A request's head has to come within a time, counted from the connection or its first byte."""

    HEAD_TIMEOUT = 10.0  # [s]
    WRITE_TIMEOUT = 60.0  # for which a client may take nothing of its answer [s]
    OPEN = Connections(per_client=200, total=800)
    UNREAD = UnreadAnswers(MAX_UNREAD)

    _timer: asyncio.TimerHandle | None = None
    _stuck: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # uvicorn's own type
        """Count the connection, and begin to wait for a request."""
        self._lingering = LingeringTransport(transport, self._body_comes, self.HEAD_TIMEOUT)
        super().connection_made(cast(asyncio.Transport, self._lingering))
        admission = self.OPEN.add(self, self.client[0] if self.client else "")
        if admission.served is Served.NOTHING:
            self._refuse("connections", status=admission.status)
            return
        if admission.served is Served.HEALTH:
            self.app_state = {**self.app_state, HEALTH_ONLY: admission.status}
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        """Count the connection as ended and stop its timers."""
        self.OPEN.remove(self)
        self.UNREAD.remove(self)
        self._relax()
        self._unstick()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Feed the parser; bytes that do not complete a request do not extend its time."""
        if self._body_comes() and not self._answering():
            self._lingering.drop(len(data))
        if self._lingering.lingers:
            return
        super().data_received(data)
        if self._answering():
            self._relax()
        else:
            self._watch()

    def on_response_complete(self) -> None:
        """Limit the time for the rest of a body that nobody reads."""
        self.OPEN.mark_used(self)
        super().on_response_complete()
        if self._body_comes() and not self._answering():
            self._watch()

    @property
    def idle(self) -> bool:
        """Whether no request is being answered, and no answer is still being sent."""
        return not self._answering() and not self.transport.get_write_buffer_size()

    def evict(self) -> None:
        """Close the connection to make room for another one."""
        self.transport.abort()

    def pause_writing(self) -> None:
        """Start a timer: the client reads more slowly than the service sends."""
        super().pause_writing()
        self._look_again()
        self.UNREAD.add(self)

    def resume_writing(self) -> None:
        """Stop the timer: the client reads again."""
        super().resume_writing()
        self.UNREAD.remove(self)
        self._unstick()

    @property
    def reader(self) -> str:
        """The client that reads."""
        # No scope before the first request, whatever uvicorn says; its client is the one behind a proxy.
        client = self.scope["client"] if self.scope else self.client  # type: ignore[redundant-expr]
        return client_key(client[0]) if client else ""

    @property
    def unread(self) -> int:
        """What waits in this process to be sent [bytes]."""
        return self.transport.get_write_buffer_size()

    def _look_again(self) -> None:
        """Look once more after `WRITE_TIMEOUT` whether the client has taken anything."""
        self._unstick()
        unread = self._unread_by_client()
        self._stuck = self.loop.call_later(self.WRITE_TIMEOUT, self._check_progress, unread)

    def _check_progress(self, unread: int) -> None:
        if self._unread_by_client() < unread:
            self._look_again()
        else:
            self.cut_off()

    def _unread_by_client(self) -> int:
        """What waits here and what the system has not delivered: that moves long before this does [bytes]."""
        try:
            queued = ioctl(self.transport.get_extra_info("socket"), termios.TIOCOUTQ, bytes(4))
        except OSError:  # another system, or closed just now
            return self.unread
        return self.unread + int.from_bytes(queued, sys.byteorder)

    def cut_off(self) -> None:
        """Reset the connection: the system would go on sending what the client does not read."""
        connection = self.transport.get_extra_info("socket")
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET_ON_CLOSE)
        self.transport.abort()

    def _unstick(self) -> None:
        if self._stuck is not None:
            self._stuck.cancel()
            self._stuck = None

    def send_400_response(self, msg: str) -> None:
        """Answer bytes that are not HTTP; the parser knows whether a head was only too long."""
        too_long = getattr(sys.exc_info()[1], "error_status_hint", 400) == 431
        self._refuse("headers-too-long" if too_long else "malformed-request", msg)

    def _body_comes(self) -> bool:
        """Whether a part of the request, or of what is none, has not come yet."""
        return self.conn.their_state in (h11.SEND_BODY, h11.ERROR)

    def _answering(self) -> bool:
        # None before the first request, as above
        return self.cycle is not None and not self.cycle.response_complete  # type: ignore[redundant-expr]

    def _watch(self) -> None:
        if self._timer is None and not self.transport.is_closing():
            self._timer = self.loop.call_later(self.HEAD_TIMEOUT, self._too_slow)

    def _relax(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _too_slow(self) -> None:
        self._timer = None
        if self._answering() or self.transport.is_closing():
            return
        began = bool(self.conn.trailing_data[0]) and self.conn.our_state is h11.IDLE
        if began:
            self._refuse("slow-head")
        else:
            self.transport.close()

    def _refuse(self, kind: str, detail: str | None = None, *, status: int | None = None) -> None:
        """Answer without the application, and close."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE):
            self.transport.abort()  # in the middle of another answer
            return
        name = uuid4().hex
        headers = {**HEADERS, HEADER: name, "Cache-Control": "no-store", **CLOSE}
        if kind == "connections":
            headers |= RETRY_SOON
        response = problem(kind, detail, status=status, headers=headers, name=name)
        logger.warning("Refused a connection: %s", kind, extra={"request_id": name})
        head = h11.Response(status_code=response.status_code, headers=response.raw_headers)
        for event in (head, h11.Data(data=bytes(response.body)), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()


def server_config(app: "FastAPI", settings: Settings) -> uvicorn.Config:
    """Uvicorn's configuration: these limits, our own logs, client addresses only from trusted proxies."""
    proxies = ProxyHeadersMiddleware(cast(Any, app), settings.forwarded_allow_ips).trusted_hosts  # as uvicorn reads it
    connections = Connections(
        per_client=settings.max_client_connections, total=settings.max_connections, is_proxy=proxies.__contains__
    )
    limits = {"HEAD_TIMEOUT": settings.head_timeout, "OPEN": connections, "UNREAD": UnreadAnswers(MAX_UNREAD)}
    return uvicorn.Config(
        app,
        http=type("ConfiguredProtocol", (GuardedProtocol,), limits),
        ws="none",
        proxy_headers=bool(settings.forwarded_allow_ips),
        forwarded_allow_ips=settings.forwarded_allow_ips,
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=KEEP_ALIVE,
        timeout_graceful_shutdown=3,
    )
