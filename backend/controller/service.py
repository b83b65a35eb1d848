"""Controllers: exported, checked against the part, driven in real time. A worker does the work."""

from collections.abc import Callable
from typing import TypeVar

from backend.compute.workers import Workers
from backend.controller import export, realtime, report
from backend.controller.models import ControllerReport, RealtimeReport
from backend.cost.estimate import duration, estimate
from backend.errors import CostLimitError
from backend.gate import Gate
from backend.roads.service import MeasuredRoads
from sim_core.scenario import Scenario

T = TypeVar("T")
STRATEGY = "lv_hil"
BUILDING = 1.0  # one controller for its part [s of one core]


class Controllers:
    """The one service of controllers."""

    def __init__(self, *, workers: Workers, gate: Gate, roads: MeasuredRoads, max_request_cost: float) -> None:
        self._workers = workers
        self._gate = gate
        self._roads = roads
        self._longest = min(
            realtime.LONGEST, 2 * max_request_cost
        )  # a drive by the clock holds a worker and mostly waits [s]

    async def archive(self, scenario: Scenario, client: str) -> bytes:
        """A zip of C sources.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self._roads.with_length(scenario)
        cost = estimate(scenario, STRATEGY)
        self._gate.check_cost(cost)
        with self._gate.computing(client, cost):
            return await self._workers.call(export.archive, scenario, client=client, cost=cost)

    async def report(self, scenario: Scenario, client: str) -> ControllerReport:
        """Whether the scenario's controller fits the part, and what does.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self._roads.on(scenario)
        cost = len(report.VARIANTS) * (BUILDING + estimate(scenario, STRATEGY))
        return await self._alone(report.report, scenario, client, cost, cost)

    async def drive_by_clock(self, scenario: Scenario, client: str) -> RealtimeReport:
        """Drive in real time; it takes as long as the drive.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self._roads.on(scenario)
        time = await self._workers.call(duration, scenario, STRATEGY, client=client)
        if time > self._longest:
            message = f"The drive may take {time:.0f} s; a drive by the clock at most {self._longest:.0f} s"
            raise CostLimitError(f"{message}.", pointer="/scenario")
        return await self._alone(realtime.drive_by_clock, scenario, client, 2 * estimate(scenario, STRATEGY), time)

    async def _alone(
        self, function: Callable[[Scenario], T], scenario: Scenario, client: str, cost: float, lasts: float
    ) -> T:
        """Run it in a worker, for about so many seconds of which it computes `cost`."""
        self._gate.check_cost(cost)
        with self._gate.computing(client, cost, controller=1):
            return await self._workers.call(function, scenario, client=client, cost=lasts)
