"""A service killed, then ended in order, in the middle of everything: what was answered stays, the rest goes on.

That a tuning of an earlier release goes on is shown in tests/faults/test_release.py. `make drill` kills often and at
random, on one machine and in a cluster.
"""

import contextlib
import socket
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from tests.api import tuning
from tests.servers.accepted import Accepted
from tests.servers.process import HANG_TIMEOUT, Api, ask, request, wait_until

RUNS = 60  # of each batch: some seconds of one core, so that it is under way when the service ends
SHORT = {"road": {"length": 131.7}}
# Some minutes of a core: an end that waited for it would be taken for one that hangs.
ENDLESS = {
    "road": {"length": 1500.3, "bump": {"start": 30}},
    "mpc": {"solver": "osqp", "force_limit": 500, "prediction_horizon": 100, "control_horizon": 80},
}

TUNING = {**tuning.REQUEST, "strategy": "lv", "trials": 96}  # in twelve generations


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    limits = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1", "RIDELAB_MAX_REQUEST_COST": "1000"}
    limits["RIDELAB_RUN_TIMEOUT"] = "3600"
    with Api(tmp_path, **limits) as api:
        api.wait_until_ready()
        yield api


@pytest.fixture
def accepted(api: Api, tmp_path: Path) -> Accepted:
    return Accepted(url=api.url, database=f"sqlite:///{tmp_path}/data/ridelab.sqlite", seed=7, runs=RUNS)


def test_what_was_accepted_outlives_a_kill_and_an_ordered_end(api: Api, accepted: Accepted) -> None:
    runs = {"scenario": SHORT, "strategies": ["lv", "passive"]}
    run = ask(api.url, "POST", "/runs", json=runs)
    series = series_of(api, run)
    slug = ask(api.url, "POST", "/links", json={"run_id": run["id"], "view": {"zoom": [1, 2]}})["slug"]
    accepted.submit()
    accepted.await_work()

    family, starts = api.children(), api.starts
    api.kill()
    assert accepted.waiting() > 0, "the test needs a longer batch"
    await_start(api, family, starts)

    accepted.check_stored()
    accepted.await_work()
    end_in_order(api)
    accepted.finish()

    assert all(entry["cached"] for entry in ask(api.url, "POST", "/runs", json=runs)["strategies"].values())
    link = ask(api.url, "GET", f"/links/{slug}")
    assert (link["series_pinned"], link["view"]) == (True, {"zoom": [1, 2]})
    assert link["run"]["strategies"]["lv"]["metrics"] == run["strategies"]["lv"]["metrics"]
    assert series_of(api, run) == series


@pytest.mark.thorough
def test_a_tuning_has_the_same_trials_after_a_kill_and_an_ordered_end(api: Api) -> None:
    interrupted = ask(api.url, "POST", "/tunings", json=TUNING)["id"]
    with httpx.Client(base_url=api.url, timeout=HANG_TIMEOUT) as client:
        tuning.wait_for(client, interrupted, generation=1)
        family, starts = api.children(), api.starts
        api.kill()
        await_start(api, family, starts)
        assert tuning.wait_for(client, interrupted, generation=4)["generation"] < 10, "the test needs more trials"
        end_in_order(api)
        ended = tuning.wait_for(client, interrupted)
        whole = tuning.wait_for(client, ask(api.url, "POST", "/tunings", json=TUNING)["id"])
        assert (ended["state"], ended["trials"]["done"]) == ("done", 96)
        assert tuning.trials(client, interrupted) == tuning.trials(client, whole["id"])
        assert (ended["history"], ended["comparison"]["points"]) == (whole["history"], whole["comparison"]["points"])


def await_start(api: Api, family: list[psutil.Process], starts: int) -> None:
    """Until an ended service has left no process of its family, and is there again after so many starts."""
    assert not psutil.wait_procs(family, timeout=HANG_TIMEOUT)[1], "its processes end by themselves"
    wait_until(lambda: api.starts > starts, "it is started again")
    api.wait_until_ready()


def end_in_order(api: Api) -> None:
    """It waits neither for a computation nor for a client that never sends the rest of its request."""
    threading.Thread(target=ask_for_ever, args=(api.url,), daemon=True).start()
    wait_until(lambda: "ridelab_open_requests 1.0" in request("GET", f"{api.url}/metrics").text, "it is there")
    family, starts = api.children(), api.starts
    with socket.create_connection(("127.0.0.1", api.port)) as connection:
        connection.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n\r\n{")
        api.terminate()
    await_start(api, family, starts)


def ask_for_ever(url: str) -> None:
    with contextlib.suppress(httpx.TransportError):  # the service ends before it answers
        request("POST", f"{url}/api/v1/runs", json={"scenario": ENDLESS, "strategies": ["lv"]}, timeout=3600)


def series_of(api: Api, run: dict[str, Any]) -> bytes:
    query = f"{api.url}/api/v1/runs/{run['id']}/series?strategy=lv,passive&encoding=base64"
    return request("GET", query).raise_for_status().content
