"""Runs: what is stored is answered, what is missing is computed once, what is computed is committed, then answered."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy.exc import SQLAlchemyError

from backend import digest, figures, series
from backend.admission import Admission
from backend.compute import Workers
from backend.problems import ProblemError
from backend.results import Results
from backend.store import Store, StoredResult, StoredRun
from backend.worker import Outcome, SeriesArray
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.strategies import STRATEGIES

FIGURE_POINTS = 2000
INLINE_VALUES = 60_000  # up to so many numbers are rendered at once (about 2 ms), more in a worker


@dataclass(frozen=True, slots=True, kw_only=True)
class Histories:
    """Which time histories are asked for, and how; None is all."""

    strategies: Sequence[str] | None
    signals: Sequence[str] | None
    points: int | None
    file_format: Literal["json", "csv", "parquet"]
    encoding: Literal["list", "base64"]


class Runs:
    """The one service of runs; its methods belong to the event loop."""

    def __init__(self, *, store: Store, workers: Workers, results: Results, admission: Admission) -> None:
        self._store = store
        self._workers = workers
        self._results = results
        self._admission = admission

    async def store_usable(self) -> bool:
        """Whether the database answers."""
        try:
            await self._store.call(self._store.ping)
        except SQLAlchemyError:
            return False
        return True

    async def create(self, scenario: Scenario, strategies: Iterable[str], client: str) -> dict[str, Any]:
        """The run of that scenario, computed where it was not stored, as `CreatedRun`."""
        names = ordered(strategies)
        self._admission.check(scenario, names)
        run_id = digest.run_id(scenario, names)
        stored = await self._store.call(self._store.load_run, run_id)
        if stored is not None:
            return run_answer(stored, cached=dict.fromkeys(names, True))
        found = await self._results.get(scenario, names, client, with_series=False)
        outcomes = [_to_store(scenario, name, found[name].outcome) for name in names]
        saved = await self._store.call(
            self._store.save_run,
            run_id=run_id,
            core_version=CORE_VERSION,
            schema_version=SCHEMA_VERSION,
            scenario=scenario.model_dump(mode="json"),
            outcomes=outcomes,
        )
        return run_answer(saved, cached={name: found[name].cached for name in names})

    async def get(self, run_id: str) -> dict[str, Any]:
        """The stored run, as `Run`.

        Raises:
            ProblemError: 404.
        """
        return run_answer(await self._stored(run_id))

    async def live(
        self, scenario: Scenario, strategies: Iterable[str], points: int, signals: Sequence[str] | None, client: str
    ) -> dict[str, Any]:
        """Figures and decimated time histories of that scenario, as `LiveRun`; nothing is stored."""
        names = ordered(strategies)
        self._admission.check(scenario, names)
        found = await self._results.get(scenario, names, client, with_series=True)
        keys = series.chosen(signals)
        entries = {}
        for name, item in found.items():
            entry = entry_answer(item.outcome, cached=item.cached)
            if item.outcome.series is not None:
                entry["series"] = series.as_json(_decimated(item.outcome, points), keys, "base64")
            entries[name] = entry
        return {
            "core_version": CORE_VERSION,
            "scenario": scenario.model_dump(mode="json"),
            "strategies": entries,
        }

    async def series(self, run_id: str, asked: Histories, client: str) -> bytes:
        """Time histories of a stored run in one of the formats.

        Raises:
            ProblemError: 404, 410 or 422.
        """
        stored, outcomes = await self._histories(run_id, asked.strategies, client)
        members = {name: _decimated(outcome, asked.points) for name, outcome in outcomes.items()}
        keys = series.chosen(asked.signals)
        if asked.file_format == "csv":
            return await self._render(members, series.render_csv, members, keys)
        if asked.file_format == "parquet":
            provenance = {"ridelab.run": stored.id, "ridelab.core_version": stored.core_version}
            return await self._render(members, series.render_parquet, members, keys, provenance)
        return await self._render(members, series.render_json, members, keys, asked.encoding, stored.core_version)

    async def figures(self, run_id: str, name: str | None, axis: str, client: str) -> dict[str, Any]:
        """One figure of a stored run, or all of them by name, with data.

        Raises:
            ProblemError: 404 or 410.
        """
        if name is not None and name not in figures.PANELS:
            raise ProblemError(404, f"There is no such figure; there are {', '.join(figures.PANELS)}.")
        _, outcomes = await self._histories(run_id, None, client)
        members = {strategy: _decimated(outcome, FIGURE_POINTS) for strategy, outcome in outcomes.items()}
        summaries = {strategy: outcome.summary for strategy, outcome in outcomes.items()}
        if name is not None:
            return figures.filled(name, members, summaries, axis)
        return {"figures": {each: figures.filled(each, members, summaries, axis) for each in figures.PANELS}}

    async def _stored(self, run_id: str) -> StoredRun:
        stored = await self._store.call(self._store.load_run, run_id)
        if stored is None:
            raise ProblemError(404, "There is no run of this id.")
        return stored

    async def _histories(
        self, run_id: str, strategies: Sequence[str] | None, client: str
    ) -> tuple[StoredRun, dict[str, Outcome]]:
        """A stored run and the results, with series, of those of its strategies (None: all that did not fail)."""
        stored = await self._stored(run_id)
        if stored.core_version != CORE_VERSION:
            raise ProblemError(
                410,
                f"Core version {stored.core_version} computed this run, and this service runs {CORE_VERSION}: "
                "its time histories cannot be made again. Its figures and metrics stay; post its scenario to run it "
                "on this version.",
                kind="other-core-version",
            )
        succeeded = [item.strategy for item in stored.results if item.status == "ok"]
        names = succeeded if strategies is None else list(strategies)
        if not names or not set(names) <= set(succeeded):
            message = f"This run has time histories of {', '.join(succeeded) or 'no strategy'}"
            raise ProblemError(422, message, errors=[{"parameter": "strategy", "pointer": "", "message": message}])
        scenario = Scenario.model_validate(stored.scenario)
        found = await self._results.get(scenario, ordered(names), client, with_series=True)
        return stored, {name: found[name].outcome for name in ordered(names)}

    async def _render(
        self, members: Mapping[str, SeriesArray], function: Callable[..., bytes], *arguments: Any
    ) -> bytes:
        if sum(array.size for array in members.values()) <= INLINE_VALUES:
            return function(*arguments)
        return await self._workers.call(function, *arguments)


def ordered(strategies: Iterable[str]) -> list[str]:
    """Each once, in the catalogue's order."""
    asked = set(strategies)
    return [name for name in STRATEGIES if name in asked]


def entry_answer(outcome: Outcome | StoredResult, *, cached: bool | None = None) -> dict[str, Any]:
    """One strategy's part of an answer; `cached` only where the answer has it."""
    told = {} if cached is None else {"cached": cached}
    return {"status": outcome.status, **told, "compute_ms": outcome.compute_ms, **outcome.summary}


def run_answer(stored: StoredRun, *, cached: Mapping[str, bool] | None = None) -> dict[str, Any]:
    """`Run`, or `CreatedRun` where it is known what was cached."""
    return {
        "id": stored.id,
        "core_version": stored.core_version,
        "scenario": stored.scenario,
        "strategies": {
            item.strategy: entry_answer(item, cached=None if cached is None else cached[item.strategy])
            for item in stored.results
        },
    }


def _decimated(outcome: Outcome, points: int | None) -> SeriesArray:
    if outcome.series is None:
        raise RuntimeError("A result without time histories was asked for them")
    return series.decimate(outcome.series, points, [stage["start_time"] for stage in outcome.summary["stages"][1:]])


def _to_store(scenario: Scenario, name: str, outcome: Outcome) -> StoredResult:
    return StoredResult(
        key=digest.result_key(scenario, name),
        strategy=name,
        status=outcome.status,
        summary=outcome.summary,
        compute_ms=outcome.compute_ms,
    )
