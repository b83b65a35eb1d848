"""Measured roads, stored by content."""

import re
from collections.abc import Iterable

from sqlalchemy import select, update

from backend.db.columns import checksum_of
from backend.db.database import Database
from backend.db.tables import job_roads, road_owners, roads, run_roads
from backend.json_types import JsonObject
from backend.store.files import FileStore
from sim_core.scenario.measured import ID_PATTERN, MeasuredRoad

PROFILE = "profile"  # a road's field


def measured_roads(scenario: JsonObject) -> set[str]:
    """Return the ids of the measured roads that a plain scenario names: one or none."""
    road = scenario.get("road")
    named = road.get(PROFILE) if isinstance(road, dict) else None
    return set() if named is None else {named}


def swept_roads(sweep: JsonObject) -> set[str]:
    """Return the ids of the measured roads that a sweep of a request names; what is no id is left out."""
    name = f"road.{PROFILE}"
    named = [*(sweep.get("grid") or {}).get(name, ()), *(point.get(name) for point in sweep.get("list") or ())]
    return {each for each in named if isinstance(each, str) and re.fullmatch(ID_PATTERN, each)}


class RoadStore(FileStore):
    """Reads and writes measured roads."""

    def __init__(self, database: Database) -> None:
        super().__init__(database, "measured road", roads, road_owners, run_roads, job_roads)

    def save(self, road: MeasuredRoad, analysis: JsonObject | None = None, owner: str | None = None) -> None:
        """Commit a road that a token sent; for one already stored, restart its retention.

        The first analysis of it stays.
        """
        row = {"id": road.id, "samples": road.samples, "content": road.content, "analysis": analysis}
        first = {"analysis": analysis, "checksum": checksum_of(roads, row)}
        with self._database.writing() as connection:
            self._save(connection, row, owner)
            connection.execute(update(roads).where(roads.c.id == road.id, roads.c.analysis.is_(None)).values(**first))

    def analysis(self, road_id: str) -> JsonObject:
        """Return what was said of the first file of the stored road; empty for roads of before they were analysed."""
        rows = self._checked(roads, select(roads).where(roads.c.id == road_id), "measured road")
        return (rows[0].analysis if rows else None) or {}

    def load(self, ids: Iterable[str]) -> dict[str, MeasuredRoad]:
        """Return the stored ones of these roads, by id."""
        rows = self._checked(roads, select(roads).where(roads.c.id.in_(list(ids))), "measured road")
        return {row.id: MeasuredRoad(id=row.id, samples=row.samples, content=row.content) for row in rows}
