"""The client itself: one method for each thing a service does."""

import json
import os
import re
import uuid
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from ridelab.arrays import unpacked
from ridelab.connection import API, Connection
from ridelab.errors import RidelabConnectionError
from ridelab.files import format_of, save
from ridelab.frames import compared
from ridelab.jobs import Batch, Job, Tuning
from ridelab.results import Link, LinkedResult, RunResult, Solution, intervals

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

Scenario = Any  # its JSON, as a mapping, or a pydantic model such as the core's
Requirement = Mapping[str, Any]


class Ridelab(Connection):
    """A service at an address, to be used as a context manager.

    Every method raises `RidelabAPIError` where the service refuses, and `RidelabConnectionError` where none answers or
    an answer breaks off. What can be asked twice without harm is repeated when the connection is lost, and everything
    when the service is full and says when to come back (429, 503 with Retry-After): at most `retries` times and for a
    minute.

    Args:
        address: Such as `http://127.0.0.1:8000`. A login in it, `http://user:password@host`, is sent with every request
            and never shown.
        token: Sent with every request as `Authorization: Bearer`, in place of a login; None is what RIDELAB_TOKEN
            holds, and an empty one none.
        timeout: Longest wait for an answer [s].
        retries: How often one request is repeated at most.
        transport: How requests travel; by default over the network, with the environment's proxies for
            other machines.

    Raises:
        ValueError: That is no HTTP address.
    """

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

    def run(
        self,
        scenario: Scenario,
        strategies: Sequence[str],
        *,
        roads: int = 1,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
    ) -> RunResult:
        """Run what is not stored yet.

        Args:
            scenario: An omitted part takes the paper's value.
            strategies: Ids.
            roads: How many roads every strategy drives, seeds `road.seed`, `road.seed` + 1, ...; metrics are then
                `Interval`s, means with their 95 % interval.
            baseline: The strategy that changes over several roads refer to; None is passive, or the first one where
                passive does not run.
            requirements: What the strategies have to keep, `requirement_results` of the answer say how: each
                `{"metric": name, "max": limit}`, or `min`, or `max_change` [%] against the baseline; perhaps
                `strategies`, all but the baseline where they are left out.
        """
        body = {"scenario": scenario, "strategies": strategies, "roads": roads, "baseline": baseline}
        return self._run(self._post("/runs", body | _required(requirements, baseline)))

    def get_run(self, run_id: str) -> RunResult:
        """A stored run; it never changes."""
        return self._run(self.get(f"/runs/{_id(run_id)}"))

    def changes(
        self, run: RunResult | str, *, against: RunResult | str | None = None, baseline: str | None = None
    ) -> dict[str, Any]:
        """What the strategies of a run over several roads change, paired road by road; as `changes` of a `RunResult`.

        Changes refer to the run `against`, over the same roads, strategy by strategy, or to the strategy `baseline`.

        Raises:
            RidelabAPIError: They are not of the same roads and core version, or there is no such strategy.
        """
        named = {"against": None if against is None else _id(against), "baseline": baseline}
        answer: dict[str, Any] = self.get(f"/runs/{_id(run)}/changes", named)
        return {strategy: intervals(each) for strategy, each in answer["changes"].items()}

    def solve(
        self,
        scenario: Scenario,
        strategy: str,
        field: str,
        ends: tuple[float, float],
        metric: str | None = None,
        limit: float | None = None,
        *,
        roads: int = 1,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
    ) -> Solution:
        """The largest value of one field that keeps one metric at or below a limit, or every requirement.

        Args:
            scenario: What every run starts from.
            strategy: Its id.
            field: By its dotted name, such as `speed.target_speed_kmh`.
            ends: Lowest and highest value, in the field's unit.
            metric: By its flat name, such as `bump.body_acceleration.peak`.
            limit: In the metric's unit.
            roads: How many roads it is driven over; the mean's 95 % interval then keeps the limit with its upper end.
            baseline: The strategy that changes of requirements refer to; None is passive.
            requirements: In place of metric and limit, as of `run`.

        Raises:
            RidelabAPIError: `kind` is `no-solution` where no value in the range keeps the limit.
        """
        body = {"scenario": scenario, "strategy": strategy, "field": field, "range": ends, "roads": roads}
        answer = self._post("/solve", body | (_required(requirements, baseline) or {"metric": metric, "limit": limit}))
        try:
            return Solution.of(answer)
        except (KeyError, TypeError):
            raise RidelabConnectionError(f"{self.address} does not answer as Ridelab does") from None

    def frequency(
        self,
        scenario: Scenario,
        strategies: Sequence[str],
        *,
        frequencies: Sequence[float] | None = None,
        outputs: Sequence[str] | None = None,
        stage: str = "cruise",
    ) -> dict[str, Any]:
        """Responses from road height, modes, margins and spectra while no limit binds, by strategy.

        Args:
            scenario: Whose car, road, sensors and actuators.
            strategies: Ids.
            frequencies: [Hz]; None is 200 from 0.3 to 30 Hz.
            outputs: Signals; None is both accelerations, tyre loads and deflections.
            stage: cruise, brake or bump, whose weights hold.
        """
        chosen = {"frequencies": frequencies, "outputs": outputs, "stage": stage}
        answer: dict[str, Any] = self._post("/frequency", {"scenario": scenario, "strategies": strategies, **chosen})
        return answer

    def instant(
        self, run: RunResult | str, strategy: str, *, position: float | None = None, time: float | None = None
    ) -> dict[str, Any]:
        """What a strategy's controller saw and decided at one control step of a stored run; what it has not is None.

        Args:
            run: The run, or its id; of one over several roads the first road.
            strategy: Its id.
            position: Of the front axle [m].
            time: In its place [s].

        Raises:
            RidelabAPIError: The run has no such strategy, or the place is not on its drive.
        """
        asked = {"strategy": strategy, "position": position, "time": time}
        answer: dict[str, Any] = self.get(f"/runs/{_id(run)}/instant", asked)
        return answer

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
            ImportError: NumPy is not installed.
        """
        params = {**_series([strategy], signals, points), "encoding": "base64"}
        return unpacked(self.get(f"/runs/{_id(run)}/series", params)["series"])

    def band(
        self,
        run: RunResult | str,
        strategy: str,
        signals: Sequence[str] | None = None,
        *,
        points: int | None = None,
    ) -> "dict[str, dict[str, NDArray[np.float32]]]":
        """Time histories of one strategy over all roads of a run: its `mean`, `minimum` and `maximum` at each sample.

        Each is signal -> float32 array as of `series`, which also says what the arguments are; `minimum` and `maximum`
        are without signals that are the same on every road, such as time, position and speed.

        Raises:
            ImportError: NumPy is not installed.
            RidelabAPIError: The run is of one road, or of another core version.
        """
        params = {**_series([strategy], signals, points), "encoding": "base64"}
        band = self.get(f"/runs/{_id(run)}/bands", params)["strategies"][strategy]
        return {name: unpacked(part) for name, part in band.items()}

    def series_content(self, run: RunResult | str, file_format: str, **selection: Any) -> Iterator[bytes]:
        """Time histories as the bytes of a `csv`, `parquet` or `json` file, piece by piece.

        `selection` has `strategies`, their ids, and perhaps `signals` and `points` as for `series`.
        """
        return self._content(f"/runs/{_id(run)}/series", {**_series(**selection), "format": file_format})

    def download_series(
        self, run: RunResult | str, path: str | os.PathLike[str], *, file_format: str | None = None, **selection: Any
    ) -> Path:
        """Write the file of `series_content`, in the format named, else that of the path's ending.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
        """
        return save(self.series_content(run, format_of(path, file_format), **selection), path)

    def run_report(
        self, run: RunResult | str, *, baseline: str | None = None, against: RunResult | str | None = None
    ) -> Iterator[bytes]:
        """A run as one HTML file that needs nothing else, piece by piece.

        Changes refer to the strategy `baseline`, or to the run `against`, strategy by strategy.
        """
        other = None if against is None else _id(against)
        return self._content(f"/runs/{_id(run)}/report.html", {"baseline": baseline, "against": other})

    def paper(self, **asked: Any) -> dict[str, Any]:
        """The paper's printed changes with ours and a verdict on each; up to a minute the first time.

        Args:
            asked: `seeds`, how many roads (20), from `first_seed` (1) on; `interpretation`, a named set of readings,
                `default` or `favourable`; `readings`, reading -> choice, those that are not the set's.
        """
        return self._http.json("GET", f"{API}/paper", params=_flattened(**asked))

    def paper_report(self, **asked: Any) -> Iterator[bytes]:
        """The answer of `paper`, the attribution and the figures as one HTML file, piece by piece."""
        return self._content("/paper/report.html", _flattened(**asked))

    def submit(
        self,
        scenario: Scenario,
        strategies: Sequence[str],
        sweep: Mapping[str, Any],
        idempotency_key: str | None = None,
        label: str | None = None,
        *,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
    ) -> Batch:
        """Submit a batch; it is committed when this returns.

        Args:
            scenario: What every run starts from.
            strategies: Ids; each point runs under all of them.
            sweep: One of `{"grid": {field: values}}`, `{"latin_hypercube": {"ranges": {field: [lo, hi]}, "samples":
                n, "seed": s}}` and `{"list": [{field: value}, ..]}`, fields by dotted name; with any of them
                `"linked": {field: [field, ..]}`, whose fields take the swept one's value.
            idempotency_key: The same key never makes a second batch; None is a key of this call's own.
            label: What to call it; lists find it by that.
            baseline: The strategy that changes of requirements refer to, at the same point.
            requirements: What its runs have to keep, as of `run`; `batch.requirement_results()` says how.
        """
        body = {"scenario": scenario, "strategies": strategies, "sweep": sweep, "label": label}
        body |= _required(requirements, baseline)
        return Batch(self._http, self._post("/batches", body, idempotency_key or uuid.uuid4().hex))

    def estimate(self, scenario: Scenario, strategies: Sequence[str], sweep: Mapping[str, Any]) -> dict[str, Any]:
        """What a batch would be: `total` runs, `points`, `estimated_cost` [s of one core], `estimated_seconds`."""
        return self._post("/batches", {"scenario": scenario, "strategies": strategies, "sweep": sweep, "dry_run": True})

    def get_batch(self, batch_id: str) -> Batch:
        """A batch as it stands."""
        return Batch(self._http, self.get(f"/batches/{_id(batch_id)}"))

    def batches(self, *, state: str | None = None, label: str | None = None, limit: int = 50) -> list[Batch]:
        """The newest batches first, without their sweeps; optionally only those in a state or with a label."""
        return [Batch(self._http, each) for each in self._listed("batches", state, label, limit)]

    def tune(self, request: Mapping[str, Any], idempotency_key: str | None = None) -> Tuning:
        """Begin to look for better weights; it is committed when this returns.

        Args:
            request: `{"scenario", "strategy", "objectives", "limits", "search", "seeds", "fresh_seeds", "trials",
                "population", "seed", "label"}`, each of which may be left out (docs/reference/api.md).
            idempotency_key: The same key never begins a second one; None is a key of this call's own.
        """
        return Tuning(self._http, self._post("/tunings", request, idempotency_key or uuid.uuid4().hex))

    def estimate_tuning(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """What a tuning would be: `runs`, `generations`, `estimated_cost` [s of one core], `estimated_seconds`."""
        return self._post("/tunings", {**request, "dry_run": True})

    def get_tuning(self, tuning_id: str) -> Tuning:
        """A tuning as it stands."""
        return Tuning(self._http, self.get(f"/tunings/{_id(tuning_id)}"))

    def tunings(self, *, state: str | None = None, label: str | None = None, limit: int = 50) -> list[Tuning]:
        """The newest tunings first, without what stands behind their scenario; as `batches`."""
        return [Tuning(self._http, each) for each in self._listed("tunings", state, label, limit)]

    def upload_road(
        self, source: str | os.PathLike[str] | bytes, *, left: float | None = None, right: float | None = None
    ) -> dict[str, Any]:
        """Send a measured profile, a CSV or OpenCRG file or its content; `id` is for a scenario's `road.profile`.

        The answer has `length` [m], `samples`, `bumps` (found in it), `warnings` (what was done to it), and of the
        heights as they came `iri` [m/km] and by ISO 8608 `iso_class`, `roughness` [m^3] and `waviness`, with intervals.

        Args:
            source: The file; which of the two it is is seen from its content.
            left: Of OpenCRG: where the left wheel runs, v [m]; None is 0.75.
            right: The same of the right wheel; None is -0.75.
        """
        content = source if isinstance(source, bytes) else Path(source).read_bytes()
        kind = "application/x-opencrg" if re.search(rb"^\$\$\$\$", content, re.MULTILINE) else "text/csv"
        wheels = {"left": left, "right": right}
        return self._http.json("POST", f"{API}/roads", body=content, params=wheels, headers={"Content-Type": kind})

    def road(self, road_id: str, points: int = 2000) -> dict[str, Any]:
        """A measured road: as `upload_road` has it, and about so many heights, `distance` and `height` [m]."""
        road: dict[str, Any] = self.get(f"/roads/{_id(road_id)}", {"points": points})
        return road

    def road_content(self, road_id: str, file_format: str = "csv", encoding: str = "binary") -> Iterator[bytes]:
        """Every height of a measured road, piece by piece; `upload_road` makes the same road of it anywhere.

        Args:
            road_id: Its id.
            file_format: `csv` or `crg`, which is OpenCRG.
            encoding: Of OpenCRG: `binary` or `text`.
        """
        return self._content(f"/roads/{_id(road_id)}", {"format": file_format, "encoding": encoding})

    def upload_recording(
        self, source: str | os.PathLike[str] | bytes, columns: Mapping[str, str] | None = None
    ) -> dict[str, Any]:
        """Send a recorded drive, a CSV file or its content; `strategy` stands for it among a run's strategies.

        The answer has `signals`, `samples`, `duration` [s], `columns` (what each was read as) and `warnings`.

        Args:
            source: The file.
            columns: By name of a column its signal with the unit, `{"acc_z": "body_acceleration [g]"}`, or an empty
                text to leave it out; others are read by their own names.
        """
        content = source if isinstance(source, bytes) else Path(source).read_bytes()
        mapping = {"columns": json.dumps(dict(columns))} if columns else None
        return self._http.json("POST", f"{API}/recordings", body=content, params=mapping)

    def recording(self, recording_id: str) -> dict[str, Any]:
        """A recorded drive: `strategy`, `signals`, `samples`, `duration` [s], `distance` [m]."""
        recording: dict[str, Any] = self.get(f"/recordings/{_id(recording_id)}")
        return recording

    def recording_content(self, recording_id: str) -> Iterator[bytes]:
        """Every sample of a recording as CSV, piece by piece; `upload_recording` makes the same one of it anywhere."""
        return self._content(f"/recordings/{_id(recording_id)}", {"format": "csv"})

    def compare(self, a: RunResult | str, b: RunResult | str) -> "pd.DataFrame":
        """Every metric of two runs as a pandas frame, by strategy and metric: `a`, `b`, `change` [%] and `unit`.

        Raises:
            ImportError: pandas is not installed.
        """
        first, second = (each if isinstance(each, RunResult) else self.get_run(each) for each in (a, b))
        return compared(first, second)

    def differences(
        self, run: RunResult | str, baseline: str | None = None
    ) -> dict[str, dict[str, dict[str, float | None]]]:
        """How far every strategy's curves lie from those of `baseline` at the same positions.

        Without a baseline they are against passive, or the first strategy where passive does not run.

        strategy -> signal -> `rms` and `peak` of the difference, `baseline_rms` and `correlation`, in SI units; None
        where they share no part of the road.
        """
        answer: dict[str, Any] = self.get(f"/runs/{_id(run)}/differences", {"baseline": baseline})
        strategies: dict[str, dict[str, dict[str, float | None]]] = answer["strategies"]
        return strategies

    def vehicles(self) -> dict[str, dict[str, Any]]:
        """Vehicles with sources by id: `label`, `description`, `vehicle` (for a scenario), `sources`, `derived`."""
        return {each["id"]: each for each in self.get("/vehicles")}

    def half_car(self, data_sheet: Mapping[str, float]) -> dict[str, float]:
        """A scenario's `vehicle` from a whole car's data sheet.

        Args:
            data_sheet: `front_axle_load`, `rear_axle_load`, `front_axle_mass`, `rear_axle_mass` [kg], `wheelbase` [m],
                `front_frequency`, `rear_frequency` [Hz], `front_damping_ratio`, `rear_damping_ratio` [1],
                `front_tyre_stiffness`, `rear_tyre_stiffness` [N/m]; perhaps `cg_height` [m] and `pitch_inertia`
                [kg m^2].
        """
        vehicle: dict[str, float] = self._post("/vehicles/from-data-sheet", data_sheet)["vehicle"]
        return vehicle

    def controller(self, scenario: Scenario) -> bytes:
        """The `lv_hil` controller of a scenario as a zip of C sources; the same scenario gives the same bytes."""
        return self._http.send("POST", f"{API}/controller", body={"scenario": scenario}).content

    def fmu(
        self,
        scenario: Scenario,
        strategy: str = "lv",
        *,
        of: str = "controller",
        version: str = "2.0",
        platforms: Sequence[str] = ("linux64", "win64", "darwin64"),
    ) -> bytes:
        """A controller, or the vehicle, as an FMU for co-simulation.

        Args:
            scenario: Whose.
            strategy: Id of the strategy whose controller it is.
            of: `controller` or `vehicle`.
            version: Of FMI, `2.0` or `3.0`.
            platforms: For which it is compiled, as far as the service can.
        """
        body = {"scenario": scenario, "strategy": strategy, "of": of, "version": version, "platforms": [*platforms]}
        return self._http.send("POST", f"{API}/fmus", body=body).content

    def controller_report(self, scenario: Scenario) -> dict[str, Any]:
        """Whether that controller fits a small microcontroller, and what does; takes about ten seconds."""
        return self._post("/controller/report", {"scenario": scenario})

    def realtime(self, scenario: Scenario) -> dict[str, Any]:
        """One drive by the clock: latency, jitter, missed deadlines; takes as long as the drive."""
        return self._post("/controller/realtime", {"scenario": scenario})

    def link(self, result: RunResult | Job, view: Mapping[str, Any] | None = None) -> Link:
        """A new link that shares a run or a batch, and how the page shows it."""
        body: dict[str, Any] = {"run_id" if isinstance(result, RunResult) else "batch_id": result.id}
        body |= {} if view is None else {"view": view}
        answer = self._http.json("POST", f"{API}/links", body=body, repeatable=False)
        return Link(slug=answer["slug"], url=self.address + answer["url"])

    def open_link(self, slug: str) -> LinkedResult:
        """What a link pins."""
        answer = self.get(f"/links/{_id(slug)}")
        plain = {key: answer[key] for key in LinkedResult.__dataclass_fields__ if key not in ("url", "run", "batch")}
        return LinkedResult(
            **plain,
            url=self.address + answer["url"],
            run=None if answer["run"] is None else self._run(answer["run"]),
            batch=None if answer["batch"] is None else Batch(self._http, answer["batch"]),
        )

    def _run(self, answer: Any) -> RunResult:
        try:
            return RunResult.of(answer, self)
        except (KeyError, TypeError, AttributeError):
            raise RidelabConnectionError(f"{self.address} does not answer as Ridelab does") from None


def _id(run: RunResult | str) -> str:
    return quote(run.id if isinstance(run, RunResult) else run, safe="")


def _required(requirements: Sequence[Requirement], baseline: str | None) -> dict[str, Any]:
    """Nothing where nothing is required: a service of an older version does not know the word."""
    return {"requirements": list(requirements), "baseline": baseline} if requirements else {}


def _series(
    strategies: Sequence[str], signals: Sequence[str] | None = None, points: int | None = None
) -> dict[str, Any]:
    return {"strategy": ",".join(strategies), "signals": signals and ",".join(signals), "points": points}


def _flattened(readings: Mapping[str, str] | None = None, **asked: Any) -> dict[str, Any]:
    """The query parameters of `paper`: each interpretation is a parameter of its own."""
    return {**(readings or {}), **asked}
