"""The client itself: one method for each thing a service does."""

import os
import uuid
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self
from urllib.parse import quote

import httpx

from backend.client.address import split_login
from backend.client.answers import Link, LinkedResult, RunResult
from backend.client.batch import Batch
from backend.client.errors import RidelabConnectionError
from backend.client.files import format_of, save
from backend.client.http import Http
from backend.client.tuning import Tuning

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from sim_core.scenario import Scenario

API = "/api/v1"
_LOOPBACK = ("localhost", "127.0.0.1", "::1")


class Ridelab:
    """A service at an address, to be used as a context manager.

    What can be asked twice without harm is repeated when the connection is lost, and everything when the service is
    full and says when to come back (429, 503 with Retry-After): at most `retries` times and for a minute.

    Args:
        address: Such as `http://127.0.0.1:8000`. A login in it, `http://user:password@host`, is sent with every request
            and never shown.
        timeout: Longest wait for an answer [s].
        retries: How often one request is repeated at most.
        transport: How requests travel; by default over the network, with the environment's proxies for
            other machines.

    Raises:
        ValueError: That is no HTTP address.
    """

    def __init__(
        self, address: str, *, timeout: float = 120, retries: int = 5, transport: httpx.BaseTransport | None = None
    ) -> None:
        url, login = split_login(address)
        if transport is None and url.host in _LOOPBACK:
            transport = httpx.HTTPTransport()  # a proxy does not know this machine's own services
        limits = httpx.Timeout(timeout, connect=min(timeout, 10))
        self._client = httpx.Client(base_url=url, auth=login, timeout=limits, transport=transport)
        self._http = Http(self._client, retries=retries)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of its connections."""
        self._client.close()

    @property
    def address(self) -> str:
        """Where the service is, without a login and a slash at the end."""
        return self._http.address

    def get(self, path: str) -> Any:
        """The JSON at a path below `/api/v1`, such as `/presets`, `/schema`, `/catalogue`.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        return self._http.json("GET", f"{API}{path}")

    def run(
        self,
        scenario: "Mapping[str, Any] | Scenario",
        strategies: Sequence[str],
        *,
        roads: int = 1,
        baseline: str | None = None,
    ) -> RunResult:
        """Run what is not stored yet.

        Args:
            scenario: An omitted part takes the paper's value.
            strategies: Ids.
            roads: How many roads every strategy drives, seeds `road.seed`, `road.seed` + 1, ...; metrics are then
                `Interval`s, means with their 95 % interval.
            baseline: The strategy that changes over several roads refer to; None is passive, or the first one where
                passive does not run.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        body = {"scenario": scenario, "strategies": list(strategies), "roads": roads, "baseline": baseline}
        return self._run(self._http.json("POST", f"{API}/runs", body=body))

    def get_run(self, run_id: str) -> RunResult:
        """A stored run; it never changes.

        Raises:
            RidelabAPIError: There is none of that id (404).
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        return self._run(self.get(f"/runs/{quote(run_id, safe='')}"))

    def series(
        self,
        run: RunResult | str,
        strategy: str,
        signals: Sequence[str] | None = None,
        *,
        points: int | None = None,
    ) -> "dict[str, NDArray[np.float32]]":
        """Time histories of one strategy, in SI units: signal -> float32 array, all of one length.

        Args:
            run: The run or its id.
            strategy: Its id.
            signals: Which, always with time and position; None is all.
            points: About how many samples; None is all.

        Raises:
            RidelabAPIError: The service refused: 404, 410 (another version of the core) or 422.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        import base64

        import numpy as np

        path, params = self._series_request(run, [strategy], signals, points)
        found = self._http.json("GET", path, params={**params, "encoding": "base64"})["series"]
        return {key: np.frombuffer(base64.b64decode(item["bdata"]), dtype="<f4") for key, item in found.items()}

    def series_content(
        self,
        run: RunResult | str,
        file_format: str,
        *,
        strategies: Sequence[str],
        signals: Sequence[str] | None = None,
        points: int | None = None,
    ) -> Iterator[bytes]:
        """Time histories as the bytes of a `csv`, `parquet` or `json` file, piece by piece.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        path, params = self._series_request(run, strategies, signals, points)
        with self._http.stream(path, params={**params, "format": file_format}) as response:
            yield from response.iter_bytes()

    def download_series(
        self,
        run: RunResult | str,
        path: str | os.PathLike[str],
        *,
        strategies: Sequence[str],
        signals: Sequence[str] | None = None,
        points: int | None = None,
        file_format: str | None = None,
    ) -> Path:
        """Time histories as a file, in the format its name ends with or the one named.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        chosen = format_of(path, file_format)
        return save(self.series_content(run, chosen, strategies=strategies, signals=signals, points=points), path)

    def run_report(self, run: RunResult | str, *, baseline: str | None = None) -> Iterator[bytes]:
        """A run as one HTML file that needs nothing else, piece by piece; changes refer to the baseline.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        run_id = run.id if isinstance(run, RunResult) else run
        path = f"{API}/runs/{quote(run_id, safe='')}/report.html"
        with self._http.stream(path, params={"baseline": baseline}) as response:
            yield from response.iter_bytes()

    def paper(
        self,
        *,
        seeds: int = 20,
        first_seed: int = 1,
        interpretation: str = "default",
        readings: Mapping[str, str] | None = None,
    ) -> dict[str, Any]:
        """The paper's printed changes with ours and a verdict on each; up to a minute the first time.

        Args:
            seeds: How many roads.
            first_seed: Of the first road; the others follow it.
            interpretation: A named set of readings, `default` or `favourable`.
            readings: Reading -> choice, those that are not the set's.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        params = {**(readings or {}), "seeds": seeds, "first_seed": first_seed, "interpretation": interpretation}
        found: dict[str, Any] = self._http.json("GET", f"{API}/paper", params=params)
        return found

    def paper_report(
        self,
        *,
        seeds: int = 20,
        first_seed: int = 1,
        interpretation: str = "default",
        readings: Mapping[str, str] | None = None,
    ) -> Iterator[bytes]:
        """The same as one HTML file, with what each part contributes and the figures, piece by piece.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        params = {**(readings or {}), "seeds": seeds, "first_seed": first_seed, "interpretation": interpretation}
        with self._http.stream(f"{API}/paper/report.html", params=params) as response:
            yield from response.iter_bytes()

    def submit(
        self,
        scenario: "Mapping[str, Any] | Scenario",
        strategies: Sequence[str],
        sweep: Mapping[str, Any],
        idempotency_key: str | None = None,
    ) -> Batch:
        """Hand in a batch; it is committed when this returns.

        Args:
            scenario: What every run starts from.
            strategies: Ids; each point runs under all of them.
            sweep: One of `{"grid": {field: values}}`, `{"latin_hypercube": {"ranges": {field: [lo, hi]}, "samples":
                n, "seed": s}}` and `{"list": [{field: value}, ..]}`, fields by dotted name.
            idempotency_key: The same key never makes a second batch; None is a key of this call's own.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        headers = {"Idempotency-Key": idempotency_key or uuid.uuid4().hex}
        body = {"scenario": scenario, "strategies": list(strategies), "sweep": sweep}
        return Batch(self._http, self._http.json("POST", f"{API}/batches", body=body, headers=headers))

    def estimate(
        self, scenario: "Mapping[str, Any] | Scenario", strategies: Sequence[str], sweep: Mapping[str, Any]
    ) -> dict[str, Any]:
        """What a batch would be: `total` runs, `points`, `estimated_cost` [s of one core], `estimated_seconds`.

        Raises:
            RidelabAPIError: The service would refuse it.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        body = {"scenario": scenario, "strategies": list(strategies), "sweep": sweep, "dry_run": True}
        found: dict[str, Any] = self._http.json("POST", f"{API}/batches", body=body)
        return found

    def get_batch(self, batch_id: str) -> Batch:
        """A batch as it stands.

        Raises:
            RidelabAPIError: There is none of that id (404).
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        return Batch(self._http, self.get(f"/batches/{quote(batch_id, safe='')}"))

    def tune(self, request: Mapping[str, Any], idempotency_key: str | None = None) -> Tuning:
        """Begin to look for better weights; it is committed when this returns.

        Args:
            request: `{"scenario", "strategy", "objectives", "limits", "search", "seeds", "fresh_seeds", "trials",
                "population", "seed"}`, each of which may be left out (docs/api.md).
            idempotency_key: The same key never begins a second one; None is a key of this call's own.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        headers = {"Idempotency-Key": idempotency_key or uuid.uuid4().hex}
        return Tuning(self._http, self._http.json("POST", f"{API}/tunings", body=request, headers=headers))

    def estimate_tuning(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """What a tuning would be: `runs`, `generations`, `estimated_cost` [s of one core], `estimated_seconds`.

        Raises:
            RidelabAPIError: The service would refuse it.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        found: dict[str, Any] = self._http.json("POST", f"{API}/tunings", body={**request, "dry_run": True})
        return found

    def get_tuning(self, tuning_id: str) -> Tuning:
        """A tuning as it stands.

        Raises:
            RidelabAPIError: There is none of that id (404).
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        return Tuning(self._http, self.get(f"/tunings/{quote(tuning_id, safe='')}"))

    def controller(self, scenario: "Mapping[str, Any] | Scenario") -> bytes:
        """The `lv_hil` controller of a scenario as a zip of C sources; the same scenario gives the same bytes.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        return self._http.content(f"{API}/controller", {"scenario": scenario})

    def controller_report(self, scenario: "Mapping[str, Any] | Scenario") -> dict[str, Any]:
        """Whether that controller fits a small microcontroller, and what does; takes about ten seconds.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        found: dict[str, Any] = self._http.json("POST", f"{API}/controller/report", body={"scenario": scenario})
        return found

    def realtime(self, scenario: "Mapping[str, Any] | Scenario") -> dict[str, Any]:
        """One drive by the clock: latency, jitter, missed deadlines; takes as long as the drive.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        found: dict[str, Any] = self._http.json("POST", f"{API}/controller/realtime", body={"scenario": scenario})
        return found

    def link(self, result: RunResult | Batch, view: Mapping[str, Any] | None = None) -> Link:
        """A new link that shares a run or a batch and how it is looked at.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        body: dict[str, Any] = {"batch_id" if isinstance(result, Batch) else "run_id": result.id}
        if view is not None:
            body["view"] = view
        answer = self._http.json("POST", f"{API}/links", body=body, repeatable=False)
        return Link(slug=answer["slug"], url=self.address + answer["url"])

    def open_link(self, slug: str) -> LinkedResult:
        """What a link pins.

        Raises:
            RidelabAPIError: There is none (404).
            RidelabConnectionError: No answer, or not Ridelab's.
        """
        answer = self.get(f"/links/{quote(slug, safe='')}")
        plain = {key: answer[key] for key in LinkedResult.__dataclass_fields__ if key not in ("url", "run", "batch")}
        return LinkedResult(
            **plain,
            url=self.address + answer["url"],
            run=None if answer["run"] is None else self._run(answer["run"]),
            batch=None if answer["batch"] is None else Batch(self._http, answer["batch"]),
        )

    def _run(self, answer: Any) -> RunResult:
        try:
            return RunResult.of(answer)
        except (KeyError, TypeError, AttributeError):
            raise RidelabConnectionError(f"{self.address} does not answer as Ridelab does") from None

    @staticmethod
    def _series_request(
        run: RunResult | str, strategies: Sequence[str], signals: Sequence[str] | None, points: int | None
    ) -> tuple[str, dict[str, Any]]:
        run_id = run.id if isinstance(run, RunResult) else run
        params = {
            "strategy": ",".join(strategies),
            "signals": None if signals is None else ",".join(signals),
            "points": points,
        }
        return f"{API}/runs/{quote(run_id, safe='')}/series", params
