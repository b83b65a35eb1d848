"""Optional tokens: a file lists them; a request sends one in its header or, from the page, in a cookie."""

import hashlib
import hmac
import logging
import re
from pathlib import Path
from typing import Annotated

from fastapi import Depends, Request
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Receive, Scope, Send

from backend.http.problems import RequestError, problem

logger = logging.getLogger(__name__)

COOKIE = "ridelab_login"
LOGIN = "/api/v1/login"
CALLER = "caller"  # key in a scope's state: the name of the token

_LINE = re.compile(r"(?P<name>[A-Za-z0-9_.-]{1,64})\s+(?P<token>[A-Za-z0-9._~+/-]{16,256}={0,2})")  # RFC 6750, 2.1


def read_tokens(path: Path) -> dict[str, str]:
    """Each token's name and text.

    Args:
        path: A line for each, name and token with white space between; empty lines and those that begin with # count
            for nothing.

    Raises:
        OSError: It cannot be read.
        ValueError: A line is no such pair, a name or a token is there twice, or there is none; no token is repeated.
    """
    tokens: dict[str, str] = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        pair = _LINE.fullmatch(line.strip())
        if pair is None:
            raise ValueError(f"line {number} is not a name and a token of at least 16 characters")
        if pair["name"] in tokens or pair["token"] in tokens.values():
            raise ValueError(f"line {number} has a name or a token that was there before")
        tokens[pair["name"]] = pair["token"]
    if not tokens:
        raise ValueError("it has no token")
    return tokens


def cookie_of(token: str) -> str:
    """The value of the page's cookie: whoever reads it has no token for programs."""
    return _digest(f"cookie {token}")


class Tokens:
    """The tokens of a file, read again when it changes; while it cannot be read the last ones stay valid.

    Args:
        path: As `read_tokens` takes it; usable now.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._stamp = self._look()
        self._accept(read_tokens(path))

    def name_of_token(self, token: str) -> str | None:
        """The name of that token; None where there is none."""
        self._refresh()
        return _find(self._by_token, _digest(token))

    def name_of_cookie(self, value: str) -> str | None:
        """The name of the token for which the page got that cookie."""
        self._refresh()
        return _find(self._by_cookie, value)

    def _accept(self, tokens: dict[str, str]) -> None:
        self._by_token = {_digest(token): name for name, token in tokens.items()}
        self._by_cookie = {cookie_of(token): name for name, token in tokens.items()}

    def _look(self) -> tuple[int, int, int] | None:
        try:
            status = self._path.stat()
        except OSError:
            return None
        return status.st_mtime_ns, status.st_size, status.st_ino

    def _refresh(self) -> None:
        stamp = self._look()
        if stamp == self._stamp:
            return
        self._stamp = stamp
        try:
            self._accept(read_tokens(self._path))
        except (OSError, ValueError) as error:
            reason = error if type(error) is ValueError else type(error).__name__
            logger.error("The tokens stay as they were, their file cannot be used: %s", reason)
        else:
            logger.info("The tokens were read again")


class TokenMiddleware:
    """Lets only requests with a token use the API; the page, its login, health and metrics are open.

    Args:
        app: ASGI.
        tokens: Who may.
    """

    def __init__(self, app: ASGIApp, tokens: Tokens) -> None:
        self.app = app
        self._tokens = tokens

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] == "http":
            caller = self._caller(HTTPConnection(scope))
            scope.setdefault("state", {})[CALLER] = caller
            if caller is None and scope["path"].startswith("/api/") and scope["path"] != LOGIN:
                await problem("token-required")(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _caller(self, request: HTTPConnection) -> str | None:
        scheme, _, token = request.headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer":  # a program's: a cookie beside it counts for nothing
            return self._tokens.name_of_token(token.strip())
        cookie = request.cookies.get(COOKIE)
        return None if cookie is None else self._tokens.name_of_cookie(cookie)


async def caller(request: Request) -> str | None:
    """The name of the request's token; None where the service has no tokens."""
    name: str | None = getattr(request.state, CALLER, None)
    return name


Caller = Annotated[str | None, Depends(caller)]


def check_login(tokens: Tokens | None, token: str) -> str:
    """The value of the page's cookie for that token.

    Raises:
        RequestError: It is nobody's.
    """
    if tokens is None or tokens.name_of_token(token) is None:
        raise RequestError("token-required", "This is none of the service's tokens.")
    return cookie_of(token)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _find(names: dict[str, str], digest: str) -> str | None:
    """Search in constant time, so that the time tells nothing about a digest; all have equal length."""
    match = None
    for each, name in names.items():
        if hmac.compare_digest(each.encode(), digest.encode()):
            match = name
    return match
