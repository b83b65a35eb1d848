"""A service killed, then ended in order, in the middle of everything: what was answered stays, the rest goes on.

`make drill` kills often and at random, on one machine and in a cluster.
"""

import contextlib
import socket
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import httpx
import psutil
import pytest

from backend.jobs.cluster import NICE
from tests.servers.accepted import Accepted, database
from tests.servers.api import Api, ask
from tests.servers.process import request, wait_until

RUNS = 400  # of each batch: some seconds of one core, so that it is under way when the service ends
SHORT = {"road": {"length": 131.7}}
# Far longer than the ten seconds in which an ordered end has to be through.
ENDLESS = {
    "road": {"length": 1500.3, "bump": {"start": 30}},
    "mpc": {"solver": "osqp", "force_limit": 500},
}
TUNING = {
    "scenario": {"road": {"length": 63, "bump": {"start": 45}}, "speed": {"detection_distance": 40}},
    "strategy": "lqr",
    "objectives": [{"kind": "peaks"}, {"kind": "figure", "figure": "rough_road.front_tyre_load.rms"}],
    "seeds": [1, 2],
    "fresh_seeds": [11, 12],
    "trials": 40,
    "population": 8,
}


@dataclass(frozen=True)
class Lives:
    """What a service said before it was killed, what was seen of its ends, and the service as it came back.

    Attributes:
        api: In its third life.
        accepted: Its batches.
        run: The answer to a run.
        series: That run's time histories.
        slug: Of a link to it.
        tuning: One that had begun.
        orphans: What outlived the kill.
        code: The exit code of the ordered end.
        seconds: How long that took [s].
        left: What outlived the ordered end.
    """

    api: Api
    accepted: Accepted
    run: dict[str, Any]
    series: bytes
    slug: str
    tuning: str
    orphans: list[psutil.Process]
    code: int
    seconds: float
    left: list[psutil.Process]


@pytest.fixture(scope="module")
def lives(tmp_path_factory: pytest.TempPathFactory, built: str) -> Iterator[Lives]:
    folder = tmp_path_factory.mktemp("lives")
    environment = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1", "RIDELAB_MAX_REQUEST_COST": "1000"}
    api = Api(folder, **environment, RIDELAB_FRONTEND_DIR=built)
    engine = database(f"sqlite:///{folder}/data/ridelab.sqlite")
    try:
        api.wait_until_ready()
        run = ask(api.url, "POST", "/runs", json={"scenario": SHORT, "strategies": ["lv", "passive"]})
        series = series_of(api, run)
        tuning = ask(api.url, "POST", "/tunings", json=TUNING)["id"]
        wait_until(lambda: tuning_of(api, tuning)["generation"] >= 2, "the tuning begins")
        accepted = Accepted(url=api.url, engine=engine, seed=7, runs=RUNS)
        accepted.submit()
        accepted.await_work()
        next(process for process in api.children() if process.nice() == NICE).kill()
        accepted.await_work()
        link = {"run_id": run["id"], "view": {"zoom": [1, 2], "baseline": "passive"}}
        slug = ask(api.url, "POST", "/links", json=link)["slug"]
        orphans = killed(api, accepted)

        accepted.submit()
        accepted.await_work()
        code, seconds, left = ended(api, accepted)
        api.wait_until_ready()
        yield Lives(
            api=api,
            accepted=accepted,
            run=run,
            series=series,
            slug=slug,
            tuning=tuning,
            orphans=orphans,
            code=code,
            seconds=seconds,
            left=left,
        )
    finally:
        engine.dispose()
        api.end()


def killed(api: Api, accepted: Accepted) -> list[psutil.Process]:
    """Kill it; what of it does not end by itself, though it could tell them nothing. Returns when it is back."""
    family, starts = api.children(), api.starts
    api.kill()
    assert accepted.waiting() > 0, "the test needs a longer batch"
    accepted.check_stored()
    _, alive = psutil.wait_procs(family, timeout=10)
    wait_until(lambda: api.starts > starts, "it is started again")
    api.wait_until_ready()
    return alive


def ended(api: Api, accepted: Accepted) -> tuple[int, float, list[psutil.Process]]:
    """End it in order while it computes for somebody, and while a client never sends the rest of its request."""
    threading.Thread(target=ask_for_ever, args=(api.url,), daemon=True).start()
    wait_until(lambda: open_requests(api) > 0, "the request is there")
    family, starts = api.children(), api.starts
    with socket.create_connection(("127.0.0.1", api.port)) as connection:
        connection.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\n{")
        begin = time.monotonic()
        code = api.terminate()
        seconds = time.monotonic() - begin
    assert accepted.waiting() > 0, "the test needs a longer batch"
    accepted.check_stored()
    _, alive = psutil.wait_procs(family, timeout=5)
    wait_until(lambda: api.starts > starts, "it is started again")
    return code, seconds, alive


def ask_for_ever(url: str) -> None:
    with contextlib.suppress(httpx.TransportError):  # the service ends before it answers
        request("POST", f"{url}/api/v1/runs", json={"scenario": ENDLESS, "strategies": ["lv"]}, timeout=90)


def open_requests(api: Api) -> float:
    name = "ridelab_open_requests "
    (line,) = [line for line in request("GET", f"{api.url}/metrics").text.splitlines() if line.startswith(name)]
    return float(line.removeprefix(name))


def series_of(api: Api, run: dict[str, Any]) -> bytes:
    query = f"{api.url}/api/v1/runs/{run['id']}/series?strategy=lv,passive&encoding=base64"
    return request("GET", query).raise_for_status().content


def tuning_of(api: Api, tuning_id: str) -> dict[str, Any]:
    tuning: dict[str, Any] = ask(api.url, "GET", f"/tunings/{tuning_id}")
    return tuning


def finished_tuning(api: Api, tuning_id: str) -> tuple[dict[str, Any], list[Any]]:
    """A tuning once it has ended, and its trials."""
    wait_until(lambda: tuning_of(api, tuning_id)["state"] not in ("queued", "running"), "the tuning ends", 120)
    return tuning_of(api, tuning_id), ask(api.url, "GET", f"/tunings/{tuning_id}/trials")["trials"]


def test_an_answered_run_and_its_link_are_there(lives: Lives) -> None:
    stored = ask(lives.api.url, "GET", f"/runs/{lives.run['id']}")
    for name, entry in stored["strategies"].items():
        assert {**entry, "cached": False} == lives.run["strategies"][name]
    repeated = ask(lives.api.url, "POST", "/runs", json={"scenario": SHORT, "strategies": ["lv", "passive"]})
    assert all(entry["cached"] for entry in repeated["strategies"].values())
    link = ask(lives.api.url, "GET", f"/links/{lives.slug}")
    assert link["series_pinned"] is True
    assert link["view"] == {"zoom": [1, 2], "baseline": "passive"}
    assert link["run"]["strategies"]["lv"]["metrics"] == lives.run["strategies"]["lv"]["metrics"]
    assert series_of(lives.api, lives.run) == lives.series
    assert "LV control against passive" in request("GET", f"{lives.api.url}/s/{lives.slug}").text


def test_processes_end_with_a_service_that_was_killed(lives: Lives) -> None:
    assert not lives.orphans


def test_an_ordered_end_comes_within_ten_seconds_and_leaves_nothing(lives: Lives) -> None:
    assert lives.seconds < 10
    assert not lives.left


def test_batches_complete_and_each_result_was_stored_once(lives: Lives) -> None:
    lives.accepted.finish()


def test_a_tuning_goes_on_to_the_trials_it_would_have_had(lives: Lives) -> None:
    ended, trials = finished_tuning(lives.api, lives.tuning)
    assert (ended["state"], ended["trials"]["done"], ended["generation"]) == ("done", 40, 5)
    whole = finished_tuning(lives.api, ask(lives.api.url, "POST", "/tunings", json=TUNING)["id"])
    assert trials == whole[1]
    assert [each["number"] for each in trials] == list(range(40))
    assert ended["history"] == whole[0]["history"]
    assert ended["comparison"]["points"] == whole[0]["comparison"]["points"]
