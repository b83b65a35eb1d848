"""A power cut takes nothing back that was acknowledged; the drill tries a thousand."""

import sqlite3
from pathlib import Path

from backend.db.sqlite import wal_is_safe
from tests.faults.power.cuts import cut, record


def test_what_was_acknowledged_is_there_after_a_power_cut(tmp_path: Path) -> None:
    recorded = record(tmp_path, seed=1, pieces=8, wal=wal_is_safe(sqlite3.sqlite_version_info))
    cuts = cut(recorded, tmp_path / "data-1", seed=1, count=5)
    assert cuts.fates.total() == 5
    assert not cuts.broken
