"""Request bodies: one that comes too slowly is ended, and what a refused request still sends is read and dropped."""

import asyncio

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.http.problems import RequestError

LEAST_RATE = 50_000.0  # of a body, on the average [bytes/s]
GRACE = 10.0  # before the rate counts [s]
MOST_DROPPED = 8 * 1024 * 1024  # of a request that was answered before all of it came [bytes]
BODY_HEADERS = frozenset({b"content-length", b"transfer-encoding"})


class BodyRateMiddleware:
    """Raises a 408 problem where the application reads a body that comes too slowly.

    A client that sends before it reads would lose an answer that comes in the middle of its body: the connection would
    be reset. So the rest of the body is read first, as far as it is short and comes in time.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] != "http" or BODY_HEADERS.isdisjoint(name for name, _ in scope["headers"]):
            await self.app(scope, receive, send)
            return
        body = _Body(receive)

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start" and not await body.drop_rest():
                MutableHeaders(scope=message)["Connection"] = "close"
            await send(message)

        await self.app(scope, body.receive, answer)


class _Body:
    """What has come of one request's body."""

    def __init__(self, receive: Receive) -> None:
        self._receive = receive
        self._clock = asyncio.get_running_loop().time
        self._begin: float | None = None
        self._size = 0
        self._complete = self._slow = False

    async def receive(self) -> Message:
        """Return the next message; raises RequestError where it does not come in time."""
        if self._complete:
            return await self._receive()
        if self._begin is None:
            self._begin = self._clock()
        try:
            async with asyncio.timeout_at(self._begin + GRACE + self._size / LEAST_RATE):
                message = await self._receive()
        except TimeoutError:
            self._slow = True
            raise RequestError("slow-body") from None
        self._size += len(message.get("body", b""))
        self._complete = message["type"] == "http.disconnect" or not message.get("more_body", False)
        return message

    async def drop_rest(self) -> bool:
        """Read what has not come yet; False where that is too much or too slow."""
        end = self._size + MOST_DROPPED
        while not (self._complete or self._slow) and self._size <= end:
            try:
                await self.receive()
            except RequestError:
                break
        return self._complete
