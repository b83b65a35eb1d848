"""The paper's reproduction, computed once and cached: what every test of the paper page would else compute anew.

`rows()` is what a service stores for the page by its default readings, without preview and by the favourable ones, on
20 roads. It lies in `.cache/` under a digest of everything its numbers depend on, so it is computed again after any
change of that. A service under test takes it into its database, before it starts or while it runs:

    store_in(store)                                          # a `backend.store.Store` of this process
    store_in_database(f"sqlite:///{folder}/ridelab.sqlite")  # of another one; made where there is none yet

A drive with hardware in the loop takes a third of a second. For those by the favourable readings without preview, which
no page of docs/ shows by itself, the simulation stands in, save where UPDATE_DOCS=1 writes the pages.

Tests ask for the fixture `reproduction` (tests/servers/fixtures.py), which gives `store_in_database`.
"""

import hashlib
import os
import platform
import sys
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import orjson
from filelock import FileLock

from backend.db.database import insert_new
from backend.db.tables import results
from backend.job_run import JobRun
from backend.paper import claims, paper_rows
from backend.paper.interpretations import DEFAULT, FAVOURABLE
from backend.scenario_at import scenario_at
from backend.store import Store
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from tests.servers.process import ROOT

FOLDER = ROOT / ".cache"
SOURCES = (
    "sim_core",
    "backend/__init__.py",
    "backend/digest.py",
    "backend/errors.py",
    "backend/intervals.py",
    "backend/cost",
    "backend/controller",
    "backend/paper",
    "tests/servers/reproduction.py",
)
IN_ECU = claims.IN_ECU
ROADS = range(1, claims.SEEDS + 1)


def requests(roads: range = ROADS) -> list[JobRun]:
    """The rows that the page needs first, in an order that does not depend on the roads."""
    named = (DEFAULT.choices, FAVOURABLE.choices)
    sets = [choices | preview for choices in named for preview in ({}, {"preview": "none"})]
    under = [row for choices in sets for row in in_order(paper_rows.requests_under(choices, roads))]
    studies = [
        row
        for study in (paper_rows.ATTRIBUTION, paper_rows.SPEEDS)
        for row in paper_rows.requests_of_study(study, roads)
    ]
    return [*under, *studies]


def substitutes() -> dict[str, str]:
    """By key of a row with hardware in the loop that of the simulation's, which stands in for it."""
    if os.environ.get("UPDATE_DOCS"):
        return {}
    under = paper_rows.requests_under(FAVOURABLE.choices | {"preview": "none"}, ROADS)
    return {row.key: simulated.key for row, simulated in zip(under[claims.IN_ECU], under["lv"], strict=True)}


def distinct() -> list[JobRun]:
    """Each row to compute once: the sets share those that their differences do not reach."""
    left_out = substitutes()
    return list({row.key: row for row in requests() if row.key not in left_out}.values())


def in_order(by_strategy: Mapping[str, Sequence[JobRun]]) -> list[JobRun]:
    """Every row, strategy by strategy."""
    return [row for rows in by_strategy.values() for row in rows]


@cache
def rows() -> Any:
    """By key what a service stores for the page; computed where no test process of this checkout has done so yet."""
    path = FOLDER / f"reproduction-{digest()}{len(substitutes())}.json"
    FOLDER.mkdir(exist_ok=True)
    with FileLock(FOLDER / "reproduction.lock"):  # while another test process computes it
        if not path.exists():
            for old in FOLDER.glob("reproduction-*"):
                old.unlink()
            beside = path.with_suffix(".part")
            beside.write_bytes(orjson.dumps({row.key: computed(row) for row in distinct()}))
            beside.replace(path)
    computed_rows = orjson.loads(path.read_bytes())
    return computed_rows | {key: computed_rows[other] for key, other in substitutes().items()}


def computed(row: JobRun) -> Any:
    """The result that a worker computes."""
    scenario = scenario_at(Scenario().model_dump(mode="json"), orjson.loads(row.changes))
    return paper_rows.compute_row(scenario, row.strategy, row.key).summary


def store_in(store: Store) -> None:
    """Put it where this store's service looks for it; what is there stays."""
    store_as(store, requests(), [rows()[row.key] for row in requests()])


def store_without_ecu(store: Store, reason: str) -> None:
    """The same where hardware in the loop failed for that reason."""
    driven = [row for row in requests() if row.strategy != IN_ECU]
    store_as(store, driven, [rows()[row.key] for row in driven])
    failed = [row for row in requests() if row.strategy == IN_ECU]
    store_as(store, failed, [{"reason": reason}] * len(failed), status="failed")


def store_as(store: Store, wanted: Sequence[JobRun], summaries: Sequence[Any], status: str = "ok") -> None:
    """Store these summaries as those rows."""
    same = {"core_version": CORE_VERSION, "status": status, "compute_ms": 1.0, "created_at": datetime.now(UTC)}
    items = [
        {"key": row.key, "strategy": row.strategy, "summary": orjson.dumps(summary).decode(), **same}
        for row, summary in zip(wanted, summaries, strict=True)
    ]
    with store.writing() as connection:
        insert_new(connection, results, items)


def store_in_database(url: str) -> None:
    """Store the reproduction in a database of that SQLAlchemy URL, migrated to the newest schema."""
    store = Store(url)
    try:
        store.migrate()
        store_in(store)
    finally:
        store.close()


def digest() -> str:
    """A hash of everything the numbers depend on: sources, installed packages, Python and machine."""
    packages = sorted({path.name for folder in sys.path for path in Path(folder).glob("*.dist-info")})
    content_hash = hashlib.sha256(repr([sys.version, platform.machine(), packages]).encode())
    for name in SOURCES:
        assert (ROOT / name).exists(), name
        for path in sorted([ROOT / name, *(ROOT / name).rglob("*")]):
            if path.is_file() and "__pycache__" not in path.parts:
                content_hash.update(f"{path.relative_to(ROOT)}\0".encode() + path.read_bytes())
    return content_hash.hexdigest()[:24]
