"""DRILL_SECONDS (three hours) of mixed work by DRILL_SEED: the service's memory, open files and threads stay flat.

Its later growth is told by the slope of a line through the samples after the first quarter, in which it warms up. The
memory for results holds some thirty, so that it is full at once: each result takes 3 kB until it is.
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
ROAD = {"length": 60, "bump": {"start": 40}}
# By unit what the mean of the last quarter may be above that of the second one, as a share and besides.
CACHE = {"RIDELAB_SERIES_CACHE_BYTES": "100000"}
GROWTH = {"MB in the service": (0.1, 5.0), "MB in all its processes": (0.1, 20.0), "files": (0, 8), "threads": (0, 4)}


def sample(api: Api) -> list[float]:
    """In the order of GROWTH."""
    service, children = psutil.Process(api.pid), list[float]()
    for child in api.children():
        try:
            children.append(child.memory_info().rss / 1e6)
        except psutil.NoSuchProcess:
            continue
    own = service.memory_info().rss / 1e6
    return [own, own + sum(children), service.num_fds(), service.num_threads()]


class Client:
    """Asks for all kinds of things, new ones and such as are stored.

    Attributes:
        done: How often each.
    """

    def __init__(self, api: Api) -> None:
        self.done: Counter[str] = Counter()
        self._url, self._rng, self._runs = api.url, np.random.default_rng(SEED), list[str]()

    def do(self) -> None:
        """The next thing."""
        kinds = ("run", "run", "stored", "series", "link", "batch", "list", "page", "refused")
        kind = str(self._rng.choice(kinds)) if self._runs else "run"
        self.done[kind] += 1
        road = ROAD | {"seed": int(self._rng.integers(10**6))}
        body = {"scenario": {"road": road}, "strategies": ["lv", "lqr", "passive"]}
        some = str(self._rng.choice(self._runs)) if self._runs else ""
        if kind == "run":
            self._runs = [*self._runs[-500:], ask(self._url, "POST", "/runs", json=body)["id"]]
        elif kind == "stored":
            ask(self._url, "GET", f"/runs/{some}")
        elif kind == "series":
            self._get(f"/api/v1/runs/{some}/series?strategy=lqr&format=csv", 200)
        elif kind == "link":
            slug = ask(self._url, "POST", "/links", json={"run_id": some, "view": {}})["slug"]
            ask(self._url, "GET", f"/links/{slug}")
        elif kind == "batch":
            sweep = {"grid": {"road.bump.height": self._rng.uniform(0.05, 0.1, 20).tolist()}}
            batch = ask(self._url, "POST", "/batches", json=body | {"sweep": sweep})["id"]
            self._get(f"/api/v1/batches/{batch}/events", 200)  # a stream that ends with it
            self._get(f"/api/v1/batches/{batch}/results?format=csv", 200)
        elif kind == "list":
            ask(self._url, "GET", "/batches?limit=50")
        elif kind == "page":
            self._get("/", 200)
        else:
            self._get("/api/v1/runs/nobody-has-this", 404)

    def _get(self, path: str, expected: int) -> None:
        assert request("GET", self._url + path).status_code == expected, path


@pytest.mark.timeout(300 + 2 * SECONDS)
def test_memory_files_and_threads_stay_flat(folder: Path) -> None:
    with Api(folder, **CACHE) as api:
        api.wait_until_ready()
        client, samples, begin = Client(api), list[list[float]](), time.monotonic()
        while (now := time.monotonic() - begin) < SECONDS:
            client.do()
            if now >= INTERVAL * len(samples):
                samples.append([now, *sample(api)])
    table = np.array(samples)
    quarters = [each.mean(axis=0) for each in np.array_split(table, 4)]
    print(f"\n{SECONDS:.0f} s, seed {SEED}: {client.done.total()} requests, {dict(client.done)}")
    grown = []
    for column, (unit, (share, besides)) in enumerate(GROWTH.items(), 1):
        later = table[len(table) // 4 :]
        slope = 3600 * np.polyfit(later[:, 0], later[:, column], 1)[0]
        second, last = quarters[1][column], quarters[3][column]
        print(f"{unit}: {second:.1f} in the second quarter, {last:.1f} in the last one, {slope:+.1f} an hour")
        if last > second * (1 + share) + besides:
            grown.append(unit)
    assert not grown
