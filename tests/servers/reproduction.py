"""The paper's reproduction, stored in tests/data, so that no test of the paper page has to compute it.

It is what a service stores for the page under each named set of readings and under each without preview, on 20
roads. tests/api/test_reproduction.py computes a sample of it anew, `make drill` all; UPDATE_DOCS=1 writes
what this core computes. A service under test takes it into its database, before it starts or while it runs:

    store_in(store)                                          # a `backend.store.Store` of this process
    store_in_database(f"sqlite:///{folder}/ridelab.sqlite")  # of another one; made where there is none yet

Tests ask for the fixture `reproduction` (tests/servers/fixtures.py), which gives `store_in_database`.
"""

import gzip
import os
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import cache
from typing import Any

import orjson

from backend.db.database import insert_new
from backend.db.tables import results
from backend.job_run import JobRun
from backend.paper import claims, paper_rows
from backend.paper.interpretations import INTERPRETATIONS
from backend.scenario_at import scenario_at
from backend.store import Store
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from tests.results import moved_only
from tests.servers.process import ROOT

FILE = ROOT / "tests/data/reproduction.json.gz"
IN_ECU = claims.IN_ECU
ROADS = range(1, claims.SEEDS + 1)


def requests(roads: range = ROADS) -> list[JobRun]:
    """The rows that the page needs first, in an order that does not depend on the roads."""
    sets = [item.choices | preview for item in INTERPRETATIONS.values() for preview in ({}, {"preview": "none"})]
    under = [row for choices in sets for row in in_order(paper_rows.requests_under(choices, roads))]
    studies = [
        row
        for study in (paper_rows.ATTRIBUTION, paper_rows.SPEEDS)
        for row in paper_rows.requests_of_study(study, roads)
    ]
    return [*under, *studies]


def distinct() -> list[JobRun]:
    """Each row once: the sets share those that their differences do not reach."""
    return list({row.key: row for row in requests()}.values())


def in_order(by_strategy: Mapping[str, Sequence[JobRun]]) -> list[JobRun]:
    """Every row, strategy by strategy."""
    return [row for rows in by_strategy.values() for row in rows]


@cache
def rows() -> dict[str, Any]:
    """By key what a service stores for the page."""
    if os.environ.get("UPDATE_DOCS"):
        written = FILE.with_suffix(f".{os.getpid()}")  # another process may read the file
        summaries = moved_only(_stored(), orjson.loads(orjson.dumps([computed(row) for row in distinct()])))
        written.write_bytes(gzip.compress(orjson.dumps(summaries), mtime=0))
        written.replace(FILE)
    return {row.key: summary for row, summary in zip(distinct(), _stored(), strict=True)}


def _stored() -> list[Any]:
    """Return what the file has of each row."""
    stored: list[Any] = orjson.loads(gzip.decompress(FILE.read_bytes()))
    return stored


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
