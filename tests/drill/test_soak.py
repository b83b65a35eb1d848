"""DRILL_SECONDS (three hours) of mixed work by DRILL_SEED: the service's memory, open files and threads stay flat.

The memory for results holds some thirty, so that it is full at once.
"""

import os
import time
from collections import Counter
from pathlib import Path

import numpy as np
import psutil
import pytest

from tests.servers.process import Api, ask, request

SECONDS = float(os.environ.get("DRILL_SECONDS", "10800"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
INTERVAL = 2.0  # between two samples [s]
CACHE = {"RIDELAB_SERIES_CACHE_BYTES": "100000"}
KINDS = ("run", "run", "stored", "series", "link", "batch", "list", "page")
# By unit what the mean of the last quarter may be above that of the second one, as a share and besides.
GROWTH = {"MB in the service": (0.1, 5.0), "MB in all its processes": (0.1, 20.0), "files": (0, 8), "threads": (0, 4)}


def sample(api: Api) -> list[float]:
    """Return what the service takes, in the order of GROWTH."""
    service = psutil.Process(api.pid)
    own = service.memory_info().rss / 1e6
    children = sum(child.memory_info().rss / 1e6 for child in api.children() if child.is_running())
    return [own, own + children, service.num_fds(), service.num_threads()]


def work(url: str, rng: np.random.Generator, runs: list[str]) -> str:
    """Ask for something, new or stored; returns what kind of thing it was."""
    kind, some = (str(rng.choice(KINDS)), str(rng.choice(runs))) if runs else ("run", "")
    road = {"length": 60, "bump": {"start": 40}, "seed": int(rng.integers(10**6))}
    body = {"scenario": {"road": road}, "strategies": ["lv", "lqr", "passive"]}
    paths = {
        "stored": f"/api/v1/runs/{some}",
        "series": f"/api/v1/runs/{some}/series?strategy=lqr&format=csv",
        "list": "/api/v1/batches?limit=50",
        "page": "/",
    }
    if kind == "run":
        runs.append(ask(url, "POST", "/runs", json=body)["id"])
    elif kind == "link":
        slug = ask(url, "POST", "/links", json={"run_id": some, "view": {}})["slug"]
        ask(url, "GET", f"/links/{slug}")
    elif kind == "batch":
        sweep = {"grid": {"road.bump.height": rng.uniform(0.05, 0.1, 20).tolist()}}
        batch = ask(url, "POST", "/batches", json=body | {"sweep": sweep})["id"]
        request("GET", f"{url}/api/v1/batches/{batch}/events").raise_for_status()  # a stream that ends with it
    else:
        request("GET", url + paths[kind]).raise_for_status()
    return kind


@pytest.mark.timeout(300 + 2 * SECONDS)
def test_memory_files_and_threads_stay_flat(tmp_path: Path) -> None:
    done, samples, begin = Counter[str](), list[list[float]](), time.monotonic()
    rng, runs = np.random.default_rng(SEED), list[str]()
    with Api(tmp_path, **CACHE) as api:
        api.wait_until_ready()
        while (now := time.monotonic() - begin) < SECONDS:
            done[work(api.url, rng, runs)] += 1
            if now >= INTERVAL * len(samples):
                samples.append(sample(api))
    print(f"\n{SECONDS:.0f} s, seed {SEED}: {done.total()} requests, {dict(done)}")
    quarters = [each.mean(axis=0) for each in np.array_split(np.array(samples), 4)]
    grown = []
    for (unit, (share, besides)), second, last in zip(GROWTH.items(), quarters[1], quarters[3], strict=True):
        print(f"{unit}: {second:.1f} in the second quarter, {last:.1f} in the last one")
        grown += [unit] * bool(last > second * (1 + share) + besides)
    assert not grown
