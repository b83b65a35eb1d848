"""Makes the fixture of today's schema version: what a database holds of a link of an older core version.

    .venv/bin/python tests/data/links/dump.py > tests/data/links/schema-1.json

A fixture is made once, before `SCHEMA_VERSION` is raised, and never again: it stands for the databases out there. The
"older core" is today's with a car 1 % heavier, so that numbers computed again would not be those that are stored.
"""

import base64
import dataclasses
import json
import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT))

from sqlalchemy import DateTime, LargeBinary, Table, insert, select  # noqa: E402  # after the path

from backend import digest, pins  # noqa: E402
from backend.series import pack  # noqa: E402
from backend.store import Store, StoredLink, StoredResult  # noqa: E402
from backend.store.tables import links, pinned_series, results, run_results, runs  # noqa: E402
from sim_core.scenario import SCHEMA_VERSION, Bump, Road, Scenario, Speed  # noqa: E402
from sim_core.simulate import simulate  # noqa: E402  # after the path, as all above

CORE_VERSION = "0.0.9"
REVISION = "0003"  # of the database's own schema, when this fixture was made
WHEN = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
TABLES: tuple[Table, ...] = (results, runs, run_results, links, pinned_series)  # in the order rows may be put in
SCENARIO = Scenario(
    road=Road(length=12, seed=9, bump=Bump(height=0.08, width=2, start=5)),
    speed=Speed(initial_speed_kmh=40, target_speed_kmh=35, detection_distance=5),
)
STRATEGIES = ("lv", "passive")
VIEW = {
    "strategies": ["passive", "lv"],
    "hidden": [],
    "baseline": "passive",
    "axis": "time",
    "zoom": [0.25, 0.75],
    "cursor": 0.5,
}


def fill(store: Store) -> None:
    """Store a run as the older core would have, and a link to it."""
    heavier = SCENARIO.vehicle.model_copy(update={"body_mass": 1.01 * SCENARIO.vehicle.body_mass})
    computed = {name: simulate(SCENARIO.model_copy(update={"vehicle": heavier}), name) for name in STRATEGIES}
    digest.CORE_VERSION = CORE_VERSION
    outcomes = [
        StoredResult(
            key=digest.result_key(SCENARIO, name),
            strategy=name,
            status="ok",
            summary=json.loads(json.dumps(result.summary(), default=_plain)),
            compute_ms=12.5,
        )
        for name, result in computed.items()
    ]
    run_id = digest.run_id(SCENARIO, STRATEGIES)
    store.runs.save(
        run_id=run_id,
        core_version=CORE_VERSION,
        schema_version=SCHEMA_VERSION,
        scenario=SCENARIO.model_dump(mode="json"),
        outcomes=outcomes,
    )
    link = StoredLink(slug="fixture-of-schema-0001", kind="run", target=run_id, view=VIEW, created_at=WHEN)
    store.links.save(
        link, {item.key: pins.write(pack(computed[item.strategy]), item.strategy, CORE_VERSION) for item in outcomes}
    )


def dump(store: Store) -> dict[str, Any]:
    """The revision, and every row by table; bytes in base64, and times made equal."""
    with store.reading() as connection:
        rows = {
            table.name: [
                {name: _to_json(value) for name, value in row._asdict().items()}
                for row in connection.execute(select(table)).all()
            ]
            for table in TABLES
        }
    return {"revision": REVISION, **rows}


def load(store: Store, content: Mapping[str, Any]) -> None:
    """Put the rows of a fixture into a database that stands at its revision."""
    with store.writing() as connection:
        for table in TABLES:
            rows = [
                {name: _from_json(table, name, value) for name, value in row.items()} for row in content[table.name]
            ]
            connection.execute(insert(table), rows)


def bytes_of(text: str) -> bytes:
    """What the fixture writes in base64."""
    return base64.b64decode(text)


def _to_json(value: Any) -> Any:
    if isinstance(value, datetime):
        return WHEN.isoformat()
    return base64.b64encode(value).decode() if isinstance(value, bytes) else value


def _from_json(table: Table, name: str, value: Any) -> Any:
    kind = table.c[name].type
    if isinstance(kind, DateTime):
        return datetime.fromisoformat(value)
    return bytes_of(value) if isinstance(kind, LargeBinary) else value


def _plain(value: Any) -> Any:
    return dataclasses.asdict(value) if dataclasses.is_dataclass(value) else value.tolist()


if __name__ == "__main__":
    memory = Store("sqlite:///file:fixture?mode=memory&cache=shared&uri=true")
    memory.migrate(REVISION)
    fill(memory)
    json.dump(dump(memory), sys.stdout, indent=1)
    print()
