"""Results: equal computations are joined, the last request that goes away calls one off, memory is bounded."""

import asyncio
from collections.abc import Mapping
from contextlib import nullcontext
from operator import attrgetter
from typing import Any, cast

import numpy as np
from cachetools import LRUCache

from backend.outcome import Outcome, Sampling
from backend.runs.results import Results
from sim_core import Scenario
from tests.servers import loops

LIVE = Sampling(800)


def outcome(key: str, sampling: Sampling | None = None, samples: int = 100) -> Outcome:
    series = None if sampling is None else np.zeros((15, samples), dtype=np.float32)
    return Outcome(key=key, strategy="lv", status="ok", json=b"{}", compute_ms=1.0, sampling=sampling, series=series)


class Workers:
    """Stands for the processes: a task ends when it is told to."""

    count = 2

    def __init__(self) -> None:
        self.begun: list[list[str]] = []
        self.called_off: list[list[str]] = []
        self.go = asyncio.Event()

    async def call(
        self, _: object, __: object, keys: Mapping[str, str], sampling: Sampling | None, **___: object
    ) -> dict[str, Outcome]:
        self.begun.append(sorted(keys))
        try:
            await self.go.wait()
        except asyncio.CancelledError:
            self.called_off.append(sorted(keys))
            raise
        return {name: outcome(key, sampling) for name, key in keys.items()}


class Nothing:
    """Stands for the store, which has no result, and for a gate that is open."""

    runs = cast(Any, type("Runs", (), {"load_results": None}))

    async def read(self, *_: object) -> dict[str, Outcome]:
        return {}

    def computing(self, *_: object) -> Any:
        return nullcontext()


def results(workers: Any = None, limit: int = 10**6) -> Results:
    none: Any = Nothing()
    memory = LRUCache[str, Outcome](limit, getsizeof=attrgetter("size"))
    return Results(store=none, workers=workers, gate=none, roads=none, recordings=none, memory=memory)


def test_equal_computations_are_joined_and_the_last_request_that_goes_calls_one_off() -> None:
    async def use() -> None:
        workers = Workers()
        finder = results(workers)

        def ask(*names: str, sampling: Sampling | None = None) -> asyncio.Task[Any]:
            return asyncio.create_task(finder.get([Scenario()], names, "me", sampling=sampling))

        async def settle() -> None:
            for _ in range(10):
                await asyncio.sleep(0)

        with_series = ask("lv", sampling=LIVE)
        await settle()
        without = ask("lv", "passive")
        await settle()
        assert workers.begun == [["lv"], ["passive"]], "who wants no series takes those that come with some"
        others = ask("lv", sampling=Sampling(50))
        await settle()
        assert workers.begun[2:] == [["lv"]], "other samples are another computation"
        others.cancel()
        with_series.cancel()
        await settle()
        assert workers.called_off == [["lv"]], "somebody else waits for the first one"
        workers.go.set()
        (answer,) = await without
        assert {name: each.cached for name, each in answer.items()} == {"lv": True, "passive": False}
        assert not finder._in_progress
        (again,) = await ask("lv", sampling=LIVE)
        assert again["lv"].cached
        assert len(workers.begun) == 3, "it is in memory"

    loops.run(use)


def test_no_request_takes_every_worker_for_all_its_roads() -> None:
    async def use() -> None:
        workers = Workers()
        roads = [Scenario.model_validate({"road": {"seed": seed}}) for seed in range(5)]
        asked = asyncio.create_task(results(workers).get(roads, ["lv", "passive"], "me"))
        for _ in range(10):
            await asyncio.sleep(0)
        assert workers.begun == [["lv", "passive"]] * workers.count
        workers.go.set()
        assert len(await asked) == len(roads)

    loops.run(use)


def test_memory_answers_only_for_the_points_it_has() -> None:
    finder = results()
    finder.remember(outcome("a", LIVE))
    assert finder.cached("a", Sampling(2000)) is None
    assert finder.cached("a", None) is not None, "without series any will do"
    finder.remember(outcome("a", Sampling(2000)))
    assert finder.cached("a", LIVE) is None
    assert finder.cached("a", Sampling(2000)) is not None
    finder.remember(outcome("a"))
    assert finder.cached("a", Sampling(2000)) is not None, "one without series does not drive out one with"
    finder.remember(outcome("large", LIVE, samples=10**5))
    assert finder.cached("large", LIVE) is None
