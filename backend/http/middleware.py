"""The outermost layer: names, times and logs each request, refuses heads, ends slow bodies, adds security headers."""

import asyncio
import logging
import re
import time
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from urllib.parse import urlsplit
from uuid import uuid4

from starlette.datastructures import MutableHeaders
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.http.problems import RequestError, problem
from backend.logs import REQUEST_ID
from backend.metrics import LATENCY

logger = logging.getLogger(__name__)
access = logging.getLogger("backend.access")


def content_security_policy(scripts: Iterable[str] = ()) -> str:
    """Return a page's policy; `scripts` are the hashes of those inside it.

    Styles are inline in what React components and plotly draw; nothing evaluates text as script.
    """
    return "; ".join(
        (
            "default-src 'self'",
            " ".join(("script-src 'self'", *scripts)),
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "font-src 'self' data:",
            "connect-src 'self'",
            "worker-src 'self' blob:",
            "object-src 'none'",
            "base-uri 'none'",
            "form-action 'self'",
            "frame-ancestors 'none'",
        )
    )


HEADERS = {
    "Content-Security-Policy": content_security_policy(),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
ID_HEADER = "X-Request-ID"
HARMLESS_ID = re.compile(r"[A-Za-z0-9_.-]{1,64}", re.ASCII)
CLOSE = {"Connection": "close"}
LONGEST_ADDRESS = 8192  # [bytes]
LONGEST_HEADERS = 16384  # [bytes]; a head that comes in pieces ends in the server's parser at the same length
BODY_HEADERS = frozenset({b"content-length", b"transfer-encoding"})
LEAST_RATE = 50_000.0  # of a body, on the average [bytes/s]
GRACE = 10.0  # before the rate counts [s]
MOST_DROPPED = 8 * 1024 * 1024  # of a request that was answered before all of it came [bytes]
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})  # methods that change nothing
METHODS = SAFE | {"POST", "PUT", "PATCH", "DELETE", "TRACE", "CONNECT"}
HEALTH = frozenset({"/healthz", "/readyz", "/metrics"})  # asked inside a deployment every few seconds, by any host name
LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})  # what this machine calls itself
MATCHED = ("route", "root_path", "app_root_path")  # what routing leaves in a scope
GONE = 499  # the client went away before the answer: never sent, only counted


class RequestMiddleware:
    """Takes a request's id from the caller where it is harmless; answers HEAD where GET is, and 500 for a bug.

    What the service cannot wait for when it ends is answered with a 503.

    Args:
        app: ASGI.
        hosts: Host names the service answers to; `*.example.com` is every subdomain. Empty, or with `*`: any host.
    """

    def __init__(self, app: ASGIApp, hosts: Collection[str] = ()) -> None:
        self.app = app
        self._hosts = () if "*" in hosts else hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handle a request, as ASGI asks."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        headers: dict[bytes, bytes] = dict(scope["headers"])
        sent_id = headers.get(ID_HEADER.lower().encode(), b"").decode("latin-1")
        request_id = sent_id if HARMLESS_ID.fullmatch(sent_id) else uuid4().hex
        REQUEST_ID.set(request_id)
        is_head = scope["method"] == "HEAD"
        exchange = _Exchange(scope, receive, send, request_id, is_head, BODY_HEADERS.isdisjoint(headers))
        inner = {**scope, "method": "GET"} if is_head else scope
        if scope["path"].startswith("/api/") and scope["path"].endswith("/"):
            # Answered as it is: the address of a redirect would come from the request.
            inner = {**inner, "path": scope["path"].rstrip("/"), "raw_path": scope["raw_path"].rstrip(b"/")}
        try:
            await (self._refusal(scope, headers) or self.app)(inner, exchange.receive, exchange.send)
        except ClientDisconnect:
            pass  # nobody is left to answer
        except asyncio.CancelledError:  # the service ends and could wait no longer for what this waits for
            if exchange.status != GONE:
                raise
            await problem("unavailable", headers={"Retry-After": "2"})(inner, exchange.receive, exchange.send)
        except Exception:  # a bug of ours: the client gets a 500, the log what it was
            logger.exception("An unforeseen error")
            if exchange.status != GONE:
                raise  # too late for another answer: the server breaks the connection off
            await problem("internal-error")(inner, exchange.receive, exchange.send)
        finally:
            scope.update({key: inner[key] for key in MATCHED if key in inner})  # of HEAD, too
            exchange.log()

    def _refusal(self, scope: Scope, headers: dict[bytes, bytes]) -> Response | None:
        """Return the problem that answers a head which is refused; None where it is accepted."""
        if len(scope["raw_path"]) + len(scope["query_string"]) > LONGEST_ADDRESS:
            return problem("address-too-long", f"The address may have {LONGEST_ADDRESS} characters.", headers=CLOSE)
        if sum(len(name) + len(value) + 4 for name, value in scope["headers"]) > LONGEST_HEADERS:
            return problem("headers-too-long", f"The headers may have {LONGEST_HEADERS} bytes in all.", headers=CLOSE)
        if headers.keys() >= BODY_HEADERS:
            # A proxy before us may have believed the other one: what follows on this connection is anybody's.
            return problem("two-lengths", "The request body has two lengths.", headers=CLOSE)
        if (b"origin" in headers or b"sec-fetch-site" in headers) and self._is_of_another_site(scope, headers):
            return problem("cross-site")
        host = headers.get(b"host", b"").decode("latin-1")
        if self._hosts and scope["path"] not in HEALTH and not self._answers_to(host):
            return problem("other-host")
        return None

    def _is_of_another_site(self, scope: Scope, headers: dict[bytes, bytes]) -> bool:
        """Check whether another site's page had a browser send this, and it would change something or compute.

        What a browser says by itself, `Sec-Fetch-*`, it says over HTTPS and to this machine only; `Origin` it says to
        everybody, but not of a GET. A link may lead to an answer of the API; a picture, a frame or a script may not.
        An origin is ours where it is the host that was asked, or one that the service answers to; of this machine's own
        names the port has to be the same too: another program may serve a page at another one.
        """
        site, origin = headers.get(b"sec-fetch-site"), headers.get(b"origin")
        if scope["method"] in SAFE:
            opened = (headers.get(b"sec-fetch-mode"), headers.get(b"sec-fetch-dest")) == (b"navigate", b"document")
            is_link = opened and b"sec-purpose" not in headers  # which a page fetched in advance has
            return site == b"cross-site" and scope["path"].startswith("/api/") and not is_link
        if site in (b"same-origin", b"none"):
            return False
        if site == b"cross-site" or origin is None:
            return site == b"cross-site"
        own = origin.decode("latin-1").lower().partition("://")[2]  # of `null` nothing is left
        same_host = own == headers.get(b"host", b"").decode("latin-1").lower()
        return not (same_host or self._answers_to(own, excluding=LOOPBACK))

    def _answers_to(self, host: str, *, excluding: Collection[str] = ()) -> bool:
        """Check whether the service answers to a host, perhaps with a port, that has none of the names excluded."""
        try:
            name = urlsplit(f"//{host}").hostname or ""
        except ValueError:
            return False
        matches = (name == each or (each.startswith("*.") and name.endswith(each[1:])) for each in self._hosts)
        return name not in excluding and any(matches)


@dataclass(eq=False, slots=True)
class _Exchange:
    """One request's body as it comes, and its answer as it goes.

    Attributes:
        is_head: Only the answer's head is asked for.
        body_complete: All of the body has come.
        status: Of the answer; GONE until it begins.
    """

    scope: Scope
    _receive: Receive
    _send: Send
    request_id: str
    is_head: bool
    body_complete: bool
    status: int = GONE
    _begin: float = field(default_factory=time.perf_counter)
    _stream_begin: float = 0.0  # of an event stream's answer [s]
    _body_begin: float | None = None
    _body_size: int = 0

    async def receive(self) -> Message:
        """Return the next message; raises RequestError where the body comes too slowly."""
        if self.body_complete:
            return await self._receive()
        clock = asyncio.get_running_loop().time
        self._body_begin = self._body_begin or clock()
        try:
            async with asyncio.timeout_at(self._body_begin + GRACE + self._body_size / LEAST_RATE):
                message = await self._receive()
        except TimeoutError:
            raise RequestError("slow-body") from None
        self._body_size += len(message.get("body", b""))
        self.body_complete = message["type"] == "http.disconnect" or not message.get("more_body", False)
        return message

    async def send(self, message: Message) -> None:
        """Send a message of the answer; of one to HEAD the head alone."""
        if message["type"] == "http.response.start":
            self.status = message["status"]
            headers = MutableHeaders(scope=message)
            for name, value in HEADERS.items():
                headers.setdefault(name, value)
            headers.setdefault("Cache-Control", "no-store")
            headers[ID_HEADER] = self.request_id
            if headers.get("content-type", "").startswith("text/event-stream"):
                self._stream_begin = time.perf_counter()
            if not (self.body_complete or await self._drop_body()):
                headers["Connection"] = "close"
        elif self.is_head:
            return
        await self._send(message)
        if self.is_head:  # all: the application learns that nobody waits for more, even where it would never end
            await self._send({"type": "http.response.body", "body": b""})

    async def _drop_body(self) -> bool:
        """Read the rest of the body; False where that is too much or comes too slowly.

        A client that sends before it reads would lose an answer that comes in the middle of its body: the connection
        would be reset.
        """
        end = self._body_size + MOST_DROPPED
        try:
            while not self.body_complete and self._body_size <= end:
                await self.receive()
        except RequestError:
            pass
        return self.body_complete

    def log(self) -> None:
        """Write one line and one observation: of an event stream the time to its beginning.

        The route is the address with the names of its parameters in place of their values; `none` where none matched.
        """
        now, scope, status = time.perf_counter(), self.scope, self.status
        duration = round(1000 * (now - self._begin), 2)
        method = scope["method"] if scope["method"] in METHODS else "other"
        mount = scope.get("root_path", "").removeprefix(scope.get("app_root_path", ""))
        is_mounted = mount and "app_root_path" in scope
        route = f"{mount}/{{file}}" if is_mounted else getattr(scope.get("route"), "path", "") or "none"
        LATENCY.labels(method, route, f"{status // 100}xx").observe((self._stream_begin or now) - self._begin)
        facts = {"method": method, "route": route, "status": status, "duration_ms": duration}
        facts["client"] = scope["client"][0] if scope.get("client") else None
        if caller := scope.get("state", {}).get("caller"):
            facts["token"] = caller
        # Refusals are counted: a line for each takes of what a full service could do (tests/drill/test_load.py).
        quiet = route in HEALTH or status in (429, 503)
        access.log(logging.DEBUG if quiet else logging.INFO, "request", extra=facts)
