"""FMUs of scenarios. A worker does the work."""

from dataclasses import dataclass

from backend.compute.workers import Workers
from backend.fmu.archive import fmu
from backend.fmu.models import FmuRequest
from backend.gate import Gate
from backend.roads.service import MeasuredRoads

COST = 0.3  # of designing and describing one [s of one core]


@dataclass(eq=False, kw_only=True)
class Fmus:
    """The one service of FMUs."""

    workers: Workers
    gate: Gate
    roads: MeasuredRoads

    async def archive(self, asked: FmuRequest, client: str) -> bytes:
        """The FMU, a zip.

        Raises:
            CostLimitError: The service lets no request take as much.
            TemporaryError: Too much is being computed.
        """
        scenario = await self.roads.settled(asked.scenario)
        self.gate.check_cost(COST)
        with self.gate.computing(client, COST):
            return await self.workers.call(
                fmu, scenario, asked.strategy, asked.of, asked.version, asked.platforms, client=client, cost=COST
            )
