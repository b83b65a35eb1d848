"""Controllers: exported, checked against the part, driven in real time. A worker does the work."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from cachetools import LRUCache

from backend.compute.workers import Workers
from backend.cost.estimate import duration, estimate
from backend.ecu import export, realtime, report
from backend.ecu.build import firmware_fault, program_fault
from backend.ecu.models import Compilers, ControllerReport, RealtimeReport
from backend.errors import CostLimitError
from backend.gate import Gate
from backend.roads.service import MeasuredRoads
from sim_core.scenario import Scenario

T = TypeVar("T")
STRATEGY = "lv_hil"
BUILDING = 1.0  # one controller for its part [s of one core]
CACHED_REPORTS = 16


@dataclass(eq=False, kw_only=True)
class Controllers:
    """The one service of controllers."""

    workers: Workers
    gate: Gate
    roads: MeasuredRoads
    max_request_cost: float
    _reports: LRUCache[str, ControllerReport] = field(init=False, default_factory=lambda: LRUCache(CACHED_REPORTS))

    @staticmethod
    def compilers() -> Compilers:
        """What is missing on this machine to build the ECU's program."""
        fault = program_fault()
        return Compilers(report=firmware_fault() or fault, realtime=fault)

    async def archive(self, scenario: Scenario, client: str) -> bytes:
        """A zip of C sources.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self.roads.settled(scenario)
        cost = estimate(scenario, STRATEGY)
        self.gate.check_cost(cost)
        with self.gate.computing(client, cost):
            return await self.workers.call(export.archive, scenario, client=client, cost=cost)

    async def report(self, scenario: Scenario, client: str) -> ControllerReport:
        """Whether the scenario's controller fits the part, and what does.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        key = scenario.model_dump_json()
        scenario = await self.roads.on(scenario)
        if key not in self._reports:
            cost = len(report.VARIANTS) * (BUILDING + estimate(scenario, STRATEGY))
            self._reports[key] = await self._alone(report.report, scenario, client, cost, cost)
        return self._reports[key]

    async def drive_by_clock(self, scenario: Scenario, client: str) -> RealtimeReport:
        """Drive in real time; it takes as long as the drive.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self.roads.on(scenario)
        time = await self.workers.call(duration, scenario, STRATEGY, client=client)
        longest = min(realtime.LONGEST, 2 * self.max_request_cost)  # it holds a worker and mostly waits [s]
        if time > longest:
            message = f"The drive may take {time:.0f} s; a drive by the clock at most {longest:.0f} s"
            raise CostLimitError(f"{message}.", pointer="/scenario")
        return await self._alone(realtime.drive_by_clock, scenario, client, 2 * estimate(scenario, STRATEGY), time)

    async def _alone(
        self, function: Callable[[Scenario], T], scenario: Scenario, client: str, cost: float, lasts: float
    ) -> T:
        """Run it in a worker, for about so many seconds of which it computes `cost`."""
        self.gate.check_cost(cost)
        with self.gate.computing(client, cost, controller=1):
            return await self.workers.call(function, scenario, client=client, cost=lasts)
