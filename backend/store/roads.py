"""Measured roads, stored by content."""

import re
from collections.abc import Iterable

from sqlalchemy import select, update

from backend.db.checksum import checksum_of
from backend.db.database import RowStore, insert_new
from backend.db.tables import roads
from backend.db.types import Now
from backend.json_types import JsonObject
from sim_core.scenario.measured import ID_PATTERN, MeasuredRoad

PROFILE = "profile"  # a road's field


def measured_roads(scenario: JsonObject) -> set[str]:
    """Ids of the measured roads that a plain scenario names: one or none."""
    road = scenario.get("road")
    named = road.get(PROFILE) if isinstance(road, dict) else None
    return set() if named is None else {named}


def swept_roads(sweep: JsonObject) -> set[str]:
    """Ids of the measured roads that a sweep names, in the form of the request; what is no id is left out."""
    name = f"road.{PROFILE}"
    named = [*(sweep.get("grid") or {}).get(name, ()), *(point.get(name) for point in sweep.get("list") or ())]
    return {each for each in named if isinstance(each, str) and re.fullmatch(ID_PATTERN, each)}


class RoadStore(RowStore):
    """Reads and writes measured roads; they never change."""

    def save(self, road: MeasuredRoad, analysis: JsonObject | None = None) -> None:
        """Commit a road; for one already stored, restart its retention. The first analysis of it stays."""
        row = {"id": road.id, "samples": road.samples, "content": road.content, "analysis": analysis}
        with self._database.writing() as connection:
            insert_new(connection, roads, [row])
            stored = update(roads).where(roads.c.id == road.id)
            first = {"analysis": analysis, "checksum": checksum_of(roads, row)}
            connection.execute(stored.where(roads.c.analysis.is_(None)).values(**first))
            connection.execute(stored.values(created_at=Now()))

    def analysis(self, road_id: str) -> JsonObject:
        """What was said of the first file of the stored road; empty where that was before roads were analysed."""
        rows = self._checked(roads, select(roads).where(roads.c.id == road_id), "measured road")
        return (rows[0].analysis if rows else None) or {}

    def load(self, ids: Iterable[str]) -> dict[str, MeasuredRoad]:
        """The stored ones of these roads, by id."""
        rows = self._checked(roads, select(roads).where(roads.c.id.in_(list(ids))), "measured road")
        return {row.id: MeasuredRoad(id=row.id, samples=row.samples, content=row.content) for row in rows}
