"""Recorded drives, stored by content."""

from collections.abc import Iterable

from sqlalchemy import select, update

from backend.db.database import RowStore, insert_new
from backend.db.tables import recordings
from backend.db.types import Now
from sim_core.scenario.recorded import RecordedDrive


class RecordingStore(RowStore):
    """Reads and writes recordings; they never change."""

    def save(self, drive: RecordedDrive) -> None:
        """Commit a recording; for one already stored, restart its retention."""
        row = {"id": drive.id, "samples": drive.samples, "signals": drive.keys, "content": drive.content}
        with self._database.writing() as connection:
            insert_new(connection, recordings, [row])
            connection.execute(update(recordings).where(recordings.c.id == drive.id).values(created_at=Now()))

    def load(self, ids: Iterable[str]) -> dict[str, RecordedDrive]:
        """The stored ones of these recordings, by id."""
        rows = self._checked(recordings, select(recordings).where(recordings.c.id.in_(list(ids))), "recording")
        return {
            row.id: RecordedDrive(id=row.id, samples=row.samples, keys=row.signals, content=row.content) for row in rows
        }
