"""Why and at which frequency a controller acts: what is asked of runs and scenarios beside their results."""

from dataclasses import dataclass

from backend.compute.workers import Workers
from backend.cost.estimate import cost_of
from backend.errors import GoneError, InvalidError, RoadGoneError
from backend.gate import Gate
from backend.roads.service import MeasuredRoads
from backend.runs.frequency import COST as FREQUENCY_COST
from backend.runs.frequency import FrequencyAnswer, FrequencyRequest, frequency_answer
from backend.runs.fuzzy import COST as FUZZY_COST
from backend.runs.fuzzy import FuzzyAnswer, FuzzyRequest, fuzzy_answer
from backend.runs.histories import ControllerMissingError, changed_controllers
from backend.runs.instants import InstantAnswer, instant_answer
from backend.runs.service import Runs, ordered
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id


@dataclass(eq=False, kw_only=True)
class ControlAnalysis:
    """Answers what a controller does; nothing is stored."""

    runs: Runs
    workers: Workers
    gate: Gate
    roads: MeasuredRoads

    async def frequency(self, asked: FrequencyRequest, client: str) -> FrequencyAnswer:
        """Responses, modes, margins and spectra of strategies.

        Raises:
            TemporaryError: Too much is being computed.
        """
        names, cost = ordered(asked.strategies), FREQUENCY_COST * len(asked.strategies)
        scenario = await self.roads.settled(asked.scenario)
        question = scenario, names, asked.frequencies, asked.outputs, asked.stage
        with self.gate.computing(client, cost):
            return await self.workers.call(frequency_answer, *question, client=client, cost=cost)

    async def fuzzy(self, asked: FuzzyRequest, client: str) -> FuzzyAnswer:
        """The speed controller's sets, rules and surface.

        Raises:
            TemporaryError: Too much is being computed.
        """
        with self.gate.computing(client, FUZZY_COST):
            return await self.workers.call(fuzzy_answer, asked.scenario.fuzzy, client=client, cost=FUZZY_COST)

    async def instant(
        self, run_id: str, strategy: str | None, position: float | None, time: float | None, client: str
    ) -> InstantAnswer:
        """The instant; of a run over several roads on the first one.

        Raises:
            NotFoundError: No such run.
            InvalidError: The run has no such strategy, or the place is not on its drive.
            GoneError: Another core version or another controller computed the run, or its road is gone.
        """
        stored = await self.runs.stored(run_id, client)
        drives = {item.strategy: item for item in stored.shown if recording_id(item.strategy) is None}
        if strategy is None and len(drives) == 1:
            (strategy,) = drives
        if strategy not in drives:
            message = f"This run drove {', '.join(drives) or 'nothing'}; name one of them"
            raise InvalidError(message, parameter="strategy")
        if (position is None) == (time is None):
            raise InvalidError("Give a position or a time", parameter="position" if time is None else "time")
        scenario = Scenario.model_validate(stored.scenario)
        name, unit, at, end = "position", "m", position, scenario.road.length
        if time is not None:
            name, unit, at, end = "time", "s", time, drives[strategy].summary["travel_time"]
        if at is None or not 0 <= at <= end:
            raise InvalidError(f"The drive goes from 0 to {end:g} {unit}", parameter=name)
        if stored.core_version != CORE_VERSION:
            raise GoneError(
                f"Core version {stored.core_version} computed this run, and this service runs {CORE_VERSION}: its "
                "instants cannot be made again. Post its scenario to run it on this version."
            )
        if strategy in changed_controllers(stored):
            raise ControllerMissingError
        try:
            scenario = await self.roads.on(scenario)
        except InvalidError:
            raise RoadGoneError from None
        cost = cost_of(scenario, [strategy])
        with self.gate.computing(client, cost):
            return await self.workers.call(instant_answer, scenario, strategy, position, time, client=client, cost=cost)
