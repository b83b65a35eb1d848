"""Gives each request a name, one log line and one observation in the latency histogram."""

import logging
import re
import time
from contextvars import ContextVar
from uuid import uuid4

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.metrics import LATENCY

access = logging.getLogger("backend.access")

HEADER = "X-Request-ID"
SANE = re.compile(r"[A-Za-z0-9_.-]{1,64}", re.ASCII)
METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT"})
QUIET = frozenset({"/healthz", "/readyz", "/metrics"})  # asked every few seconds: logged at level debug
GONE = 499  # the client went away before the answer: never sent, only counted

_current: ContextVar[str] = ContextVar("request_id", default="")


def request_id() -> str:
    """The name of the current request; empty outside one."""
    return _current.get()


class RequestLogMiddleware:
    """The outermost layer. Takes the request's name from the caller where it is harmless, else creates one."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        name = Headers(scope=scope).get(HEADER, "")
        if not SANE.fullmatch(name):
            name = uuid4().hex
        _current.set(name)
        begin = time.perf_counter()
        status, first = GONE, 0.0

        async def named(message: Message) -> None:
            nonlocal status, first
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers[HEADER] = name
                status = message["status"]
                if headers.get("content-type", "").startswith("text/event-stream"):
                    first = time.perf_counter() - begin
            await send(message)

        try:
            await self.app(scope, receive, named)
        finally:
            _note(scope, status, time.perf_counter() - begin, first)


def _note(scope: Scope, status: int, seconds: float, first: float) -> None:
    """One line and one observation; `first` is the time to the beginning of an event stream."""
    method = scope["method"] if scope["method"] in METHODS else "other"
    route = template(scope)
    LATENCY.labels(method, route, f"{status // 100}xx").observe(first or seconds)
    facts = {"method": method, "route": route, "status": status, "duration_ms": round(1000 * seconds, 2)}
    facts["client"] = scope["client"][0] if scope.get("client") else None
    if caller := scope.get("state", {}).get("caller"):
        facts["token"] = caller
    # Refusals are counted: a line for each takes of what a full service could do (tests/drill/test_load.py).
    quiet = route in QUIET or status in (429, 503)
    access.log(logging.DEBUG if quiet else logging.INFO, "request", extra=facts)


def template(scope: Scope) -> str:
    """The address with the names of its path parameters instead of values; `none` where no route matched."""
    path: str = getattr(scope.get("route"), "path", "")
    mount: str = scope.get("root_path", "").removeprefix(scope.get("app_root_path", ""))
    if mount and "app_root_path" in scope:
        return f"{mount}/{{file}}"
    return path or "none"
