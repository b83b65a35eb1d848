"""A recorded drive out of a table. Runs in a worker: no web."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sim_core.scenario.recorded import RecordedDrive
from sim_core.tables.columns import Column
from sim_core.tables.table import read_table
from sim_core.tables.titles import DRIVE


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """The result of reading a file: the recording, its columns, and warnings."""

    drive: RecordedDrive
    columns: Sequence[Column]
    warnings: Sequence[str]


def read(content: bytes | Path, table: Mapping[str, Any] | None = None) -> Reading:
    """Return the recording of a table, with corrections as of `sim_core.read_table`.

    Raises:
        TableError: It is none; an UnsureTableError where it has to be asked about.
    """
    found = read_table(content, DRIVE, table)
    return Reading(drive=RecordedDrive.of(found.signals), columns=found.columns, warnings=found.notes)
