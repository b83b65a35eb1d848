"""Optional tokens, which a file lists."""

import hashlib
import hmac
import logging
from pathlib import Path
from typing import Annotated

from fastapi import Depends, Request

from backend.token_file import read_tokens

logger = logging.getLogger(__name__)

CALLER = "caller"  # key in a scope's state: the name of the token


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


async def caller(request: Request) -> str | None:
    """The name of the request's token; None where the service has no tokens."""
    name: str | None = getattr(request.state, CALLER, None)
    return name


Caller = Annotated[str | None, Depends(caller)]


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _find(names: dict[str, str], digest: str) -> str | None:
    """Search in constant time, so that the time tells nothing about a digest; all have equal length."""
    match = None
    for each, name in names.items():
        if hmac.compare_digest(each.encode(), digest.encode()):
            match = name
    return match
