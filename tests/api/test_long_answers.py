"""Answers too long for memory: the same bytes from a file, which goes when they were read or nobody reads them."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.http import spool
from backend.runs import bands
from sim_core.scenario import Scenario
from tests.servers.batches import computed
from tests.servers.process import HANG_TIMEOUT, wait_until


@pytest.fixture(autouse=True)
def folder(service: Any) -> Iterator[Path]:
    """Where the files are; none is left after a test."""
    folder: Path = service.services.settings.data_dir / "spool"
    empty(service, folder)  # other tests' bands may be cached
    yield folder
    empty(service, folder)


def empty(service: Any, folder: Path) -> None:
    """Forget cached bands; no other file may stay."""

    async def forget() -> None:
        service.services.curves.histories._bands.clear()

    service.inside(forget())
    wait_until(lambda: not files(folder), "every file is gone")


def files(folder: Path) -> list[Path]:
    return list(folder.glob("*"))


def both(client: httpx.Client, monkeypatch: pytest.MonkeyPatch, path: str, **query: Any) -> list[httpx.Response]:
    """The answer from memory, and from a file."""
    answers = []
    for short in (spool.MAX_IN_MEMORY, 0):
        monkeypatch.setattr(spool, "MAX_IN_MEMORY", short)
        answers.append(client.get(f"/api/v1{path}", params=query, headers={"Accept-Encoding": "identity"}))
    monkeypatch.undo()
    return answers


@pytest.mark.parametrize("query", [{"format": "csv"}, {"encoding": "base64"}, {"points": 500}])
def test_time_histories_are_the_same(
    client: httpx.Client, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch, query: dict[str, Any]
) -> None:
    path = f"/runs/{run['id']}/series"
    for strategies in ("lv", "passive,lv"):
        short, long = both(client, monkeypatch, path, strategy=strategies, **query)
        assert short.status_code == long.status_code == 200
        assert short.content == long.content
        changing = {"x-request-id", "date", "etag"}  # of a long answer nobody knows a digest before it is sent
        assert {key: short.headers[key] for key in short.headers if key not in changing} == {
            key: long.headers[key] for key in long.headers if key not in changing
        }


def test_a_long_one_is_compressed_and_asked_for_by_its_head(
    client: httpx.Client, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    path, query = f"/api/v1/runs/{run['id']}/series", {"strategy": "lv", "format": "csv"}
    plain = client.get(path, params=query)
    monkeypatch.setattr(spool, "MAX_IN_MEMORY", 0)
    with client.stream("GET", path, params=query, headers={"Accept-Encoding": "gzip"}) as compressed:
        assert compressed.headers["content-encoding"] == "gzip"
        assert len(b"".join(compressed.iter_raw())) < len(plain.content) / 2
    head = client.head(path, params=query, headers={"Accept-Encoding": "identity"})
    assert (head.status_code, head.content) == (200, b"")
    assert int(head.headers["content-length"]) == len(plain.content)


def test_tables_and_bands_are_the_same(client: httpx.Client, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    scenario, sweep = {"road": {"length": 131.7}}, {"grid": {"road.bump.height": [0.05, 0.06]}}
    batch = computed(client, scenario=scenario, strategies=["passive"], sweep=sweep)["id"]
    body = {"scenario": scenario, "strategies": ["passive"], "roads": 2}
    run = client.post("/api/v1/runs", json=body).json()["id"]
    table = both(client, monkeypatch, f"/batches/{batch}/table", figures="travel_time")
    assert json.loads(table[1].content)["columns"]["run"] == [0, 1]
    for short, long in (table, both(client, monkeypatch, f"/runs/{run}/bands", points=100)):
        assert short.status_code == long.status_code == 200
        assert short.content == long.content
    wait_until(lambda: len(files(folder)) == 1, "the answer's file is gone, and the band's is cached")


def test_no_room_is_said(client: httpx.Client, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spool, "MAX_IN_MEMORY", 0)
    monkeypatch.setattr(spool, "LEAST_FREE", 1 << 60)
    full = client.get(f"/api/v1/runs/{run['id']}/series", params={"strategy": "lv", "format": "csv"})
    assert (full.status_code, full.json()["type"].rpartition(":")[2]) == (503, "full")
    assert int(full.headers["retry-after"]) > 0


def test_space_is_reserved_before_anything_is_computed(
    service: Any, worker_calls: list[tuple[Any, ...]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(spool, "MAX_IN_MEMORY", 0)
    scenario = {"road": {"length": 131.9}}
    run = service.run(["passive"], scenario, roads=2).json()
    batch = computed(service, scenario=scenario, strategies=["passive"], sweep={"list": [{"road.seed": 1}]})["id"]
    files = service.services.curves.histories.spool
    worker_calls.clear()
    with monkeypatch.context() as limited:
        size = bands.Band.most_nbytes(Scenario.model_validate(run["scenario"]), "passive")
        limited.setattr(files, "_longest", 1.1 * size)  # the band's own file fits
        refused = service.get(f"/api/v1/runs/{run['id']}/bands")
        assert (refused.status_code, refused.json()["type"].rpartition(":")[2]) == (422, "cost-limit")
        assert "fewer" in refused.json()["detail"]
    with monkeypatch.context() as limited:
        limited.setattr(files._space, "total", 10.0)
        limited.setattr(files, "_longest", 1e9)
        assert service.get(f"/api/v1/batches/{batch}/table?figures=travel_time").status_code == 429
    assert not worker_calls


def test_who_hangs_up_keeps_no_file(service: Any, folder: Path) -> None:
    scenario = {"road": {"length": 1000}, "speed": {"initial_speed_kmh": 10, "target_speed_kmh": 10}}
    run = service.run(["passive"], scenario).json()["id"]
    with service.begun("GET", f"/api/v1/runs/{run}/series?format=csv") as connection:
        connection.settimeout(HANG_TIMEOUT)
        assert connection.recv(12) == b"HTTP/1.1 200"
        assert len(files(folder)) == 1
        connection.close()
        wait_until(lambda: not files(folder), "its file is gone")
