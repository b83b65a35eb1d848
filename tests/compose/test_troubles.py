"""Batches lose nothing while containers are killed, hang, lose their power, are away or have too little memory."""

import contextlib
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import pytest

from tests.compose.engine import Composed, docker, inspect, volumes, wait

RUNS = 1200  # of a batch
QUICK = 6.0  # a 503 takes at most so long while the database is stopped [s]


@dataclass
class Watch:
    """Asks for a new run as a person's page does, twice a second."""

    service: Composed
    statuses: list[int] = field(default_factory=list)
    ended: threading.Event = field(default_factory=threading.Event)

    def go(self) -> None:
        while not self.ended.wait(0.5):
            body = {"scenario": {"road": {"seed": time.time_ns() % 10**6}}, "strategies": ["passive"]}
            self.statuses.append(self.service.attempt("POST", "/api/v1/runs", body))


@contextlib.contextmanager
def watched(service: Composed) -> Iterator[Watch]:
    watch = Watch(service)
    thread = threading.Thread(target=watch.go)
    thread.start()
    try:
        yield watch
    finally:
        watch.ended.set()
        thread.join()


def under_way(service: Composed) -> str:
    """Submit a batch; return it once some of its runs are done."""
    batch = service.batch(RUNS)
    wait(lambda: service.progress(batch)["done"] > 0, "the batch begins", 120, 0.05)
    return batch


@pytest.mark.parametrize("part", ["leader", "worker", "scheduler", "database", "proxy"])
def test_one_that_is_killed_comes_back_and_the_batch_goes_on(service: Composed, part: str) -> None:
    batch = under_way(service)
    name = service.one_of(part)
    with watched(service) as watch:
        killed = inspect(name)["State"]["Pid"]
        service.kill(name)
        wait(lambda: inspect(name)["State"]["Pid"] not in (0, killed), "it is started again", 60)
        took = wait(service.healthy, "all are healthy", 180)
        service.assert_complete(batch, RUNS)
    refused = [status for status in watch.statuses if status != 200]
    print(f"{part} killed: all healthy {took:.1f} s later; {len(refused)} of {len(watch.statuses)} new runs refused")
    assert set(refused) <= ({503, 502, 0} if part in ("database", "proxy") else set())


@pytest.mark.parametrize(("part", "seconds"), [("leader", 0.0), ("worker", 5.0), ("scheduler", 8.0), ("database", 8.0)])
def test_one_that_hangs_stops_nothing_for_long(service: Composed, part: str, seconds: float) -> None:
    batch = under_way(service)
    name = service.one_of(part)
    docker("pause", name)
    try:
        if part == "leader":
            took = wait(lambda: service.leader() not in (None, name), "another one leads", 60)
            print(f"leader hangs: another one leads after {took:.1f} s")
            service.assert_complete(batch, RUNS)
        else:
            time.sleep(seconds)  # how long it hangs
    finally:
        docker("unpause", name)
    print(f"{part} hung: all healthy {wait(service.healthy, 'all are healthy', 120):.1f} s later")
    service.assert_complete(batch, RUNS)


def test_after_a_power_cut_in_the_worst_order(service: Composed) -> None:
    batch = under_way(service)
    names = [each for part in ("proxy", "worker", "api", "scheduler", "database") for each in service.containers(part)]
    docker("kill", *names)
    for name in names:
        docker("start", name)
    print(f"power cut: all healthy {wait(service.healthy, 'all are healthy', 240):.1f} s after the last start")
    service.assert_complete(batch, RUNS)


def test_while_the_database_is_away_answers_are_quick_and_a_stop_is_clean(service: Composed) -> None:
    service.up()
    service.compose("stop", "database")

    def ask(_: int) -> tuple[int, float]:
        begun = time.monotonic()
        return service.attempt("GET", "/api/v1/batches"), time.monotonic() - begun

    with ThreadPoolExecutor(40) as clients:
        answers = list(clients.map(ask, range(40)))
        took = max(seconds for _, seconds in answers)
        last = [clients.submit(service.request, "GET", "/api/v1/batches") for _ in range(20)]
        service.compose("stop", "api")
    print(f"database away: each of 40 answers within {took:.1f} s")
    assert {status for status, _ in answers} == {503}
    assert took < QUICK
    for each in last:
        answer = each.result()
        assert (answer.status_code, answer.headers["content-type"]) == (503, "application/problem+json"), answer.text
    service.compose("stop", "--timeout", "15")
    assert {name: inspect(name)["State"]["ExitCode"] for name in service.containers()} == dict.fromkeys(
        service.containers(), 0
    )
    print(f"healthy again in {service.up():.1f} s")


@pytest.mark.parametrize("memory", ["250m", "64m"])
def test_a_worker_with_too_little_memory_is_the_batchs_reason(service: Composed, memory: str) -> None:
    service.up()
    service.compose("up", "--detach", WORKER_MEMORY=memory)
    batch = service.batch(50)
    took = wait(lambda: "WORKER_MEMORY" in (service.progress(batch)["reason"] or ""), "it says why", 60)
    print(f"{memory} for the worker: after {took:.0f} s “{service.progress(batch)['reason']}”")
    service.up()
    service.assert_complete(batch, 50)
    assert service.progress(batch)["reason"] is None


def test_more_of_them_and_none_down_and_up_again(service: Composed) -> None:
    """And nothing is left but the volumes that are named."""
    service.up("--scale", "api=3", "--scale", "worker=2")
    service.assert_complete(under_way(service), RUNS)
    digest = "select count(*), md5(string_agg(key || checksum, ',' order by key)) from results"
    stored = service.sql(digest)
    before = volumes()
    service.compose("down")
    assert volumes() == before
    service.up()
    assert service.sql(digest) == stored
    service.compose("down", "--volumes")
    assert before - volumes() == {"ridelab-drill_database", "ridelab-drill_spool"}
