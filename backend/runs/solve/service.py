"""Computes runs at the values that the search for a limit proposes; each is stored as every run is."""

from dataclasses import dataclass

from pydantic import ValidationError

from backend.cost.estimate import cost_of
from backend.errors import ShortRoadError
from backend.gate import Gate
from backend.roads.service import MeasuredRoads
from backend.runs.service import Runs
from backend.runs.solve.limit_search import MAX_VALUES, next_indices
from backend.runs.solve.models import Solution, SolveRequest
from backend.runs.solve.solution import Tried, bounds_of, of_metric, of_requirements, scenario_of, solution
from backend.scenario_at import contradiction
from sim_core import RidelabError

LENGTH = "road.length"


@dataclass(eq=False, kw_only=True)
class Solver:
    """Finds the largest value of a field that keeps a limit."""

    runs: Runs
    gate: Gate
    roads: MeasuredRoads

    async def solve(self, request: SolveRequest, client: str) -> Solution:
        """The largest value in the range, its bracket, and what is to be said about it.

        One value after the other, so that requests of others come in between. What was driven is stored: asked again
        after an error it goes on from there.

        Raises:
            CostLimitError: As many values as may be tried would cost too much.
            NoSolutionError: No value in the range keeps the limit.
            InvalidError: No value in the range can be driven, or the strategy has no such metric.
            TemporaryError: Too much is being computed.
        """
        request = request.model_copy(update={"scenario": await self.roads.settled(request.scenario)})
        cost = _max_cost(request)
        self.gate.check_cost(cost)
        tried: dict[int, Tried] = {}
        with self.gate.computing(client, cost):
            while indices := next_indices(request.axis, request.bound, bounds_of(tried)):
                for index in indices:
                    tried[index] = await self._drive(request, index, client)
        return solution(request, tried)

    async def _drive(self, request: SolveRequest, index: int, client: str) -> Tried:
        try:
            scenario = scenario_of(request, index)
        except ValidationError as error:
            return Tried(reason=contradiction(error))
        try:
            run, _ = await self.runs.get_or_compute(
                scenario, request.driven, client, roads=request.roads, baseline=None
            )
        except ShortRoadError as error:
            if request.field != LENGTH:  # every value would fail alike: the scenario is to blame
                raise
            return Tried(reason=error.message.removesuffix("."))
        failures = [each.summary["reason"] for each in run.results if each.status != "ok"]
        if failures:
            return Tried(run_id=run.id, reason=failures[0])
        driven = {name: [each.summary for each in results] for name, results in run.by_strategy.items()}
        return (
            of_requirements(request, run.id, driven) if request.metric is None else of_metric(request, run.id, driven)
        )


def _max_cost(request: SolveRequest) -> float:
    """Estimate what trying as many values as may be would cost [s of one core]: all like the costliest of the scan."""
    costs = [0.0]
    for index in request.axis.scan:
        try:
            costs.append(cost_of(scenario_of(request, index), request.driven))
        except (ValidationError, RidelabError):
            continue  # what it is, its run says
    return max(costs) * min(request.axis.last + 1, MAX_VALUES) * request.roads
