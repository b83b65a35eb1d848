"""The client itself: one method for each thing a service does.

What reads a stored run, what makes and finds jobs, and what handles measured files are each in a base of their own.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ridelab.connection import API, Scenario
from ridelab.errors import RidelabConnectionError
from ridelab.fields import similar, units_of, with_values
from ridelab.job_methods import JobMethods
from ridelab.jobs import Batch, Job
from ridelab.measurement_methods import MeasurementMethods
from ridelab.requirements import Requirement, required
from ridelab.results import Link, LinkedResult, RunResult, Solution, compared, quoted_id
from ridelab.run_methods import RunMethods
from ridelab.units import SWITCH, quantity, starts_as_number, switch

if TYPE_CHECKING:
    import pandas as pd


class Ridelab(RunMethods, JobMethods, MeasurementMethods):
    """A service at an address, to be used as a context manager.

    Every method raises `RidelabAPIError` where the service refuses, and `RidelabConnectionError` where none answers or
    an answer breaks off. What can be asked twice without harm is repeated when the connection is lost, and everything
    when the service is full and says when to come back (429, 503 with Retry-After): at most `retries` times and for a
    minute.

    Args:
        address: Such as `http://127.0.0.1:8000`; by default what RIDELAB_SERVER holds. A login in it,
            `http://user:password@host`, is sent with every request and never shown.
        token: Sent with every request as `Authorization: Bearer`, in place of a login; None is what RIDELAB_TOKEN
            holds, and an empty one none.
        timeout: Longest wait for an answer [s].
        retries: How often one request is repeated at most.
        transport: How requests travel; by default over the network, with the environment's proxies for
            other machines.

    Raises:
        ValueError: That is no HTTP address, or none is named.
    """

    def scenario(self, preset: str = "paper", changes: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """A preset with some fields changed, for every method that takes a scenario.

        Args:
            preset: Its id.
            changes: By dotted name; a text may say a unit, `{"road.bump.height": "12 cm"}`, or switch a field on or
                off, `{"vehicle.tyre_lift_off": "on"}`.

        Raises:
            ValueError: There is no such preset or place, or a text is not understood.
        """
        presets = {each["id"]: each["scenario"] for each in self.get("/presets")}
        if preset not in presets:
            raise ValueError(
                f"{preset}: there is no such preset{similar(preset, presets)}; there are {', '.join(presets)}"
            )
        units = units_of(self.get("/schema"))
        values = {name: _value(name, value, units) for name, value in (changes or {}).items()}
        return with_values(presets[preset], values)

    def run(
        self,
        scenario: Scenario,
        strategies: Sequence[str],
        *,
        roads: int = 1,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
        against: str | None = None,
    ) -> RunResult:
        """Run what is not stored yet.

        Args:
            scenario: Its parts, such as `{"road": {"bump": {"height": 0.12}}}`; an omitted one takes the paper's value,
                so that `{}` is the paper's scenario. `scenario` makes one of dotted names and units.
            strategies: Ids, such as `["lv", "lqr", "passive"]`; `get("/strategies")` has them all.
            roads: How many roads every strategy drives, seeds `road.seed`, `road.seed` + 1, ...; metrics are then
                `Interval`s, means with their 95 % interval.
            baseline: The strategy that changes over several roads refer to; None is passive, or the first one where
                passive does not run.
            requirements: What the strategies have to keep, `requirement_results` of the answer say how: each
                `{"metric": name, "max": limit}`, or `min`, or `max_change` [%] against the baseline; perhaps
                `strategies`, all but the baseline where they are left out.
            against: A run's id, such as the one before an edit: `answer["comparison"]["changes_against"]` has the
                changes of each strategy against itself there. Over several roads it has to be of the same ones.
        """
        body = {"scenario": scenario, "strategies": strategies, "roads": roads, "baseline": baseline}
        body |= {} if against is None else {"against": against}
        return self._run(self._post("/runs", body | required(requirements, baseline)))

    def get_run(self, run_id: str) -> RunResult:
        """A stored run; it never changes."""
        return self._run(self.get(f"/runs/{quoted_id(run_id)}"))

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
        answer = self._post("/solve", body | (required(requirements, baseline) or {"metric": metric, "limit": limit}))
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
        options = {"frequencies": frequencies, "outputs": outputs, "stage": stage}
        answer: dict[str, Any] = self._post("/frequency", {"scenario": scenario, "strategies": strategies, **options})
        return answer

    def fuzzy(self, scenario: Scenario) -> dict[str, Any]:
        """The fuzzy speed controller of a scenario: sets as curves, rules written out, the torque over both inputs."""
        answer: dict[str, Any] = self._post("/fuzzy", {"scenario": scenario})
        return answer

    def paper(self, **asked: Any) -> dict[str, Any]:
        """The paper's printed changes with ours and a verdict on each; up to a minute the first time.

        Args:
            asked: `seeds`, how many roads (20), from `first_seed` (1) on; `interpretation`, a named set of readings,
                `default`, `favourable` or `nearest`; `readings`, reading -> choice, those that are not the set's.
        """
        return self._http.json("GET", f"{API}/paper", params=_flattened(**asked))

    def paper_report(self, **asked: Any) -> Iterator[bytes]:
        """The answer of `paper`, the attribution and the figures as one HTML file, piece by piece."""
        return self._content("/paper/report.html", _flattened(**asked))

    def compare(self, a: RunResult | str, b: RunResult | str) -> "pd.DataFrame":
        """Every metric of two runs as a pandas frame, by strategy and metric: `a`, `b`, `change` [%] and `unit`.

        Raises:
            ImportError: pandas is not installed.
        """
        first, second = (each if isinstance(each, RunResult) else self.get_run(each) for each in (a, b))
        return compared(first, second)

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
            platforms: Whose programs are inside, as far as the service has them.
        """
        body = {"scenario": scenario, "strategy": strategy, "of": of, "version": version, "platforms": [*platforms]}
        return self._http.send("POST", f"{API}/fmus", body=body).content

    def controller_report(self, scenario: Scenario) -> dict[str, Any]:
        """Return whether that controller fits a small microcontroller, and what does; takes about ten seconds."""
        return self._post("/controller/report", {"scenario": scenario})

    def link(self, result: RunResult | Job, view: Mapping[str, Any] | None = None) -> Link:
        """A new link that shares a run or a batch, and how the page shows it."""
        body: dict[str, Any] = {"run_id" if isinstance(result, RunResult) else "batch_id": result.id}
        body |= {} if view is None else {"view": view}
        answer = self._http.json("POST", f"{API}/links", body=body, repeatable=False)
        return Link(slug=answer["slug"], url=f"{self.address}/s/{answer['slug']}")

    def links(self, *, limit: int = 50) -> list[dict[str, Any]]:
        """The newest links first: with tokens one's own, without them on the service's own machine.

        Each has `slug`, `url`, `kind`, `run_id`, `batch_id`, `created_at` and `revoked_at`.
        """
        return list(self._listed("links", None, None, limit))

    def revoke_link(self, slug: str) -> None:
        """Take a link back: from then on it opens nothing, for anybody."""
        self._http.send("DELETE", f"{API}/links/{quoted_id(slug)}")

    def open_link(self, slug: str) -> LinkedResult:
        """Return the run or the batch that a link pins."""
        answer = self.get(f"/links/{quoted_id(slug)}")
        plain = {key: answer[key] for key in LinkedResult.__dataclass_fields__ if key not in ("url", "run", "batch")}
        return LinkedResult(
            **plain,
            url=f"{self.address}/s/{slug}",
            run=None if answer["run"] is None else self._run(answer["run"]),
            batch=None if answer["batch"] is None else Batch(self._http, answer["batch"]),
        )

    def _run(self, answer: Any) -> RunResult:
        try:
            return RunResult.of(answer, self)
        except (KeyError, TypeError, AttributeError):
            raise RidelabConnectionError(f"{self.address} does not answer as Ridelab does") from None


def _flattened(readings: Mapping[str, str] | None = None, **asked: Any) -> dict[str, Any]:
    """The query parameters of `paper`: each interpretation is a parameter of its own."""
    return {**(readings or {}), **asked}


def _value(name: str, value: Any, units: Mapping[str, str]) -> Any:
    """Return a field's value: of a text with a number and a unit the number, in the field's own unit."""
    unit = units.get(name, "1")
    if not isinstance(value, str) or not (unit == SWITCH or starts_as_number(value)):
        return value
    try:
        return switch(value) if unit == SWITCH else quantity(value, unit)
    except ValueError as error:
        wrong = error if name in units else f"there is no such name{similar(name, units)}"
        raise ValueError(f"{name}: {wrong}") from None
