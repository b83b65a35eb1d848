"""Requests that are repeated where that is safe: a bounded number of times, after the wait the service asks for.

All of them raise `RidelabAPIError` where the service refuses, `RidelabConnectionError` where none answers.
"""

import itertools
import json
import re
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Any

import httpx

from ridelab.errors import RidelabAPIError, RidelabConnectionError

FULL = (429, 503)
FIRST_PAUSE = 0.2  # before the first repetition after a lost connection, then twice as long each time [s]
LONGEST_WAIT = 60.0  # all waits for one answer together, and so the longest Retry-After obeyed [s]
_LOGIN = re.compile(r"(?<=://)[^/?#\s]*@")


def without_login(text: str) -> str:
    """The text without logins in its addresses: `http://user:password@host` becomes `http://host`."""
    return _LOGIN.sub("", text)


def split_login(address: str) -> tuple[httpx.URL, httpx.BasicAuth | None]:
    """The address without its login, and the login.

    Raises:
        ValueError: That is no HTTP address.
    """
    try:
        url = httpx.URL(address)
    except httpx.InvalidURL:
        url = httpx.URL("")
    if url.scheme not in ("http", "https") or not url.host:
        raise ValueError("A service's address begins with http:// or https:// and names a host")
    login = httpx.BasicAuth(url.username, url.password) if url.userinfo else None
    return httpx.URL(without_login(str(url))), login


class Http:
    """An httpx client that repeats a request at most `retries` times; `sleep` waits that many seconds.

    Each answer is waited for within what `meanwhile` gives.
    """

    def __init__(
        self, client: httpx.Client, *, retries: int = 5, sleep: Callable[[float], object] = time.sleep
    ) -> None:
        self.client = client
        self.sleep = sleep
        self.meanwhile: Callable[[], AbstractContextManager[object]] = nullcontext
        self._retries = retries

    @property
    def address(self) -> str:
        """The service's address, without a login and a slash at the end."""
        return without_login(str(self.client.base_url)).rstrip("/")

    def json(self, method: str, path: str, **request: Any) -> dict[str, Any]:
        """The answer's JSON, an object most often; the arguments are those of `send`."""
        response = self.send(method, path, **request)
        try:
            answer: dict[str, Any] = response.json()
        except ValueError:
            raise self._foreign(response) from None
        return answer

    def send(
        self,
        method: str,
        path: str,
        *,
        body: Any = None,
        params: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
        repeatable: bool = True,
        stream: bool = False,
        silence: float | None = None,
    ) -> httpx.Response:
        """The answer, after repeated requests where needed.

        Args:
            method: HTTP method.
            path: Below the service's address.
            body: Sent as JSON, pydantic models and NumPy values as plain ones; bytes are a file, sent as it is.
            params: Query; entries that are None are left out.
            headers: More headers.
            repeatable: Asking twice does what asking once does; else a request that may have arrived is not repeated.
            stream: Leave its content to be read piece by piece.
            silence: At most so long between two pieces [s]; None is the client's own limit.
        """
        as_it_is = body is None or isinstance(body, bytes)
        content = body if as_it_is else json.dumps(body, allow_nan=False, default=plain)
        kind = "text/csv" if isinstance(body, bytes) else "application/json"
        more = {**({} if body is None else {"Content-Type": kind}), **(headers or {})}
        sent = {key: value for key, value in (params or {}).items() if value is not None}
        request = self.client.build_request(method, path, params=sent, headers=more, content=content)
        if silence is not None:
            request.extensions["timeout"] = {**request.extensions["timeout"], "read": silence}
        left = LONGEST_WAIT
        for number in itertools.count():
            pause: float | None = FIRST_PAUSE * 2**number
            try:
                with self.meanwhile():
                    response = self.client.send(request, stream=stream)
            except httpx.TransportError as error:
                arrived = not isinstance(error, httpx.ConnectError | httpx.ConnectTimeout)
                # One that is being worked on is not asked for again: that makes it worse.
                if (arrived and not repeatable) or isinstance(error, httpx.ReadTimeout):
                    pause = None
                hint = "Is a service running there? ridelab serve starts one"
                failure: Exception = RidelabConnectionError(f"No answer from {self.address}: {_reason(error)}. {hint}")
                failure.__cause__ = error
            else:
                if response.is_success:
                    return response
                response.read()
                response.close()
                after = response.headers.get("Retry-After", "").strip() if response.status_code in FULL else ""
                pause = float(after) if after.isdecimal() else None
                failure = self._refusal(response)
            if pause is None or number == self._retries or pause > left:
                raise failure
            left -= pause
            self.sleep(pause)
        raise AssertionError  # the count has no end

    @contextmanager
    def stream(self, path: str, **request: Any) -> Iterator[httpx.Response]:
        """A GET whose answer is read piece by piece; the arguments are those of `send`."""
        response = self.send("GET", path, stream=True, **request)
        try:
            yield response
        except httpx.TransportError as error:
            raise RidelabConnectionError(f"The answer of {self.address} broke off: {_reason(error)}") from error
        finally:
            response.close()

    def _refusal(self, response: httpx.Response) -> Exception:
        status = response.status_code
        try:
            problem = response.json()
        except ValueError:
            problem = None
        if isinstance(problem, dict) and "status" in problem:
            return RidelabAPIError.of(status, problem)
        if status in (401, 403):  # by a proxy, most often
            return RidelabAPIError(status, f"{self.address} {_why_unauthorised(response)} (HTTP {status})")
        if status >= 500:  # a proxy before a service that is away
            return RidelabConnectionError(f"{self.address} answers {status} {response.reason_phrase}")
        return self._foreign(response)

    def _foreign(self, response: httpx.Response) -> RidelabConnectionError:
        return RidelabConnectionError(
            f"{self.address} does not answer as Ridelab does (HTTP {response.status_code}); is the address right?"
        )


def plain(value: Any) -> Any:
    """A JSON form of what has none: a pydantic model (a `Scenario`), NumPy values, other mappings and sequences."""
    if hasattr(value, "model_dump"):
        return value.model_dump(mode="json")
    if hasattr(value, "tolist"):
        return value.tolist()
    return dict(value) if isinstance(value, Mapping) else list(value)


def _why_unauthorised(response: httpx.Response) -> str:
    if response.status_code == 403:
        return "does not let this request in"
    sent = response.request.headers.get("Authorization", "")
    if sent:
        return f"refuses the {'token' if sent.startswith('Bearer ') else 'login in its address'}"
    return "asks for a login, and neither a token nor its address has one"


def _reason(error: httpx.TransportError) -> str:
    return "the time limit passed" if isinstance(error, httpx.ReadTimeout) else str(error) or type(error).__name__
