"""Recorded drives: read from CSV, stored, and added to scenarios of runs that show them."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from backend.compute.workers import Workers
from backend.errors import InvalidError, NotFoundError
from backend.gate import Gate
from backend.recordings import export, reading
from backend.recordings.models import CreatedRecording, RecordedColumn, RecordingAnswer, RecordingPage, RecordingRow
from backend.store import Store
from backend.tables import Tables
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import PREFIX, RecordedDrive, recording_id

CSV_COST = 2e-6  # of one value [s of one core]


@dataclass(eq=False, kw_only=True)
class Recordings:
    """The one service of recorded drives."""

    store: Store
    workers: Workers
    gate: Gate
    tables: Tables

    async def create(
        self, content: bytes | Path, table: Mapping[str, Any] | None, client: str, owner: str | None
    ) -> CreatedRecording:
        """Read a file that a token sent, and store its recording; the first arguments as of `reading.read`.

        Raises:
            InvalidError: It is none, or has to be asked about.
            TemporaryError: Too much is being read.
        """
        read = await self.tables.read(client, reading.read, content, table)
        await self.store.write(self.store.recordings.save, read.drive, owner)
        head = await self.workers.call(head_of, read.drive, client=client)
        columns = [RecordedColumn(name=each.title, signal=each.means, unit=each.unit) for each in read.columns]
        return CreatedRecording(**head, columns=columns, warnings=list(read.warnings))

    async def get(self, recording: str, client: str) -> RecordingAnswer:
        """Return the stored recording.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too much is being computed.
        """
        drive = await self._stored(recording)
        with self.gate.computing(client, 0.0):
            return RecordingAnswer(**await self.workers.call(head_of, drive, client=client))

    async def page(self, owner: str | None, limit: int, cursor: str | None) -> RecordingPage:
        """Return the newest recordings, those that an owner sent or (None) all."""
        rows, following = await self.store.read(self.store.recordings.page, owner, limit, cursor)
        named = [{"strategy": f"{PREFIX}{row.id}", "signals": row.signals.split(",")} for row in rows]
        recordings = [RecordingRow(**{**row._mapping, **more}) for row, more in zip(rows, named, strict=True)]
        return RecordingPage(recordings=recordings, next=following)

    async def delete(self, recording: str, owner: str | None) -> None:
        """Take a recording back; see `FileStore.delete`."""
        await self.store.write(self.store.recordings.delete, recording, owner)

    async def csv(self, recording: str, client: str) -> bytes:
        """Return its signals as CSV; sent again, it is the same recording.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too much is being computed.
        """
        drive = await self._stored(recording)
        cost = CSV_COST * drive.samples * len(drive.keys.split(","))
        with self.gate.computing(client, cost):
            return await self.workers.call(export.as_csv, drive, client=client, cost=cost)

    async def _stored(self, recording: str) -> RecordedDrive:
        drive = (await self.store.read(self.store.recordings.load, [recording])).get(recording)
        if drive is None:
            raise NotFoundError("There is no recording of this id.")
        return drive

    async def on(self, scenario: Scenario, strategies: Iterable[str]) -> Scenario:
        """Return the scenario with the recordings among these strategies.

        Raises:
            InvalidError: One is not there.
        """
        drives = await self.named(strategies)
        return scenario.with_recordings(drives.values()) if drives else scenario

    async def named(self, strategies: Iterable[str]) -> Mapping[str, RecordedDrive]:
        """Return the recordings among these strategies, by id.

        Raises:
            InvalidError: One is not there.
        """
        wanted = {each for name in strategies if (each := recording_id(name)) is not None}
        drives: dict[str, RecordedDrive] = await self.store.read(self.store.recordings.load, wanted) if wanted else {}
        if wanted - drives.keys():
            raise InvalidError("There is no recording of this id.", kind="unknown", pointer="/strategies")
        return drives


def head_of(drive: RecordedDrive) -> dict[str, Any]:
    """Return what is answered about a recording; by a worker."""
    signals = drive.signals()
    duration, distance = (float(np.ptp(signals[key])) if key in signals else None for key in ("time", "position"))
    return {
        "id": drive.id,
        "strategy": f"{PREFIX}{drive.id}",
        "samples": drive.samples,
        "signals": list(signals),
        "duration": duration,
        "distance": distance,
    }
