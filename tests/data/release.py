"""A database as core 0.2.0 left it when it was killed: every row, and what its service had answered before.

    .venv/bin/python tests/data/release.py CHECKOUT > tests/data/release_0_2_0.json.gz

Such a fixture is made once, by a release's own code, and never again: it stands for the databases out there. It has two
runs (a strategy of the second failed), links to them and to a batch, and a batch and a tuning each that are done and
that are not.
"""

import base64
import gzip
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import httpx
from sqlalchemy import Connection, DateTime, LargeBinary, MetaData, create_engine, make_url, select, text
from sqlalchemy.types import TypeEngine

from backend.store import Store

SCENARIO = {
    "road": {"length": 12, "seed": 9, "bump": {"height": 0.08, "width": 2, "start": 5}},
    "speed": {"initial_speed_kmh": 60, "target_speed_kmh": 50, "detection_distance": 5},
}
VIEW = {"hidden": [], "baseline": "passive", "axis": "time", "zoom": [0.25, 0.75], "cursor": 0.5}
SWEEP = {"grid": {"road.bump.height": [0.05, 0.08], "road.bump.start": [5, 11]}}  # at 11 m the bump exceeds the road
TUNING = {
    "scenario": {**SCENARIO, "lqr": {"weights": [2, 1, 1]}},
    "strategy": "lqr",
    "objectives": [{"kind": "paper", "q": [1, 2, 1]}, {"kind": "figure", "figure": "bump.front_tyre_load.peak"}],
    "limits": [{"figure": "comfort.actuator_peak_power", "at_most": 12000}],
    "seeds": [1],
    "fresh_seeds": [11, 12],
    "trials": 4,
    "population": 2,
}
KEY = {"Idempotency-Key": "tuning-of-monday_50%"}
CUT_SHORT = "SELECT count(*) FROM batches WHERE state = 'running' AND done > 0"


@cache
def content() -> dict[str, Any]:
    """The fixture: `revision` of the database's schema, `tables` with their rows, `answers` by path."""
    read: dict[str, Any] = json.loads(gzip.decompress(Path(__file__).with_name("release_0_2_0.json.gz").read_bytes()))
    return read


def restore(store: Store) -> None:
    """Put every row into an empty database, at the revision it had."""
    tables, metadata = content()["tables"], MetaData()
    store.migrate(content()["revision"])
    with store.writing() as connection:
        metadata.reflect(connection)
        for table in metadata.sorted_tables:
            if rows := tables.get(table.name):
                types = {column.name: column.type for column in table.c}
                values = [{name: _from_json(types[name], value) for name, value in row.items()} for row in rows]
                connection.execute(table.insert(), values)


def dump(connection: Connection) -> dict[str, list[dict[str, Any]]]:
    """Every row by table, with values that JSON has; bytes are in base64, and times in UTC."""
    metadata = MetaData()
    metadata.reflect(connection)
    return {
        table.name: [
            {name: _to_json(value) for name, value in row.items()}
            for row in connection.execute(select(table)).mappings()
        ]
        for table in metadata.sorted_tables
    }


def bytes_of(text: str) -> bytes:
    """What the fixture writes in base64."""
    return base64.b64decode(text)


def _to_json(value: Any) -> Any:
    if isinstance(value, datetime):
        return (value.astimezone(UTC) if value.tzinfo else value).replace(tzinfo=None).isoformat()
    return base64.b64encode(value).decode() if isinstance(value, bytes) else value


def _from_json(kind: TypeEngine[Any], value: Any) -> Any:
    if isinstance(kind, DateTime) and value is not None:
        return datetime.fromisoformat(value).replace(tzinfo=UTC)
    return bytes_of(value) if isinstance(kind, LargeBinary) else value


def make(checkout: Path, folder: Path) -> dict[str, Any]:
    """Have that version's service fill a database in the folder, and kill it in the middle of its work."""
    (folder / "sitecustomize.py").write_text('import sys\nsys.modules["ziglang"] = None\n')  # no compiler: lv_hil fails
    process = subprocess.Popen(
        [sys.executable, "-m", "backend", "--port", "0", "--data-dir", str(folder)],
        env={"PATH": "", "PYTHONPATH": f"{folder}:{checkout}", "RIDELAB_ECU_DIR": str(folder / "ecu")},
        cwd=folder,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    database = create_engine(make_url(f"sqlite:///{folder}/ridelab.sqlite"))
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        with httpx.Client(base_url=f"{address}/api/v1", timeout=90) as client:
            _wait(lambda: client.get(f"{address}/readyz").status_code == 200)
            answers = {path: _get(client, path) for path in _fill(client)}
            _begin(client)
            with database.connect() as connection:
                _wait(lambda: connection.execute(text(CUT_SHORT)).scalar() == 2, pause=0)
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    with database.connect() as connection:
        tables = dump(connection)
    return {"revision": tables.pop("alembic_version")[0]["version_num"], "answers": answers, "tables": tables}


def _fill(client: httpx.Client) -> list[str]:
    """Make what is finished; the paths of all that a later version has to answer alike."""
    paths = []
    for strategies in (["lv", "lqr", "passive"], ["passive", "lv_hil"]):
        run = _post(client, "/runs", {"scenario": SCENARIO, "strategies": strategies})
        link = _post(client, "/links", {"run_id": run["id"], "view": {**VIEW, "strategies": strategies}})
        paths += [f"/runs/{run['id']}", f"/links/{link['slug']}"]
    batch = _post(
        client, "/batches", {"scenario": SCENARIO, "strategies": ["lqr", "passive"], "sweep": SWEEP}, headers=KEY
    )
    link = _post(client, "/links", {"batch_id": batch["id"], "view": {"x": "road.bump.height"}})
    tuning = _post(client, "/tunings", TUNING, headers=KEY)
    for path in (f"/batches/{batch['id']}", f"/tunings/{tuning['id']}"):
        _wait(lambda path=path: _get(client, path)["state"] == "done")  # type: ignore[misc]  # a default binds it
        paths += [path, f"{path}/events"]
    below = (f"/batches/{batch['id']}/results", f"/batches/{batch['id']}/summary", f"/tunings/{tuning['id']}/trials")
    return [*paths, f"/links/{link['slug']}", *below]


def _begin(client: httpx.Client) -> None:
    """Begin what is not to be finished: a tuning, and in its second generation a batch."""
    request = {**TUNING, "strategy": "lv", "seeds": [1, 2], "trials": 24, "population": 10}
    tuning = _post(client, "/tunings", request)
    _wait(lambda: _get(client, f"/tunings/{tuning['id']}")["generation"] == 1, pause=0)
    sweep = {"grid": {"road.seed": list(range(100, 124))}}
    _post(client, "/batches", {"scenario": SCENARIO, "strategies": ["lv"], "sweep": sweep})


def _post(client: httpx.Client, path: str, body: Any, headers: dict[str, str] | None = None) -> dict[str, Any]:
    made: dict[str, Any] = client.post(path, json=body, headers=headers).raise_for_status().json()
    return made


def _get(client: httpx.Client, path: str) -> Any:
    answer = client.get(path).raise_for_status()
    return answer.text if path.endswith("/events") else answer.json()


def _wait(until: Callable[[], bool], pause: float = 0.05) -> None:
    end = time.monotonic() + 60
    while not until():
        assert time.monotonic() < end
        time.sleep(pause)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as new:
        made = make(Path(sys.argv[1]).resolve(), Path(new))
    written = json.dumps(made, separators=(",", ":"))
    sys.stdout.buffer.write(gzip.compress(written.encode(), 9, mtime=0))
