"""Requests that are sent again where that is safe: bounded, and as late as the service asks for."""

import email.utils
import json
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import httpx

from backend.client.address import without_login
from backend.client.errors import RidelabAPIError, RidelabConnectionError

FULL = (429, 503)
UNAUTHORISED = (401, 403)
FIRST_PAUSE = 0.2  # before the first repetition after a lost connection, then twice as long each time [s]
LONGEST_WAIT = 60.0  # all waits for one answer together, and so the longest Retry-After obeyed [s]


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

    def json(
        self,
        method: str,
        path: str,
        *,
        body: Any = None,
        params: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
        repeatable: bool = True,
    ) -> Any:
        """The answer's JSON.

        Args:
            method: HTTP method.
            path: Below the service's address.
            body: Sent as JSON; pydantic models and NumPy values become plain ones.
            params: Query; entries that are None are left out.
            headers: More headers.
            repeatable: Asking twice does what asking once does; else a request that may have arrived is not repeated.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        request = self._request(method, path, body, params, headers)
        response = self._send(request, repeatable=repeatable, stream=False)
        try:
            return response.json()
        except ValueError:
            raise self._foreign(response) from None

    def content(self, path: str, body: Any) -> bytes:
        """The bytes that a POST answers with; it may be sent twice.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        request = self._request("POST", path, body, None, None)
        return self._send(request, repeatable=True, stream=False).content

    @contextmanager
    def stream(
        self,
        path: str,
        *,
        params: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
        silence: float | None = None,
    ) -> Iterator[httpx.Response]:
        """A GET whose answer is read piece by piece; at most `silence` seconds between two pieces.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        request = self._request("GET", path, None, params, headers)
        if silence is not None:
            request.extensions["timeout"] = {**request.extensions["timeout"], "read": silence}
        response = self._send(request, repeatable=True, stream=True)
        try:
            yield response
        except httpx.TransportError as error:
            raise RidelabConnectionError(f"The answer of {self.address} broke off: {_reason(error)}") from error
        finally:
            response.close()

    def _request(
        self,
        method: str,
        path: str,
        body: Any,
        params: Mapping[str, Any] | None,
        headers: Mapping[str, str] | None,
    ) -> httpx.Request:
        sent = {key: value for key, value in (params or {}).items() if value is not None}
        more = dict(headers or {})
        if body is None:
            return self.client.build_request(method, path, params=sent, headers=more)
        more["Content-Type"] = "application/json"
        content = json.dumps(plain(body), allow_nan=False)
        return self.client.build_request(method, path, params=sent, headers=more, content=content)

    def _send(self, request: httpx.Request, *, repeatable: bool, stream: bool) -> httpx.Response:
        repetitions = _Repetitions(self._retries, self.sleep)
        while True:
            try:
                response = self.client.send(request, stream=stream)
            except httpx.TransportError as error:
                arrived = not isinstance(error, httpx.ConnectError | httpx.ConnectTimeout)
                given_up = (arrived and not repeatable) or isinstance(error, httpx.ReadTimeout)
                if given_up or not repetitions.wait(None):
                    raise RidelabConnectionError(f"No answer from {self.address}: {_reason(error)}") from error
                continue
            if response.is_success:
                return response
            response.read()
            after = retry_after(response)
            response.close()
            if response.status_code not in FULL or after is None or not repetitions.wait(after):
                raise self._refusal(response)

    def _refusal(self, response: httpx.Response) -> Exception:
        try:
            problem = response.json()
        except ValueError:
            problem = None
        if isinstance(problem, dict) and "status" in problem:
            return RidelabAPIError.of(response.status_code, problem)
        if response.status_code in UNAUTHORISED:  # by a proxy, most often
            detail = f"{self.address} {_why_unauthorised(response)} (HTTP {response.status_code})"
            return RidelabAPIError(response.status_code, detail)
        if response.status_code >= 500:  # a proxy before a service that is away
            return RidelabConnectionError(f"{self.address} answers {response.status_code} {response.reason_phrase}")
        return self._foreign(response)

    def _foreign(self, response: httpx.Response) -> RidelabConnectionError:
        return RidelabConnectionError(
            f"{self.address} does not answer as Ridelab does (HTTP {response.status_code}); is the address right?"
        )


class _Repetitions:
    """How often, and how long all together, one request may still be repeated."""

    def __init__(self, retries: int, sleep: Callable[[float], object]) -> None:
        self._number, self._retries, self._sleep = 0, retries, sleep
        self._left = LONGEST_WAIT

    def wait(self, asked: float | None) -> bool:
        """Wait before one more, as long as the service asks for [s]; False where there is to be none."""
        pause = FIRST_PAUSE * 2**self._number if asked is None else asked
        if self._number == self._retries or pause > self._left:
            return False
        self._number += 1
        self._left -= pause
        self._sleep(pause)
        return True


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
    if "Authorization" in response.request.headers:
        return "refuses the login in its address"
    return "asks for a login, and its address has none"


def _reason(error: httpx.TransportError) -> str:
    if isinstance(error, httpx.ReadTimeout):
        return "the time limit passed"
    return str(error) or type(error).__name__
