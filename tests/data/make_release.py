"""Make a database as this version leaves it when it is killed: release_0_4_0.json.gz, made once by 899e0802.

    .venv/bin/python -m tests.data.make_release [DATABASE_URL] > tests/data/release_0_4_0.json.gz

It needs Linux and root: a folder that is mounted `noexec` makes the failure that is the machine's fault.
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
from contextlib import closing, contextmanager
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import numpy as np
from sqlalchemy import text

from backend.fmu.archive import fmu
from backend.store import Store
from sim_core import Scenario, simulate
from sim_core.catalogue import SIGNALS
from tests.data.release import dump

TOKEN = "fixture-of-0.4.0-ann"  # noqa: S105 - of a service that lives for seconds
SCENARIO: dict[str, Any] = {
    "road": {"length": 12, "seed": 9, "bump": {"height": 0.08, "width": 2, "start": 5}},
    "speed": {"initial_speed_kmh": 60, "target_speed_kmh": 50, "detection_distance": 5},
}
ESTIMATED = {**SCENARIO, "estimation": {"kind": "kalman"}}
VIEW = {"hidden": [], "baseline": "passive", "axis": "time", "zoom": [0.25, 0.75], "cursor": 0.5}
SWEEP = {"grid": {"road.bump.height": [0.05, 0.08], "road.bump.start": [5, 11]}}  # at 11 m the bump exceeds the road
STUDY = {"list": [{"mismatch.body_mass": 0.8 + 0.1 * n, "mismatch.damping": 1.2 - 0.1 * n} for n in range(4)]}
SPEEDS = {"grid": {"speed.target_speed_kmh": [45, 50]}}
GAINS = [1.0, 0.0, 2.0]
REQUIREMENTS = [{"metric": "bump.body_acceleration.peak", "max": 30.0}]
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
LAWS = '''"""Laws of one's own."""
from sim_core import Controller, option


class Mine(Controller):
    """Damps the body."""

    id, label = "mine", "Mine"
    damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per velocity.")

    def force(self, seen):
        return -self.damping * seen.state[4], -self.damping * seen.state[4]


class Ahead(Controller):
    """Pushes against the road ahead; its preview is set as a plain attribute."""

    id, label = "ahead", "Ahead"
    preview = "lookahead"
    prediction_horizon = 20

    def force(self, seen):
        return -20_000 * seen.preview[10, 0], -20_000 * seen.preview[10, 1]


class Wrong(Controller):
    """Gives no number."""

    id, label = "wrong", "Wrong"

    def force(self, seen):
        return float("nan"), 0.0
'''
RUNNING = "SELECT count(*) FROM jobs WHERE state = 'running' AND done > 0 AND parent_id IS NULL"


def make(folder: Path, url: str) -> dict[str, Any]:
    """Have the service fill the database, and kill it in the middle of its work."""
    files = _files(folder)
    with _service(folder, url) as client:
        expiring = _expiring(client)
        expired = {path: _get(client, path) for path in expiring}
    with closing(Store(url)) as store:
        store.retention.remove_results(datetime.now(UTC) + timedelta(days=1))
    with _service(folder, url) as client:
        faults = {path: _get(client, path) for path in _machine_faults(client)}
        answers = {path: _get(client, path) for path in _fill(client)}
        stale = {path: _get(client, path) for path in _stale(client)}
        _begin(client)
        with closing(Store(url)) as store:
            _wait(lambda: _running(store) == 3, pause=0)
    with closing(Store(url)) as store, store.reading() as connection:
        tables = dump(connection)
    return {
        "revision": tables.pop("alembic_version")[0]["version_num"],
        "answers": answers,
        "expired": expired,
        "stale": stale,
        "machine_faults": faults,
        "files": files,
        "tables": tables,
    }


def _running(store: Store) -> Any:
    with store.reading() as connection:
        return connection.execute(text(RUNNING)).scalar()


def _files(folder: Path) -> dict[str, str]:
    """Write the controller files; their contents in base64."""
    laws = folder / "laws"
    laws.mkdir()
    (laws / "laws.py").write_text(LAWS)
    (laws / "theirs.fmu").write_bytes(fmu(Scenario.model_validate(SCENARIO), "lqr", "controller", "2.0", ["linux64"]))
    return {each.name: base64.b64encode(each.read_bytes()).decode() for each in laws.iterdir() if each.is_file()}


@contextmanager
def _service(folder: Path, url: str) -> Any:
    """A service whose temporary folder is mounted noexec; killed at the end."""
    (folder / "tokens").write_text(f"ann {TOKEN}\n")
    temporary = folder / "noexec"
    temporary.mkdir(exist_ok=True)
    mounting = f"mount -t tmpfs -o noexec tmpfs {temporary} && exec {sys.executable} -m backend --port 0"
    process = subprocess.Popen(
        ["unshare", "--mount", "sh", "-c", f"{mounting} --data-dir {folder}"],
        env={
            **os.environ,
            "TMPDIR": str(temporary),
            "RIDELAB_DATABASE_URL": url,
            "RIDELAB_CONTROLLERS": str(folder / "laws"),
            "RIDELAB_TOKENS_FILE": str(folder / "tokens"),
            "RIDELAB_WORKERS": "1",
            "RIDELAB_BATCH_WORKERS": "1",
        },
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        headers = {"Authorization": f"Bearer {TOKEN}"}
        with httpx.Client(base_url=f"{address}/api/v1", headers=headers, timeout=300) as client:
            _wait(lambda: client.get(f"{address}/readyz").status_code == 200)
            yield client
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _run(client: httpx.Client, strategies: list[str], scenario: dict[str, Any], **more: Any) -> str:
    return str(_post(client, "/runs", {"scenario": scenario, "strategies": strategies, **more})["id"])


def _expiring(client: httpx.Client) -> list[str]:
    """Runs whose results retention removes."""
    ours = _run(client, ["passive", "lv"], _changed(SCENARIO, 21))
    mine = _run(client, ["mine"], _changed(SCENARIO, 22))
    roads = _run(client, ["passive", "lqr"], _changed(SCENARIO, 23), roads=2)
    return [f"/runs/{each}" for each in (ours, mine, roads)]


def _machine_faults(client: httpx.Client) -> list[str]:
    """What failed because of the machine: the library of an FMU may not be executed where it lies."""
    run = _run(client, ["passive", "theirs"], SCENARIO)
    roads = _run(client, ["passive", "theirs"], SCENARIO, roads=2)
    link = _post(client, "/links", {"run_id": run, "view": {"strategies": ["passive", "theirs"]}})
    batch = _done(client, "batches", scenario=SCENARIO, strategies=["theirs"], sweep={"grid": {"road.seed": [9, 10]}})
    return [f"/runs/{run}", f"/runs/{roads}", f"/links/{link['slug']}", f"{batch}/results"]


def _stale(client: httpx.Client) -> list[str]:
    """Results that have the gain of another run: what a plain attribute makes a controller read is in no key."""
    scenarios = [{**SCENARIO, "mismatch": {"preview_gain": gain}} for gain in GAINS]
    runs = [_run(client, ["passive", "ahead"], scenario) for scenario in scenarios]
    sweep = {"grid": {"mismatch.preview_gain": GAINS}}
    batch = _done(client, "batches", scenario=SCENARIO, strategies=["ahead"], sweep=sweep)
    link = _post(client, "/links", {"run_id": runs[1], "view": {"strategies": ["ahead"]}})
    return [*(f"/runs/{each}" for each in runs), f"{batch}/results", f"/links/{link['slug']}"]


def _fill(client: httpx.Client) -> list[str]:
    """Make what is finished; the paths of all that a later version has to answer alike."""
    x = np.arange(0, 31, 0.1)
    heights = 40 * np.where((x > 8) & (x < 11), (1 - np.cos(2 * np.pi * (x - 8) / 3)) / 2, 0) + 2 * np.sin(x)
    profile = "".join(f"{at:.1f},{height:.2f}\n" for at, height in zip(x, heights, strict=True))
    road = _sent(client, "/roads", f"distance [m],height [mm]\n{profile}")
    measured = {**SCENARIO, "road": {"profile": road, "length": 20, "bump": {"height": 0, "start": 8, "width": 3}}}
    drive = _sent(client, "/recordings", _drive(0))
    elsewhere = _sent(client, "/recordings", _drive(500))
    paths, runs = [f"/roads/{road}?points=50", f"/recordings/{drive}"], []
    for strategies, scenario, more in (
        (["lv", "passive"], SCENARIO, {}),
        (["lv"], ESTIMATED, {}),
        (["passive", "lv_hil"], SCENARIO, {}),
        (["lv"], measured, {}),
        (["passive", "lqr"], _changed(SCENARIO, 31), {"roads": 3}),
        (["passive", f"recording:{drive}"], SCENARIO, {}),
        (["passive", f"recording:{elsewhere}", "wrong"], SCENARIO, {}),  # of which the last fails
        (["passive", "theirs"], {**SCENARIO, "mpc": {"sample_time": 0.005}}, {}),  # it is for control steps of 0.01 s
        (["passive", "mine"], {**SCENARIO, "own": {"mine": {"damping": 1500}}}, {"requirements": REQUIREMENTS}),
    ):
        runs.append(_run(client, strategies, scenario, **more))
        link = _post(client, "/links", {"run_id": runs[-1], "view": {**VIEW, "strategies": strategies}})
        paths += [f"/runs/{runs[-1]}", f"/links/{link['slug']}"]
    view = {"pins": [{"name": "estimated", "run": runs[1]}], "reference": runs[1]}
    link = _post(client, "/links", {"run_id": runs[0], "view": view, "requirements": REQUIREMENTS})
    paths += [f"/links/{link['slug']}", f"/runs/{runs[4]}/changes?baseline=passive"]
    on_road = _done(client, "batches", scenario=measured, strategies=["passive"], sweep=SPEEDS)
    return [*paths, on_road, f"{on_road}/results", *_jobs(client)]


def _jobs(client: httpx.Client) -> list[str]:
    sweep = _done(client, "batches", KEY, scenario=SCENARIO, strategies=["lqr", "passive"], sweep=SWEEP)
    study = _done(client, "batches", scenario=SCENARIO, strategies=["lqr", "mine"], sweep=STUDY)
    tuning = _done(client, "tunings", KEY, **TUNING)
    client.patch(sweep, json={"label": "winter"}).raise_for_status()
    link = _post(client, "/links", {"batch_id": sweep.rpartition("/")[2], "view": {"x": "road.bump.height"}})
    paths = [path for job in (sweep, study, tuning) for path in (job, f"{job}/events")]
    below = [f"{job}/{name}" for job in (sweep, study) for name in ("results", "summary")]
    return [*paths, *below, f"{tuning}/trials", f"/links/{link['slug']}"]


def _drive(start: float) -> str:
    """A passive car's drive as a file whose distance begins there [m]."""
    series = simulate(Scenario.model_validate(SCENARIO), "passive").series
    keys = ("position", "body_acceleration", "front_deflection")
    columns = [series[key][::2] + (start if key == "position" else 0) for key in keys]
    head = ",".join(f"{'distance' if key == 'position' else key} [{SIGNALS[key].unit}]" for key in keys)
    return "\n".join([head, *(",".join(f"{value:.5g}" for value in row) for row in zip(*columns, strict=True)), ""])


def _begin(client: httpx.Client) -> None:
    """Begin what is not to be finished: a tuning, in its second generation rows of the paper, and a batch."""
    request = {**TUNING, "strategy": "lv", "seeds": [1, 2], "trials": 40, "population": 10}
    tuning = _post(client, "/tunings", request)
    _wait(lambda: _get(client, f"/tunings/{tuning['id']}")["generation"] == 1, pause=0)
    client.get("/paper?seeds=20&first_seed=500&partial=true").raise_for_status()
    sweep = {"grid": {"road.seed": list(range(100, 148))}}
    _post(client, "/batches", {"scenario": SCENARIO, "strategies": ["lv"], "sweep": sweep})


def _changed(scenario: dict[str, Any], seed: int) -> dict[str, Any]:
    return {**scenario, "road": {**scenario["road"], "seed": seed}}


def _done(client: httpx.Client, kind: str, headers: dict[str, str] | None = None, **request: Any) -> str:
    path = f"/{kind}/{_post(client, f'/{kind}', request, headers=headers)['id']}"
    _wait(lambda: _get(client, path)["state"] == "done")
    return path


def _sent(client: httpx.Client, path: str, content: str) -> str:
    sent = client.post(path, content=content, headers={"Content-Type": "text/csv"})
    return str(sent.raise_for_status().json()["id"])


def _post(client: httpx.Client, path: str, body: Any, headers: dict[str, str] | None = None) -> dict[str, Any]:
    answer = client.post(path, json=body, headers=headers)
    assert answer.is_success, answer.text
    made: dict[str, Any] = answer.json()
    return made


def _get(client: httpx.Client, path: str) -> Any:
    answer = client.get(path)
    assert answer.is_success, answer.text
    return answer.text if path.endswith("/events") else answer.json()


def _wait(until: Callable[[], bool], pause: float = 0.05) -> None:
    end = time.monotonic() + 300
    while not until():
        assert time.monotonic() < end
        time.sleep(pause)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as new:
        chosen = sys.argv[1] if len(sys.argv) > 1 else f"sqlite:///{new}/ridelab.sqlite"
        made = make(Path(new), chosen)
    written = json.dumps(made, separators=(",", ":"))
    sys.stdout.buffer.write(gzip.compress(written.encode(), 9, mtime=0))
