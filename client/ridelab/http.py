"""Requests that are sent again where that is safe: bounded, and as late as the service asks for."""

import email.utils
import itertools
import json
import re
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import httpx

from ridelab.errors import RidelabAPIError, RidelabConnectionError

FULL = (429, 503)
FIRST_PAUSE = 0.2  # before the first repetition after a lost connection, then twice as long each time [s]
LONGEST_WAIT = 60.0  # all waits for one answer together, and so the longest Retry-After obeyed [s]
_LOGIN = re.compile(r"(?<=://)[^/?#\s]*@")


def without_login(text: str) -> str:
    """The text with its addresses as they may be shown: `http://user:password@host` is `http://host`."""
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
    """An httpx client with the rules for repetition.

    Args:
        client: Who sends.
        retries: How often one request is repeated at most.
        sleep: Waits that many seconds.
    """

    def __init__(
        self, client: httpx.Client, *, retries: int = 5, sleep: Callable[[float], object] = time.sleep
    ) -> None:
        self.client = client
        self.sleep = sleep
        self._retries = retries

    @property
    def address(self) -> str:
        """Where the service is, without a login and a slash at the end."""
        return without_login(str(self.client.base_url)).rstrip("/")

    def json(self, method: str, path: str, **request: Any) -> Any:
        """The answer's JSON; the arguments are those of `send`.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        response = self.send(method, path, **request)
        try:
            return response.json()
        except ValueError:
            raise self._foreign(response) from None

    def document(self, method: str, path: str, **request: Any) -> dict[str, Any]:
        """The answer's JSON object; the arguments are those of `send`.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        answer: dict[str, Any] = self.json(method, path, **request)
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
        """The answer, once it is a good one.

        Args:
            method: HTTP method.
            path: Below the service's address.
            body: Sent as JSON; pydantic models and NumPy values become plain ones.
            params: Query; entries that are None are left out.
            headers: More headers.
            repeatable: Asking twice does what asking once does; else a request that may have arrived is not repeated.
            stream: Leave its content to be read piece by piece.
            silence: At most so long between two pieces [s]; None is the client's own limit.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        more = dict(headers or {})
        content = None
        if body is not None:
            more["Content-Type"] = "application/json"
            content = json.dumps(plain(body), allow_nan=False)
        sent = {key: value for key, value in (params or {}).items() if value is not None}
        request = self.client.build_request(method, path, params=sent, headers=more, content=content)
        if silence is not None:
            request.extensions["timeout"] = {**request.extensions["timeout"], "read": silence}
        return self._repeat(request, repeatable=repeatable, stream=stream)

    @contextmanager
    def stream(self, path: str, **request: Any) -> Iterator[httpx.Response]:
        """A GET whose answer is read piece by piece; the arguments are those of `send`.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        response = self.send("GET", path, stream=True, **request)
        try:
            yield response
        except httpx.TransportError as error:
            raise RidelabConnectionError(f"The answer of {self.address} broke off: {_reason(error)}") from error
        finally:
            response.close()

    def _repeat(self, request: httpx.Request, *, repeatable: bool, stream: bool) -> httpx.Response:
        left = LONGEST_WAIT
        for number in itertools.count():
            pause: float | None = FIRST_PAUSE * 2**number
            try:
                response = self.client.send(request, stream=stream)
            except httpx.TransportError as error:
                arrived = not isinstance(error, httpx.ConnectError | httpx.ConnectTimeout)
                # One that is being worked on is not asked for again: that makes it worse.
                if (arrived and not repeatable) or isinstance(error, httpx.ReadTimeout):
                    pause = None
                failure: Exception = self._no_answer(error)
            else:
                if response.is_success:
                    return response
                response.read()
                response.close()
                pause = retry_after(response) if response.status_code in FULL else None
                failure = self._refusal(response)
            if pause is None or number == self._retries or pause > left:
                raise failure
            left -= pause
            self.sleep(pause)
        raise AssertionError  # the count has no end

    def _no_answer(self, error: httpx.TransportError) -> Exception:
        failure = RidelabConnectionError(
            f"No answer from {self.address}: {_reason(error)}. Is a service running there? ridelab serve starts one"
        )
        failure.__cause__ = error
        return failure

    def _refusal(self, response: httpx.Response) -> Exception:
        try:
            problem = response.json()
        except ValueError:
            problem = None
        if isinstance(problem, dict) and "status" in problem:
            return RidelabAPIError.of(response.status_code, problem)
        if response.status_code in (401, 403):  # by a proxy, most often
            detail = f"{self.address} {_why_unauthorised(response)} (HTTP {response.status_code})"
            return RidelabAPIError(response.status_code, detail)
        if response.status_code >= 500:  # a proxy before a service that is away
            return RidelabConnectionError(f"{self.address} answers {response.status_code} {response.reason_phrase}")
        return self._foreign(response)

    def _foreign(self, response: httpx.Response) -> RidelabConnectionError:
        return RidelabConnectionError(
            f"{self.address} does not answer as Ridelab does (HTTP {response.status_code}); is the address right?"
        )


def retry_after(response: httpx.Response) -> float | None:
    """The wait the service asks for [s]: seconds or a date (RFC 9110, 10.2.3); None where it asks for none."""
    text = response.headers.get("Retry-After", "").strip()
    if text.isdecimal():
        return float(text)
    try:
        date = email.utils.parsedate_to_datetime(text)
    except ValueError:
        return None
    return max(0.0, date.timestamp() - time.time())


def plain(value: Any) -> Any:
    """The same in JSON's own types: a pydantic model (a `Scenario`) and NumPy values too."""
    if hasattr(value, "model_dump"):
        return value.model_dump(mode="json")
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | range):
        return [plain(item) for item in value]
    return value


def _why_unauthorised(response: httpx.Response) -> str:
    if response.status_code == 403:
        return "does not let this request in"
    sent = response.request.headers.get("Authorization", "")
    if sent:
        return f"refuses the {'token' if sent.startswith('Bearer ') else 'login in its address'}"
    return "asks for a login, and neither a token nor its address has one"


def _reason(error: httpx.TransportError) -> str:
    if isinstance(error, httpx.ReadTimeout):
        return "the time limit passed"
    return str(error) or type(error).__name__
