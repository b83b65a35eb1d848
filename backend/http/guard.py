"""The outermost layer: security headers on every answer, and an answer even where the service has a bug."""

import asyncio
import logging
from collections.abc import Collection, Iterable
from urllib.parse import urlsplit

from starlette.datastructures import MutableHeaders
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.http.problems import problem

logger = logging.getLogger(__name__)


# Styles are inline in what React components and plotly draw; nothing evaluates text as script.
def policy(scripts: Iterable[str] = ()) -> str:
    """The content security policy of a page; `scripts` are the hashes of those inside it."""
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
    "Content-Security-Policy": policy(),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}

CLOSE = {"Connection": "close"}
LONGEST_ADDRESS = 8192  # [bytes]
LONGEST_HEADERS = 16384  # [bytes]; a head that comes in pieces ends in the server's parser at the same length
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})  # methods that change nothing
HEALTH = frozenset({"/healthz", "/readyz", "/metrics"})  # asked inside a deployment, by any host name
LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})  # what this machine calls itself
MATCHED = ("route", "root_path", "app_root_path")  # what routing leaves in a scope


class GuardMiddleware:
    """Adds the headers, answers HEAD where GET is, and an unforeseen exception with a 500 problem.

    What the service cannot wait for when it ends is answered with a 503.

    Args:
        app: ASGI.
        hosts: Host names the service answers to; `*.example.com` is every subdomain. Empty, or with `*`: any host.
    """

    def __init__(self, app: ASGIApp, hosts: Collection[str] = ()) -> None:
        self.app = app
        self._hosts = () if "*" in hosts else hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        head = scope["method"] == "HEAD"
        started = False

        async def guarded(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
                headers.setdefault("Cache-Control", "no-store")
            elif head:
                return
            await send(message)
            if head:  # that is all: the application learns that nobody waits for more, even where it would never end
                await send({"type": "http.response.body", "body": b""})

        inner = {**scope, "method": "GET"} if head else scope
        if scope["path"].startswith("/api/") and scope["path"].endswith("/"):
            # Answered as it is: the address of a redirect would come from the request.
            inner = {**inner, "path": scope["path"].rstrip("/"), "raw_path": scope["raw_path"].rstrip(b"/")}
        try:
            await (self._check_head(scope) or self.app)(inner, receive, guarded)
        except ClientDisconnect:
            return  # nobody is left to answer
        except asyncio.CancelledError:  # the service ends and could wait no longer for what this waits for
            if started:
                raise
            await problem("unavailable", headers={"Retry-After": "2"})(inner, receive, guarded)
        except Exception:
            logger.exception("An unforeseen error")
            if started:
                raise  # too late for another answer: the server breaks the connection off
            await problem("internal-error")(inner, receive, guarded)
        finally:
            scope.update({key: inner[key] for key in MATCHED if key in inner})  # for those outside, HEAD or GET

    def _check_head(self, scope: Scope) -> Response | None:
        """Return the problem that answers a head which is refused; None where it is accepted."""
        headers: list[tuple[bytes, bytes]] = scope["headers"]
        if len(scope["raw_path"]) + len(scope["query_string"]) > LONGEST_ADDRESS:
            return problem("address-too-long", f"The address may have {LONGEST_ADDRESS} characters.", headers=CLOSE)
        if sum(len(name) + len(value) + 4 for name, value in headers) > LONGEST_HEADERS:
            return problem("headers-too-long", f"The headers may have {LONGEST_HEADERS} bytes in all.", headers=CLOSE)
        if {b"content-length", b"transfer-encoding"} <= {name for name, _ in headers}:
            # A proxy before us may have believed the other one: what follows on this connection is anybody's.
            return problem("two-lengths", "The request body has two lengths.", headers=CLOSE)
        if self._is_of_another_site(scope):
            return problem("cross-site")
        if (
            self._hosts
            and scope["path"] not in HEALTH
            and not _matches_any(self._hosts, _hostname(dict(headers).get(b"host", b"").decode("latin-1")))
        ):
            return problem("other-host")
        return None

    def _is_of_another_site(self, scope: Scope) -> bool:
        """Whether another site's page had a browser send this, and it would change something or compute.

        What a browser says by itself, `Sec-Fetch-*`, it says over HTTPS and to this machine only; `Origin` it says to
        everybody, but not of a GET. A link may lead to an answer of the API; a picture, a frame or a script may not.
        """
        headers = dict(scope["headers"])
        site, origin = headers.get(b"sec-fetch-site"), headers.get(b"origin")
        if scope["method"] in SAFE:
            opened = (headers.get(b"sec-fetch-mode"), headers.get(b"sec-fetch-dest")) == (b"navigate", b"document")
            is_link = opened and b"sec-purpose" not in headers  # which a page fetched in advance has
            return site == b"cross-site" and scope["path"].startswith("/api/") and not is_link
        if site in (b"same-origin", b"none"):
            return False
        return site == b"cross-site" or (origin is not None and not self._is_own(origin, headers.get(b"host", b"")))

    def _is_own(self, origin: bytes, host: bytes) -> bool:
        """Check whether an origin is the host that was asked, or one that the service answers to.

        Of this machine's own names the port has to be the same too: another program may serve a page at another one.
        """
        netloc = origin.decode("latin-1").lower().partition("://")[2]  # of `null` nothing is left
        name = _hostname(netloc)
        return netloc == host.decode("latin-1").lower() or (name not in LOOPBACK and _matches_any(self._hosts, name))


def _hostname(netloc: str) -> str:
    """The name in a host with perhaps a port; empty where it is none."""
    try:
        return urlsplit(f"//{netloc}").hostname or ""
    except ValueError:
        return ""


def _matches_any(hosts: Collection[str], host: str) -> bool:
    return any(host == name or (name.startswith("*.") and host.endswith(name[1:])) for name in hosts)
