"""DRILL_CUTS power cuts (1,000, by DRILL_SEED) of the store with each journal; DRILL_KILLS (50) of a whole service.

And as many ends of all of PostgreSQL's processes.
"""

import os
import threading
from collections import Counter
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from sqlalchemy.exc import OperationalError

from backend.db import sqlite
from backend.store import Store
from tests.faults.power import service
from tests.faults.power.cuts import cut, record
from tests.faults.power.work import Work, rows
from tests.servers.postgres import Postgres

CUTS = int(os.environ.get("DRILL_CUTS", "1000"))
KILLS = int(os.environ.get("DRILL_KILLS", "50"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
IMMUTABLE = ("results", "runs", "run_results", "roads", "links", "pinned_series")
EACH, PIECES = 50, 150  # cuts of one recording, and its pieces of work


@pytest.mark.timeout(3600)
@pytest.mark.parametrize("wal", [True, False], ids=["WAL", "DELETE"])
def test_what_was_acknowledged_is_there_after_a_power_cut(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, wal: bool
) -> None:
    monkeypatch.setattr(sqlite, "wal_is_safe", lambda _: wal)
    fates, broken, calls = Counter[str](), list[str](), 0
    for seed in range(SEED, SEED + -(-CUTS // EACH)):
        recorded = record(tmp_path, seed=seed, pieces=PIECES, wal=wal)
        cuts = cut(recorded, tmp_path / f"data-{seed}", seed=seed, count=min(EACH, CUTS - fates.total()))
        fates, broken, calls = fates + cuts.fates, broken + cuts.broken, calls + len(recorded)
    print(f"\n{fates.total()} power cuts of {calls} calls, seeds from {SEED}; what was not synced: {dict(fates)}")
    assert not broken, broken


@pytest.mark.timeout(7200)
def test_a_service_answers_as_before_after_a_power_cut(tmp_path: Path) -> None:
    recorded = service.record(tmp_path, seed=SEED, pieces=25)
    broken, asked = service.cut(recorded, tmp_path / "data", seed=SEED, count=KILLS)
    print(f"\n{KILLS} power cuts of {len(recorded)} calls, seed {SEED}: {asked} acknowledged answers asked for again")
    assert not broken, broken


@pytest.mark.timeout(3600)
def test_power_cuts_show_that_nothing_was_synced(tmp_path: Path) -> None:
    """Else they would prove nothing."""
    recorded = service.record(tmp_path, seed=SEED, pieces=6, kind=service.Unsynced)
    broken, asked = service.cut(recorded, tmp_path / "data", seed=SEED, count=2)
    print(f"\n2 power cuts where nothing is synced, seed {SEED}: of {asked} answers {len(broken)} wrong: {broken[:1]}")
    assert broken


@pytest.mark.timeout(3600)
def test_what_postgresql_committed_is_there_after_it_was_killed() -> None:
    """With fsync; each time all its processes are killed at a random moment of the work."""
    server, rng, pieces = Postgres(fsync="on", full_page_writes="on"), np.random.default_rng(SEED), 0
    try:
        with closing(Store(server.new_database())) as store:
            store.migrate()
            for number in range(KILLS):
                acknowledged, work = rows(store), Work(store, 1000 * SEED + number)
                killing = threading.Timer(rng.uniform(0.05, 0.5), server.kill)
                killing.start()
                try:
                    while True:
                        work.do()
                        acknowledged, pieces = rows(store), pieces + 1
                except OperationalError:
                    pass  # it was killed
                killing.join()
                server.start()
                store.engine.dispose()
                there = rows(store)
                lost = {name: set(acknowledged[name]) - set(there[name]) for name in IMMUTABLE}
                assert not any(lost.values()), lost
    finally:
        server.remove()
    print(f"\n{KILLS} times killed, seed {SEED}: {pieces} pieces of work, none of them lost")
