"""Recorded drives, stored by content."""

from collections.abc import Iterable

from sqlalchemy import select

from backend.db.database import Database
from backend.db.tables import recording_owners, recordings, run_recordings
from backend.store.files import FileStore
from sim_core.scenario.recorded import RecordedDrive


class RecordingStore(FileStore):
    """Reads and writes recordings."""

    def __init__(self, database: Database) -> None:
        super().__init__(database, "recording", recordings, recording_owners, run_recordings)

    def save(self, drive: RecordedDrive, owner: str | None = None) -> None:
        """Commit a recording that a token sent; for one already stored, restart its retention."""
        row = {"id": drive.id, "samples": drive.samples, "signals": drive.keys, "content": drive.content}
        with self._database.writing() as connection:
            self._save(connection, row, owner)

    def load(self, ids: Iterable[str]) -> dict[str, RecordedDrive]:
        """Return the stored ones of these recordings, by id."""
        rows = self._checked(recordings, select(recordings).where(recordings.c.id.in_(list(ids))), "recording")
        return {
            row.id: RecordedDrive(id=row.id, samples=row.samples, keys=row.signals, content=row.content) for row in rows
        }
