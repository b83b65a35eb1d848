"""Three times as much as the service can do, for a minute: it does nearly all it can, and the queue bounds the wait.

Shipped settings, twenty addresses, each request a road nobody drove before. Every bound is a ratio to one of the same
run, so that the machine does not matter, or far above what is measured. The load generator runs on the same cores: what
it takes of them is taken off the time, or it would count as the service's. DRILL_SECONDS= changes how long it takes.
"""

import asyncio
import itertools
import os
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import pytest

from backend.gate import SERVICE_QUEUES
from backend.settings import Settings
from tests.drill.callers import Caller, new_run, quantile, run_id
from tests.servers import loops
from tests.servers.process import Api

SECONDS = float(os.environ.get("DRILL_SECONDS", "60"))
WARM_UP = 5.0  # [s]
CAPACITY = 15.0  # as long is the capacity measured [s]
ADDRESSES = [f"127.0.0.{number}" for number in range(2, 22)]
POLL_INTERVAL = 0.1  # of what is stored, and of health [s]


@dataclass
class Answers:
    """The answers, and how long each took [s]."""

    good: list[float] = field(default_factory=list)
    refused: list[float] = field(default_factory=list)
    runs: list[str] = field(default_factory=list)  # that are stored
    health: list[float] = field(default_factory=list)
    stored: list[float] = field(default_factory=list)
    waits: set[int] = field(default_factory=set)  # Retry-After of refusals [s]
    seconds: float = 0.0  # from the first request to the last answer
    generator: float = 0.0  # CPU time of this process meanwhile [s]

    @contextmanager
    def timed(self) -> Iterator[None]:
        """Measure both times."""
        begin, computing = time.monotonic(), time.process_time()
        yield
        self.seconds, self.generator = time.monotonic() - begin, time.process_time() - computing

    @property
    def rate(self) -> float:
        """Runs a second."""
        return len(self.good) / self.seconds

    @property
    def rate_without_generator(self) -> float:
        """Runs a second of the time that the generator left of all cores."""
        return len(self.good) / (self.seconds - self.generator / (os.cpu_count() or 1))


async def ask(caller: Caller, answers: Answers) -> None:
    """Ask for a new run."""
    begin = time.monotonic()
    status, headers, answer = await caller.call("POST", "/api/v1/runs", new_run())
    took = time.monotonic() - begin
    if status == 200:
        answers.good.append(took)
        answers.runs.append(run_id(answer))
    else:
        assert status in (429, 503), status
        answers.refused.append(took)
        answers.waits.add(int(headers["retry-after"]))


async def poll(caller: Caller, paths: Iterator[str], into: list[float], end: float) -> None:
    while time.monotonic() < end:
        begin = time.monotonic()
        assert (await caller.call("GET", next(paths)))[0] == 200
        into.append(time.monotonic() - begin)
        await asyncio.sleep(POLL_INTERVAL)


async def closed_loop(callers: list[Caller], connections: int, seconds: float) -> Answers:
    """So many who each ask again when they are answered: what came back."""
    answers, begin = Answers(), time.monotonic()

    async def one(caller: Caller) -> None:
        while time.monotonic() < begin + seconds:
            await ask(caller, answers)

    with answers.timed():
        await asyncio.gather(*(one(caller) for caller in callers[:connections]))
    return answers


async def open_loop(callers: list[Caller], rate: float, stored: list[str]) -> Answers:
    """So many a second [1/s], whatever becomes of those before: what came back."""
    answers, begin = Answers(), time.monotonic()
    onlookers = [Caller(callers[0].port, f"127.0.0.{number}") for number in (30, 31)]
    health, paths = itertools.repeat("/healthz"), itertools.cycle([f"/api/v1/runs/{each}" for each in stored])
    with answers.timed():
        async with asyncio.TaskGroup() as group:
            group.create_task(poll(onlookers[0], health, answers.health, begin + SECONDS))
            group.create_task(poll(onlookers[1], paths, answers.stored, begin + SECONDS))
            for number in range(int(rate * SECONDS)):
                await asyncio.sleep(max(0.0, begin + number / rate - time.monotonic()))
                group.create_task(ask(callers[number % len(callers)], answers))
    await asyncio.gather(*(caller.close() for caller in onlookers))
    return answers


def summary(answers: Answers, calm: Answers) -> str:
    """One paragraph of figures."""
    good, stored, health = answers.good, answers.stored, answers.health
    return (
        f"capacity {calm.rate:.1f}/s, offered {3 * calm.rate:.1f}/s: done {answers.rate:.1f}/s "
        f"({answers.rate / calm.rate:.0%}; {share_done(answers, calm):.0%} without what the generator took), "
        f"answered after {quantile(good, 0.5):.0f} ms, p99 {quantile(good, 0.99):.0f}, max {1000 * max(good):.0f};\n"
        f"  refused {len(answers.refused)} after {quantile(answers.refused, 0.5):.0f} ms, p99 "
        f"{quantile(answers.refused, 0.99):.0f}, Retry-After {sorted(answers.waits)};\n"
        f"  stored GET {quantile(stored, 0.5):.0f} ms, p99 {quantile(stored, 0.99):.0f}; health "
        f"{quantile(health, 0.5):.0f} ms, p99 {quantile(health, 0.99):.0f}"
    )


def share_done(answers: Answers, calm: Answers) -> float:
    """The share of the capacity that is done, without the load generator's part of the machine."""
    return answers.rate_without_generator / calm.rate_without_generator


async def overload(port: int) -> None:
    callers = [Caller(port, address) for address in ADDRESSES]
    try:
        await closed_loop(callers, 4, WARM_UP)
        calm = await closed_loop(callers, 4, CAPACITY)
        answers = await open_loop(callers, 3 * calm.rate, calm.runs)
        print(f"\n{summary(answers, calm)}")
        if answers.refused:
            assert statistics.median(answers.refused) < statistics.median(answers.good) / 2, "it comes sooner"
        longest = Settings().max_client_requests * SERVICE_QUEUES / calm.rate  # that the whole queue takes [s]
        assert quantile(answers.good, 0.99) < 2000 * longest
        assert statistics.median(answers.stored) < statistics.median(answers.good) / 2
        assert quantile(answers.health, 0.99) < 2000
        assert share_done(answers, calm) >= 0.8
    finally:
        await asyncio.gather(*(caller.close() for caller in callers))


@pytest.mark.timeout(120 + 2 * SECONDS)
def test_goodput_is_held_under_three_times_the_capacity(api: Api) -> None:
    loops.run(lambda: overload(api.port))
