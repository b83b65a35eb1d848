"""A service under a client's work, recorded; and what it still answers where the power was cut meanwhile."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from tests.faults.power.disk import NOTE, Disk, Record, note, read, recording
from tests.servers.process import Api, ask, wait_until

PROGRESS = {"state", "position", "done", "failed", "core_version", "started_at", "finished_at"}
ROAD = {"length": 60, "bump": {"start": 40}}


class Unsynced(Api):
    """A service whose database syncs nothing: the fault that power cuts have to show."""

    PROGRAM = (
        "-c",
        "import inspect, sys; from backend.db import sqlite; from backend.__main__ import main; "
        "exec(inspect.getsource(sqlite._set_up).replace('=EXTRA', '=OFF'), vars(sqlite)); sys.exit(main())",
    )


@contextmanager
def started(folder: Path, kind: type[Api] = Api, **environment: str) -> Iterator[Api]:
    """A service with one process of each kind: ready, or one that has ended or says that its database is damaged."""
    with kind(folder, RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1", **environment) as api:
        wait_until(lambda: api.ready or api.starts > 1 or "damaged" in api.log, "it is ready")
        yield api


def record(folder: Path, *, seed: int, pieces: int, kind: type[Api] = Api) -> list[Record]:
    """What a service writes while a client works; after each answer a note of what to ask for it, and of the answer."""
    log, rng, runs = folder / "log", np.random.default_rng(seed), list[str]()
    with log.open("ab", buffering=0) as notes, started(folder, kind, **recording(log, folder / "data")) as api:
        for number in range(pieces):
            what = str(rng.choice(["runs", "runs", "links", "roads", "batches"])) if runs else "runs"
            scenario = {"road": ROAD | {"seed": 100 * seed + number}}
            options: dict[str, Any] = {"json": {"scenario": scenario, "strategies": ["lqr", "passive"]}}
            if what == "links":
                options = {"json": {"run_id": str(rng.choice(runs)), "view": {}}}
            elif what == "roads":
                heights = "".join(f"{0.1 * at:.1f},{height:.2f}\n" for at, height in enumerate(rng.normal(0, 9, 900)))
                options = {"content": f"distance [m],height [mm]\n{heights}", "headers": {"Content-Type": "text/csv"}}
            elif what == "batches":
                options["json"]["sweep"] = {"grid": {"road.bump.height": rng.uniform(0.05, 0.1, 8).tolist()}}
            answer = ask(api.url, "POST", f"/{what}", **options)
            path = f"/{what}/{answer['slug' if what == 'links' else 'id']}"
            runs += [answer["id"]] if what == "runs" else []
            note(notes, json.dumps([path, _lasting(ask(api.url, "GET", path))]))
    return list(read(log))


def cut(records: list[Record], folder: Path, *, seed: int, count: int) -> tuple[list[str], int]:
    """Cut the power so many times at random calls: what a service started afterwards does not answer as before.

    Args:
        records: Of `record`.
        folder: Whose calls they are.
        seed: Chooses the calls, and what becomes of unsynced writes.
        count: How many times.

    Returns:
        What broke the promise, and how many acknowledged answers were asked for again.
    """
    rng, disk, broken, asked = np.random.default_rng(seed), Disk(folder), list[str](), 0
    first = next(at for at, each in enumerate(records) if each.kind == NOTE)
    moments = set(rng.choice(np.arange(first, len(records)), count, replace=False).tolist())
    acknowledged: dict[str, Any] = {}
    for at, each in enumerate(records):
        if each.kind == NOTE:
            path, answer = json.loads(each.data)
            acknowledged[path] = answer
        else:
            disk.apply(each)
        if at in moments:
            with TemporaryDirectory() as left:
                (Path(left) / "data").mkdir()
                fate = disk.cut(Path(left) / "data", rng)
                broken += [f"after call {at}, unsynced: {fate}: {fault}" for fault in _faults(Path(left), acknowledged)]
                asked += len(acknowledged)
    return broken, asked


def _faults(folder: Path, acknowledged: dict[str, Any]) -> Iterator[str]:
    with started(folder) as api:
        for path, answer in acknowledged.items() if api.ready else ():
            try:
                if path.startswith("/batches"):
                    wait_until(partial(_is_done, api, path), "the batch ends")
                now = _lasting(ask(api.url, "GET", path))
            except AssertionError as error:  # the answer's status
                yield f"{path}: {error}"
                continue
            if now != answer:
                yield f"{path} was {answer} and is {now}"
        if not api.ready or "damaged" in api.log:
            yield api.log[-2000:]


def _is_done(api: Api, path: str) -> bool:
    return bool(ask(api.url, "GET", path)["state"] == "done")


def _lasting(answer: dict[str, Any]) -> dict[str, Any]:
    """What of an answer stays as it is, also while its batch is computed."""
    return {key: value for key, value in answer.items() if key not in PROGRESS}
