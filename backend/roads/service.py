"""Measured roads: read from files, stored, answered, and added to scenarios that name them."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass

import numpy as np

from backend.compute.workers import Workers
from backend.errors import InvalidError, NotFoundError, ShortRoadError
from backend.gate import Gate
from backend.json_types import JsonObject
from backend.models import CautionAnswer
from backend.roads import survey
from backend.roads.models import CreatedRoad, FoundBumpAnswer, RoadAnswer, RoadPage, RoadRow
from backend.store import Store
from backend.tables import Tables
from sim_core import RidelabError, Scenario
from sim_core.comparison.road_cautions import road_cautions, spectrum_caution
from sim_core.road.iso8608 import Estimate
from sim_core.road.survey import DetectedBump, bumps_in
from sim_core.scenario.measured import SPACING, MeasuredRoad

EXPORT_COST = 2e-6  # of one height [s of one core]
POINTER = "/scenario/road/profile"


@dataclass(eq=False, kw_only=True)
class MeasuredRoads:
    """The one service of measured roads."""

    store: Store
    workers: Workers
    gate: Gate
    tables: Tables

    async def create(
        self, client: str, owner: str | None, read: Callable[..., survey.Survey], *file: object
    ) -> CreatedRoad:
        """Store the road that `read` makes of a file, which a token sent.

        Raises:
            InvalidError: It is none, or has to be asked about.
            TemporaryError: Too much is being read.
        """
        surveyed = await self.tables.read(client, read, *file)
        await self.store.write(self.store.roads.save, surveyed.road, surveyed.analysis, owner)
        head = _head(surveyed.road, surveyed.bumps, surveyed.analysis)
        return CreatedRoad(**head, warnings=surveyed.warnings)

    async def get(self, road_id: str, points: int, client: str) -> RoadAnswer:
        """Return the stored road with at most so many of its heights.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too much is being computed.
        """
        road = await self._stored(road_id)
        analysis = await self.store.read(self.store.roads.analysis, road_id)
        with self.gate.computing(client, 0.0):
            distance, height, bumps = await self.workers.call(drawn, road, points, client=client)
        return RoadAnswer(**_head(road, bumps, analysis), distance=distance, height=height)

    async def page(self, owner: str | None, limit: int, cursor: str | None) -> RoadPage:
        """Return the newest roads, those that an owner sent or (None) all."""
        rows, following = await self.store.read(self.store.roads.page, owner, limit, cursor)
        roads = [
            RoadRow(**row._mapping, length=MeasuredRoad(id=row.id, samples=row.samples, content=b"").length)
            for row in rows
        ]
        return RoadPage(roads=roads, next=following)

    async def delete(self, road_id: str, owner: str | None) -> None:
        """Take a road back; see `FileStore.delete`."""
        await self.store.write(self.store.roads.delete, road_id, owner)

    async def exported(self, road_id: str, client: str, write: Callable[[MeasuredRoad], bytes]) -> bytes:
        """Return every height of the stored road, as `write` writes it; sent again, it is the same road.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too much is being computed.
        """
        road = await self._stored(road_id)
        cost = EXPORT_COST * road.samples
        with self.gate.computing(client, cost):
            return await self.workers.call(write, road, client=client, cost=cost)

    async def _stored(self, road_id: str) -> MeasuredRoad:
        road = (await self.store.read(self.store.roads.load, [road_id])).get(road_id)
        if road is None:
            raise NotFoundError(_missing(road_id))
        return road

    async def settled(self, scenario: Scenario) -> Scenario:
        """Return the scenario as it is driven and known by, with what it takes from its measured road.

        Raises:
            InvalidError: There is no such road, or the bump is not on it.
        """
        return await self.on(scenario) if scenario.road.follows_profile else scenario

    async def on(self, scenario: Scenario) -> Scenario:
        """Return the scenario with the heights of the measured road it names.

        Raises:
            InvalidError: There is no such road, or the bump is not on it.
            ShortRoadError: It is shorter than the scenario's.
        """
        profile = scenario.road.profile
        if profile is None:
            return scenario
        road = (await self.named([profile]))[profile]
        if scenario.road.length > road.length and not scenario.road.ends_with_profile:
            message = f"The measured road is {road.length:g} m long: the road's length can be at most that"
            raise ShortRoadError(f"{message}.", pointer="/scenario/road/length")
        try:
            return scenario.on(road)
        except RidelabError as error:
            raise InvalidError(f"{error.message}.", pointer=f"/scenario/{str(error.field).replace('.', '/')}") from None

    async def named(self, ids: Iterable[str], pointer: str = POINTER) -> Mapping[str, MeasuredRoad]:
        """Return the roads of these ids.

        Raises:
            InvalidError: One is not there.
        """
        wanted = set(ids)
        roads: dict[str, MeasuredRoad] = await self.store.read(self.store.roads.load, wanted) if wanted else {}
        if missing := sorted(wanted - roads.keys()):
            raise InvalidError(_missing(missing[0]), kind="unknown", pointer=pointer)
        return roads


def _cautions(analysis: JsonObject, length: float) -> list[CautionAnswer]:
    """Return what to beware of by the analysis of the file that was sent; nothing where that is not known any more."""
    indices, fitted = analysis.get("iri"), analysis.get("roughness")
    if not indices:
        return []
    cautions = list(road_cautions(indices["tracks"]))
    if fitted and analysis["iso_class"] is None:
        cautions.append(spectrum_caution(Estimate(**fitted).span, length, indices["mean"]))
    return [CautionAnswer.model_validate(each) for each in cautions]


def _missing(road_id: str) -> str:
    return (
        f"There is no measured road {road_id} here: send this service its file, in the lab or with `ridelab road FILE` "
        "and the same --server or --data-dir."
    )


def drawn(road: MeasuredRoad, points: int) -> tuple[list[float], list[float], list[DetectedBump]]:
    """Return at most `points` of its heights, the ends and extremes of each section, with distances; and its bumps."""
    heights = road.heights()
    count, sections = len(heights), (points - 2) // 2
    samples = np.arange(count)
    if points < count:
        each = -(-count // max(1, sections))
        sections_of_road = np.pad(heights, (0, -count % each), mode="edge").reshape(-1, each)[:sections]
        first = np.arange(len(sections_of_road)) * each
        lowest, highest = first + sections_of_road.argmin(axis=1), first + sections_of_road.argmax(axis=1)
        samples = np.unique(np.concatenate([[0], lowest, highest, [count - 1]]).clip(max=count - 1))
    return (samples * SPACING).round(2).tolist(), heights[samples].tolist(), bumps_in(heights)


def _head(road: MeasuredRoad, bumps: Iterable[DetectedBump], analysis: JsonObject) -> JsonObject:
    """Return the members of `RoadHead`."""
    return {
        "id": road.id,
        "length": road.length,
        "samples": road.samples,
        "bumps": [FoundBumpAnswer(**asdict(each)) for each in bumps],
        "cautions": _cautions(analysis, road.length),
        **analysis,
    }
