"""The page's logins: a cookie for each, which is worth nothing once the login has ended or its token is gone."""

import hashlib
import hmac
import secrets
import time
from collections.abc import Awaitable, Callable

from cachetools import TTLCache

from backend.http.tokens import Tokens, cookie_key

COOKIE = "ridelab_login"
LOGIN = "/api/v1/login"
LIFETIME = 90 * 86400  # of a login [s]
RECHECK_AFTER = 5.0  # a login that another replica has ended counts for at most so long [s]
MAX_CHECKED = 10_000  # logins


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
