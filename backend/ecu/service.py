"""Controllers: exported and checked against the part. A worker does the work."""

from dataclasses import dataclass, field

from cachetools import LRUCache

from backend.compute.workers import Workers
from backend.cost.estimate import estimate
from backend.ecu import export, report
from backend.ecu.models import ControllerReport
from backend.gate import Gate
from backend.roads.service import MeasuredRoads
from sim_core.scenario import Scenario

STRATEGY = "lv_hil"
CACHED_REPORTS = 16


@dataclass(eq=False, kw_only=True)
class Controllers:
    """The one service of controllers."""

    workers: Workers
    gate: Gate
    roads: MeasuredRoads
    _reports: LRUCache[str, ControllerReport] = field(init=False, default_factory=lambda: LRUCache(CACHED_REPORTS))

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
        """Report whether the scenario's controller fits the part, and which smaller ones do.

        Raises:
            CostLimitError: It would take too much.
            TemporaryError: Too much is being computed.
        """
        key = scenario.model_dump_json()
        scenario = await self.roads.on(scenario)
        if key not in self._reports:
            cost = len(report.VARIANTS) * estimate(scenario, STRATEGY)
            self.gate.check_cost(cost)
            with self.gate.computing(client, cost):
                self._reports[key] = await self.workers.call(report.report, scenario, client=client, cost=cost)
        return self._reports[key]
