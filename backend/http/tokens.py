"""Optional tokens, which a file lists, the logins of the page with one, and the layer that asks for either."""

import hashlib
import hmac
import logging
import secrets
import time
from collections.abc import Awaitable, Callable
from pathlib import Path

from cachetools import TTLCache
from sqlalchemy.exc import SQLAlchemyError
from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.http.problems import problem
from backend.token_file import read_tokens

logger = logging.getLogger(__name__)

CALLER = "caller"  # key in a scope's state: the name of the token
COOKIE = "ridelab_login"
LOGIN = "/api/v1/login"
LIFETIME = 90 * 86400  # of a login [s]
RECHECK_AFTER = 5.0  # a login that another replica has ended counts for at most so long [s]
MAX_CHECKED = 10_000  # logins


def cookie_key(token: str) -> str:
    """With which the cookies of a token's logins are sealed."""
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

    def cookie_keys(self) -> dict[str, str]:
        """The name of each token by its `cookie_key`."""
        self._refresh()
        return self._by_cookie_key

    def _accept(self, tokens: dict[str, str]) -> None:
        self._by_token = {_digest(token): name for name, token in tokens.items()}
        self._by_cookie_key = {cookie_key(token): name for name, token in tokens.items()}

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


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _find(names: dict[str, str], digest: str) -> str | None:
    """Search in constant time, so that the time tells nothing about a digest; all have equal length."""
    match = None
    for each, name in names.items():
        if hmac.compare_digest(each.encode(), digest.encode()):
            match = name
    return match


class Logins:
    """Begins, recognises and ends logins.

    A cookie is `TIME-NONCE.SEAL`: when the login began [s, hexadecimal], its name, and a seal that nobody makes without
    the token.

    Args:
        tokens: Who may log in.
        remember: Stores for all replicas that a login has ended.
        has_ended: Whether that is stored.
    """

    def __init__(
        self,
        tokens: Tokens,
        *,
        remember: Callable[[str], Awaitable[None]],
        has_ended: Callable[[str], Awaitable[bool]],
    ) -> None:
        self._tokens = tokens
        self._remember = remember
        self._has_ended = has_ended
        self._open: TTLCache[str, bool] = TTLCache(MAX_CHECKED, RECHECK_AFTER)

    def begin(self, token: str) -> str | None:
        """The value of the page's cookie for that token; None where it is nobody's."""
        if self._tokens.name_of_token(token) is None:
            return None
        login = f"{int(time.time()):x}-{secrets.token_urlsafe(16)}"
        return f"{login}.{_seal(cookie_key(token), login)}"

    async def name(self, cookie: str) -> str | None:
        """The name of the token for which the page got that cookie; None where it is worth nothing."""
        login, _, seal = cookie.rpartition(".")
        name = None
        for key, each in self._tokens.cookie_keys().items():  # all of them: the time tells nothing about a seal
            if hmac.compare_digest(_seal(key, login).encode(), seal.encode()):
                name = each
        if name is None or abs(time.time() - int(login.partition("-")[0], 16)) > LIFETIME:  # a clock was ahead
            return None
        if login not in self._open:
            if await self._has_ended(login):
                return None
            self._open[login] = True  # only here: what is used all the time has to be checked again too
        return name

    async def end(self, cookie: str) -> None:
        """Have a cookie be worth nothing from now on."""
        if await self.name(cookie) is not None:
            login = cookie.rpartition(".")[0]
            await self._remember(login)
            self._open.pop(login, None)


def _seal(key: str, login: str) -> str:
    return hmac.new(key.encode(), login.encode(), hashlib.sha256).hexdigest()


class TokenMiddleware:
    """Lets only requests with a token use the API; the page, its login, health and metrics are open.

    What the API answers no cache shared by several people may keep, and no cache may give to others than it was for.

    Args:
        app: ASGI.
        tokens: Who may.
        logins: Of the page.
    """

    def __init__(self, app: ASGIApp, tokens: Tokens, logins: Logins) -> None:
        self.app = app
        self._tokens = tokens
        self._logins = logins

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        of_api = scope["path"].startswith("/api/")
        try:
            caller = await self._caller(HTTPConnection(scope))
        except SQLAlchemyError:
            if of_api:
                await problem("store-unavailable", headers={"Retry-After": "5"})(scope, receive, send)
                return
            caller = None
        scope.setdefault("state", {})[CALLER] = caller

        async def private(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                if "cache-control" in headers:
                    headers["Cache-Control"] = headers["cache-control"].replace("public", "private")
                    headers.add_vary_header("Authorization")
                    headers.add_vary_header("Cookie")
            await send(message)

        if caller is None and of_api and scope["path"] != LOGIN:
            await problem("token-required")(scope, receive, send)
        else:
            await self.app(scope, receive, private if of_api else send)

    async def _caller(self, request: HTTPConnection) -> str | None:
        scheme, _, token = request.headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer":  # a program's: a cookie beside it counts for nothing
            return self._tokens.name_of_token(token.strip())
        cookie = request.cookies.get(COOKIE)
        return None if cookie is None else await self._logins.name(cookie)
