"""Trials of tunings. The step of their generation adds them (`JobStore.advance`), so each is stored once."""

from dataclasses import asdict, dataclass, fields
from typing import Any, Literal

from sqlalchemy import Row, select

from backend.db.database import RowStore
from backend.db.tables import trials
from backend.json_types import JsonObject


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredTrial:
    """A set of weights and its results; `values` and `limits` are None where it failed."""

    number: int
    generation: int
    weights: JsonObject
    status: Literal["ok", "failed"]
    reason: str | None = None
    feasible: bool = False
    values: list[float] | None = None
    limits: list[float] | None = None

    def row(self, job_id: str) -> dict[str, object]:
        """Return its row in the table of trials."""
        row = asdict(self)
        return {"job_id": job_id, **row, "objectives": row.pop("values")}


class TrialStore(RowStore):
    """Reads trials."""

    def of(self, job_id: str) -> list[StoredTrial]:
        """Return every trial of a tuning, in order."""
        query = select(trials).where(trials.c.job_id == job_id).order_by(trials.c.number)
        with self._database.reading() as connection:
            return [_trial(row) for row in connection.execute(query).all()]


def _trial(row: Row[Any]) -> StoredTrial:
    names = [each.name for each in fields(StoredTrial) if each.name != "values"]
    return StoredTrial(**{name: getattr(row, name) for name in names}, values=row.objectives)
