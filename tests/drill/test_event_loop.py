"""Nothing that clients ask for holds the event loop longer than 20 ms: while it is held, nobody is answered.

The largest of everything, one after the other: 50 roads and nine strategies, a sweep of 10,000 runs with all that is
read of it, a tuning, a road of 2 km, links, the paper, the API's description. A probe measures each callback.
"""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim_core.strategies import STRATEGIES
from tests.drill.loop_probe import LIMIT
from tests.servers.process import HANG_TIMEOUT, Api, ask, request, wait_until

NINE = list(STRATEGIES)
ROAD = "distance [m],height [mm]\n" + "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000))


class ProbedApi(Api):
    PROGRAM = ("-m", "tests.drill.loop_probe")


@pytest.fixture(scope="module")
def lines(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("probe") / "lines"


@pytest.fixture(scope="module")
def api(lines: Path) -> Iterator[Api]:
    lines.touch()
    with ProbedApi(lines.parent, EVENT_LOOP_PROBE=str(lines)) as api:
        api.wait_until_ready()
        ask(api.url, "POST", "/runs", json={"scenario": {}, "strategies": ["lv"]})  # what a first request imports
        yield api


def get(api: Api, path: str, **parameters: object) -> None:
    """Read it to its end."""
    answer = request("GET", f"{api.url}/api/v1{path}", params=parameters)
    assert answer.is_success, f"{path}: {answer.status_code} {answer.text[:300]}"


def run(api: Api, scenario: dict[str, object], roads: int = 1) -> str:
    """The id of a run of all nine."""
    body = {"scenario": scenario, "strategies": NINE, "roads": roads}
    return str(ask(api.url, "POST", "/runs", json=body, timeout=HANG_TIMEOUT)["id"])


def runs(api: Api) -> None:
    once, often = run(api, {"road": {"length": 1000}}), run(api, {"road": {"seed": 7}}, roads=50)
    other = run(api, {"road": {"seed": 7, "bump": {"height": 0.08}}}, roads=50)
    for _ in range(2):  # the second time they are stored
        run(api, {"road": {"seed": 7}}, roads=50)
        get(api, f"/runs/{often}")
    get(api, f"/runs/{often}/changes", against=other)
    for name in NINE:
        get(api, f"/runs/{once}/series", strategy=name, format="csv")
        get(api, f"/runs/{once}/series", strategy=name)
    get(api, f"/runs/{once}/report.html", baseline="lv")
    live = {"scenario": {"road": {"length": 1000}}, "strategies": NINE}
    ask(api.url, "POST", "/live", json=live)
    link = ask(api.url, "POST", "/links", json={"run_id": once, "view": {}})
    get(api, f"/links/{link['slug']}")


def sweeps(api: Api) -> None:
    masses = {"ranges": {"vehicle.body_mass": [900, 1500]}, "samples": 5000}
    body = {"scenario": {}, "sweep": {"latin_hypercube": masses}, "strategies": ["passive", "lqr"]}
    batch = ask(api.url, "POST", "/batches", json=body)["id"]
    wait_until(lambda: ask(api.url, "GET", f"/batches/{batch}")["state"] == "done", "the sweep", pause=1.0)
    get(api, "/batches", limit=50)
    get(api, f"/batches/{batch}/events")
    get(api, f"/batches/{batch}/summary", baseline="passive")
    get(api, f"/batches/{batch}/table")
    for kind in ("csv", "json"):
        get(api, f"/batches/{batch}/results", format=kind)


def tunings(api: Api) -> None:
    body = {"scenario": {}, "strategy": "lqr", "trials": 48, "population": 24}
    tuning = ask(api.url, "POST", "/tunings", json=body)["id"]
    wait_until(lambda: ask(api.url, "GET", f"/tunings/{tuning}")["state"] == "done", "the tuning", pause=1.0)
    get(api, f"/tunings/{tuning}/trials")


def everything_else(api: Api) -> None:
    road = request("POST", f"{api.url}/api/v1/roads", content=ROAD, headers={"Content-Type": "text/csv"})
    assert road.is_success, road.text
    identifier = road.json()["id"]
    get(api, f"/roads/{identifier}")
    get(api, f"/roads/{identifier}", format="csv")
    nested = b'{"scenario": [' + b"[" * 1_000_000
    refused = request("POST", f"{api.url}/api/v1/runs", content=nested, headers={"Content-Type": "application/json"})
    assert refused.status_code == 413, refused.text
    for part in ("", "/readings", "/attribution", "/figures"):
        get(api, f"/paper{part}")
    request("GET", f"{api.url}/openapi.json").raise_for_status()


def test_nothing_takes_the_event_loop_for_long(api: Api, lines: Path) -> None:
    before = len(lines.read_text().splitlines())
    for part in (runs, sweeps, tunings, everything_else):
        part(api)
    found = [json.loads(line) for line in lines.read_text().splitlines()[before:]]
    for each in sorted(found, key=lambda each: -each["seconds"]):
        print(f"\n{1000 * each['seconds']:.0f} ms", *each["where"], sep="\n    ")
    assert not found, f"{len(found)} callbacks took more than {1000 * LIMIT:.0f} ms"
