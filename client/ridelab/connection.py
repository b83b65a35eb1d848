"""The connection to a service: address, login, and the requests that the client's methods are made of."""

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, Self

import httpx

from ridelab.http import Http, split_login

API = "/api/v1"
SERVER_VARIABLE = "RIDELAB_SERVER"
TOKEN_VARIABLE = "RIDELAB_TOKEN"  # noqa: S105  # the variable's name
Scenario = Any  # its JSON, as a mapping, or a pydantic model such as the core's
_LOOPBACK = ("localhost", "127.0.0.1", "::1")


class Connection:
    """To the service at an address; arguments and errors as `Ridelab` says."""

    def __init__(
        self,
        address: str | None = None,
        *,
        token: str | None = None,
        timeout: float = 120,
        retries: int = 5,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        address = address or os.environ.get(SERVER_VARIABLE)
        if not address:
            raise ValueError(f"Name the address that ridelab serve prints, or set {SERVER_VARIABLE}")
        url, login = split_login(address)
        token = os.environ.get(TOKEN_VARIABLE, "") if token is None else token
        if transport is None and url.host in _LOOPBACK:
            # A proxy does not know this machine's own services, and plain HTTP needs no certificates, slow to read.
            transport = httpx.HTTPTransport(verify=url.scheme == "https")
        self._client = httpx.Client(
            base_url=url,
            auth=None if token else login,
            headers={"Authorization": f"Bearer {token}"} if token else None,
            timeout=httpx.Timeout(timeout, connect=min(timeout, 10)),
            transport=transport,
        )
        self._http = Http(self._client, retries=retries)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        """Pickled as its address alone: whoever unpickles it has a login of their own, perhaps in RIDELAB_TOKEN."""
        return type(self), (self.address,)

    def close(self) -> None:
        """Close the connections."""
        self._client.close()

    @property
    def address(self) -> str:
        """The service's address, without a login and a slash at the end."""
        return self._http.address

    def get(self, path: str, params: Mapping[str, Any] | None = None) -> Any:
        """The JSON at a path below `/api/v1`, such as `/presets`, `/schema`, `/catalogue`."""
        return self._http.json("GET", f"{API}{path}", params=params)

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each metric by its flat name (`bump.body_acceleration.peak`), from the catalogue; `1` for none."""
        catalogue = self.get("/catalogue")
        signals = {each["key"]: each["unit"] for each in catalogue["signals"]}
        windows, statistics = ([each["key"] for each in catalogue[name]] for name in ("windows", "statistics"))
        units = {
            f"{window}.{signal}.{statistic}": signals[signal]
            for window in windows
            for signal in catalogue["metric_signals"]
            for statistic in statistics
        }
        for part, prefix in (("comfort", "comfort."), ("events", "events."), ("run_figures", "")):
            units |= {prefix + each["key"]: each["unit"] for each in catalogue[part]}
        return units

    def _post(self, path: str, body: Mapping[str, Any], key: str = "") -> dict[str, Any]:
        return self._http.json("POST", API + path, body=body, headers={"Idempotency-Key": key} if key else None)

    def _listed(self, name: str, state: str | None, label: str | None, limit: int) -> Iterator[dict[str, Any]]:
        """The first `limit` entries, over as many pages as that takes."""
        cursor = None
        while limit > 0:
            page = self.get(f"/{name}", {"limit": min(limit, 500), "cursor": cursor, "state": state, "label": label})
            yield from page[name][:limit]
            limit -= len(page[name])
            cursor = page.get("next")
            if cursor is None:
                return

    def _content(self, path: str, params: Mapping[str, Any]) -> Iterator[bytes]:
        with self._http.stream(f"{API}{path}", params=params) as response:
            yield from response.iter_bytes()


def comma_separated(names: Sequence[str]) -> str:
    """Names as the service's addresses take several; one alone may be a text."""
    return names if isinstance(names, str) else ",".join(names)
