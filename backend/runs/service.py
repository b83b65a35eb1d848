"""Runs: stored results are answered; missing ones are computed once, committed, then answered."""

import asyncio
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from backend import digest
from backend.cost.estimate import estimate
from backend.custom_controllers import registry as custom_controllers
from backend.db.tables import EXPIRED
from backend.errors import InvalidError, NewerSchemaError, NotFoundError, RoadGoneError
from backend.gate import Gate
from backend.json_types import JsonObject
from backend.means_over_roads import with_seeds
from backend.metrics import CACHE
from backend.outcome import FAILED, UNAVAILABLE, Sampling, failure_json
from backend.recordings.service import Recordings
from backend.requirements import Requirement
from backend.roads.service import MeasuredRoads
from backend.runs.answers import changes_to_run, changes_to_strategy, check_same_roads, live_answer, run_answer
from backend.runs.histories import ControllerMissingError
from backend.runs.models import LiveRequest
from backend.runs.results import Results
from backend.store import Store, StoredRun
from sim_core import __version__ as CORE_VERSION
from sim_core.comparison.requirements import baseline_of
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.recorded import recording_id
from sim_core.scenario.versions import NewerScenarioError, restored
from sim_core.strategies import STRATEGIES
from sim_core.strategies import strategies as known_strategies

_FAILED_BEFORE: JsonObject = {
    "status": FAILED,
    "json": failure_json(
        "It failed for a reason that may have passed, and its controller's file has changed or gone since: post the "
        "scenario to run it again",
        UNAVAILABLE,
    ),
    "cacheable": False,
}


@dataclass(eq=False, kw_only=True)
class Runs:
    """Makes runs and reads them."""

    store: Store
    results: Results
    gate: Gate
    roads: MeasuredRoads
    recordings: Recordings

    async def create(
        self,
        scenario: Scenario,
        strategies: Iterable[str],
        client: str,
        *,
        roads: int,
        baseline: str | None,
        requirements: Sequence[Requirement] = (),
        against: str | None = None,
    ) -> JsonObject:
        """Return the run of that scenario, computed where it was not stored.

        Args:
            scenario: What to drive, on the first road.
            strategies: Ids.
            client: Who asks.
            roads: How many roads; their seeds follow the scenario's.
            baseline: Which strategy the changes over several roads refer to; None is passive, or the first where
                passive does not run.
            requirements: Limits that the strategies have to satisfy.
            against: The run that the comparison's `changes_against` refer to.

        Raises:
            InvalidError: There is no such run as `against`, or it is of other roads.
        """
        seed = scenario.road.seed
        other = None if against is None else await self._named_reference(against, client, roads=roads, seed=seed)
        run, cached = await self.get_or_compute(scenario, strategies, client, roads=roads, baseline=baseline)
        answer = partial(run_answer, run, cached=cached, requirements=requirements, baseline=baseline, against=other)
        return await asyncio.to_thread(answer)

    async def get_or_compute(
        self, scenario: Scenario, strategies: Iterable[str], client: str, *, roads: int, baseline: str | None
    ) -> tuple[StoredRun, dict[str, bool]]:
        """Return the run as it is stored now, and of each strategy whether nothing was computed for this request."""
        names = ordered(strategies)
        if scenario.road.follows_profile:
            scenario = await self.roads.on(scenario)
        against = None if roads == 1 else baseline_of(names, baseline)
        identity = digest.plain(scenario.identity())
        run_id = digest.run_id(scenario, names, roads, against, identity)
        stored = await self.store.read(self.store.runs.load, run_id)
        if stored is not None and stored.schema_version == SCHEMA_VERSION and not stored.expired:
            CACHE.labels("hit").inc(len(names) * roads)
            return stored, dict.fromkeys(names, True)
        costs = {name: estimate(scenario, name) for name in names}
        self.gate.check_cost(roads * sum(costs.values()))
        every = [scenario] if roads == 1 else with_seeds(scenario, roads)
        by_road = await self.results.get(every, names, client, costs=costs, identity=identity)
        run = StoredRun(
            id=run_id,
            core_version=CORE_VERSION,
            schema_version=SCHEMA_VERSION,
            scenario=scenario.model_dump(mode="json"),
            by_strategy={name: [each[name] for each in by_road] for name in names},
            roads=roads,
            baseline=against,
        )
        # Results in memory outlive their road and their recording.
        if scenario.road.profile is not None:
            await self.roads.named([scenario.road.profile])
        if any(map(recording_id, names)):
            await self.recordings.named(names)
        await self.store.write(self.store.runs.save, run)
        return run, {name: all(each[name].cached for each in by_road) for name in names}

    async def get(
        self,
        run_id: str,
        client: str,
        *,
        requirements: Sequence[Requirement] = (),
        baseline: str | None = None,
        compared: Sequence[str] | None = None,
        against: str | None = None,
    ) -> JsonObject:
        """Return the stored run, its strategies compared and held to requirements.

        Args:
            run_id: The run.
            client: Who asks.
            requirements: Limits that its strategies have to satisfy.
            baseline: The strategy that changes refer to; None is the run's own, or passive, or the first.
            compared: The strategies that are compared beside it; None is all.
            against: The run that the comparison's `changes_against` refer to.

        Raises:
            NotFoundError: There is none.
            InvalidError: It has no such strategy as `baseline` or one of `compared`; or there is no such run as
                `against`, or it is of other roads.
        """
        stored = await self.stored(run_id, client)
        check_has(stored, "baseline", [] if baseline is None else [baseline])
        check_has(stored, "compare", compared or ())
        other = None if against is None else await self.reference(against, client)
        answer = partial(
            run_answer, stored, baseline=baseline, requirements=requirements, compared=compared, against=other
        )
        return await asyncio.to_thread(answer)

    async def changes(self, run_id: str, client: str, *, against: str | None, baseline: str | None) -> JsonObject:
        """Return the changes of a run over several roads against another one, or against one of its strategies.

        Raises:
            NotFoundError: There is no such run.
            InvalidError: Not one of both is named, there is none of that name, or they are not of the same roads.
        """
        stored = await self.stored(run_id, client)
        if against is not None and baseline is None:
            return await asyncio.to_thread(changes_to_run, stored, await self.reference(against, client))
        if baseline is not None and against is None:
            return await asyncio.to_thread(changes_to_strategy, stored, baseline)
        raise InvalidError(
            "Name either a run, `against`, or one of this run's strategies, `baseline`", parameter="against"
        )

    async def live(self, request: LiveRequest, client: str) -> bytes:
        """Return metrics and decimated time histories of a scenario, as JSON or binary; nothing is stored.

        Raises:
            InvalidError: There is no such run as `against`, or it is of other roads.
        """
        scenario, names = request.scenario, ordered(request.strategies)
        seed, against = scenario.road.seed, request.against
        other = None if against is None else await self._named_reference(against, client, roads=1, seed=seed)
        if scenario.road.follows_profile:
            scenario = await self.roads.on(scenario)
        costs = {name: estimate(scenario, name) for name in names}
        self.gate.check_cost(sum(costs.values()))
        sampling = Sampling(request.points, request.part)
        (outcomes,) = await self.results.get([scenario], names, client, sampling=sampling, costs=costs)
        return await asyncio.to_thread(live_answer, scenario, outcomes, request, other)

    async def stored(self, run_id: str, client: str) -> StoredRun:
        """The run; what is missing of it, removed or failed for a reason that may have passed, is computed again.

        Raises:
            NotFoundError: There is none.
            RoadGoneError: It would be computed on a measured road that is not stored any more.
            TemporaryError: Too much is being computed.
        """
        stored = await self.load(run_id)
        if stored is None:
            raise NotFoundError("There is no run of this id.")
        return await self._computed_again(stored, client) if stored.expired else stored

    async def reference(self, run_id: str, client: str) -> StoredRun:
        """Return the run that another one's changes refer to, its parameter `against`.

        Raises:
            InvalidError: There is none.
        """
        try:
            return await self.stored(run_id, client)
        except NotFoundError as error:
            raise InvalidError(error.message, parameter="against") from None

    async def _named_reference(self, run_id: str, client: str, *, roads: int, seed: int) -> StoredRun:
        """Return the run that a request's body names as `against`, before anything is computed.

        Raises:
            InvalidError: There is none, or it is not of so many roads from that seed on.
        """
        try:
            run = await self.reference(run_id, client)
            check_same_roads(roads, seed, CORE_VERSION, run)
        except InvalidError as error:
            raise InvalidError(error.message, pointer="/against") from None
        return run

    async def load(self, run_id: str) -> StoredRun | None:
        """Return the run as it is stored, its scenario today's.

        Raises:
            NewerSchemaError: A newer version of the service stored it.
        """
        stored = await self.store.read(self.store.runs.load, run_id)
        if stored is None or (stored.core_version, stored.schema_version) == (CORE_VERSION, SCHEMA_VERSION):
            return stored  # as this very version wrote it
        return replace(stored, scenario=upgraded_scenario(stored.scenario, stored.schema_version))

    async def _computed_again(self, stored: StoredRun, client: str) -> StoredRun:
        """A run whose missing results are computed by this core version.

        Where retention removed some it is computed as a whole, and then is this version's. Otherwise strategies have
        failed for reasons that may have passed: those alone are driven, on every road, and the others stay as they are.
        """
        scenario, by_name = Scenario.model_validate(stored.scenario), stored.by_strategy
        missing = [item for item in stored.results if item.status == EXPIRED]
        whole = not all(item.failed_unstored for item in missing)
        names = [name for name in by_name if whole or any(item.strategy == name for item in missing)]
        changed = _changed_controllers(stored, scenario, names)
        if whole and changed:
            raise ControllerMissingError
        names = [name for name in names if name not in changed]
        try:
            by_road = await self.results.get(with_seeds(scenario, stored.roads), names, client) if names else []
        except InvalidError:
            raise RoadGoneError from None
        again = {name: [each[name] for each in by_road] for name in names}
        again |= {name: [replace(item, **_FAILED_BEFORE) for item in by_name[name]] for name in changed}
        run = replace(stored.with_outcomes(again, CORE_VERSION), schema_version=SCHEMA_VERSION)
        if whole:
            run = replace(run, by_strategy=again, core_version=CORE_VERSION, scenario=scenario.model_dump(mode="json"))
        if any(item.cacheable for each in by_road for item in each.values()):
            await self.store.write(self.store.runs.recompute, run, CORE_VERSION)
        return run


def _changed_controllers(stored: StoredRun, scenario: Scenario, names: Iterable[str]) -> set[str]:
    """Return a run's custom controllers that have changed or gone since, or may have."""
    custom = {name for name in names if name not in STRATEGIES and recording_id(name) is None}
    there = custom & known_strategies().keys()
    if there == custom and digest.run_id(scenario, stored.by_strategy, stored.roads, stored.baseline) == stored.id:
        return set()
    if stored.core_version == CORE_VERSION:
        return custom
    # Another version's keys cannot be made again, but its results name their controllers' files.
    return {
        name
        for name in custom
        if name not in there
        or any(
            not item.failed_unstored and item.source != custom_controllers.source(name)
            for item in stored.by_strategy[name]
        )
    }


def check_has(stored: StoredRun, parameter: str, names: Iterable[str]) -> None:
    """Check that a run has these strategies, whether they succeeded or not.

    Raises:
        InvalidError: It has not; of that parameter.
    """
    if not set(names) <= stored.by_strategy.keys():
        message = f"This run has {', '.join(stored.by_strategy)}; the {parameter} is one of them"
        if parameter == "compare":
            message = f"This run has {', '.join(stored.by_strategy)}: only these can be compared"
        raise InvalidError(message, parameter=parameter)


def ordered(strategies: Iterable[str]) -> list[str]:
    """The strategies, each once, in the catalogue's order; those of one's own that are there no more come last."""
    requested = dict.fromkeys(strategies)
    return [name for name in {**known_strategies(), **requested} if name in requested]


def upgraded_scenario(scenario: JsonObject, schema_version: int) -> JsonObject:
    """Return a stored scenario as today's schema has it.

    Raises:
        NewerSchemaError: A newer version of the service stored it.
    """
    try:
        return restored(scenario, schema_version).model_dump(mode="json")
    except NewerScenarioError as error:
        raise NewerSchemaError(f"{error.message}.") from None
