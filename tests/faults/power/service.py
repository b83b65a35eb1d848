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
from tests.servers.api import Api, ask
from tests.servers.process import wait_until

PROGRESS = {"state", "position", "done", "failed", "core_version", "started_at", "finished_at"}
ROAD = {"length": 60, "bump": {"start": 40}}


@contextmanager
def started(folder: Path, **environment: str) -> Iterator[Api]:
    """A service with one process of each kind, ready."""
    api = Api(folder, RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1", **environment)
    try:
        api.wait_until_ready()
        yield api
    finally:
        api.end()


def record(folder: Path, *, seed: int, pieces: int) -> list[Record]:
    """What a service writes while a client works; after each answer a note of what to ask for it, and of the answer."""
    log, rng, runs = folder / "log", np.random.default_rng(seed), list[str]()
    with log.open("ab", buffering=0) as notes, started(folder, **recording(log, folder / "data")) as api:
        for number in range(pieces):
            kind = str(rng.choice(["runs", "runs", "links", "roads", "batches"])) if runs else "runs"
            scenario = {"road": ROAD | {"seed": 100 * seed + number}}
            options: dict[str, Any] = {"json": {"scenario": scenario, "strategies": ["lqr", "passive"]}}
            if kind == "links":
                options = {"json": {"run_id": str(rng.choice(runs)), "view": {}}}
            elif kind == "roads":
                heights = "".join(f"{0.1 * at:.1f},{height:.2f}\n" for at, height in enumerate(rng.normal(0, 9, 900)))
                options = {"content": f"distance [m],height [mm]\n{heights}", "headers": {"Content-Type": "text/csv"}}
            elif kind == "batches":
                options["json"]["sweep"] = {"grid": {"road.bump.height": rng.uniform(0.05, 0.1, 8).tolist()}}
            answer = ask(api.url, "POST", f"/{kind}", **options)
            path = f"/{kind}/{answer['slug' if kind == 'links' else 'id']}"
            runs += [answer["id"]] if kind == "runs" else []
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
        for path, answer in acknowledged.items():
            if path.startswith("/batches"):
                wait_until(partial(_is_done, api, path), "the batch ends")
            if (now := _lasting(ask(api.url, "GET", path))) != answer:
                yield f"{path} was {answer} and is {now}"
        if "damaged" in api.log:
            yield api.log[-2000:]


def _is_done(api: Api, path: str) -> bool:
    return bool(ask(api.url, "GET", path)["state"] == "done")


def _lasting(answer: dict[str, Any]) -> dict[str, Any]:
    """What of an answer stays as it is, also while its batch is computed."""
    return {key: value for key, value in answer.items() if key not in PROGRESS}
