"""The crash drill: DRILL_KILLS kills (50) of each topology at random, the choices by DRILL_SEED (1).

Kill -9, and of the cluster's programs pauses (SIGSTOP) and a network that is silent between replicas and database, of
up to DRILL_PAUSE seconds (120), while batches run; afterwards everything accepted is complete, each result stored once.
By hand:
DRILL_KILLS=200 python -m pytest tests/drill/test_crashes.py -s
"""

import contextlib
import os
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import psutil
import pytest
from sqlalchemy import func, select

from backend.db.tables import results
from tests.servers.accepted import Accepted
from tests.servers.compose import Topology
from tests.servers.forwarder import DIRECTIONS, Direction, Forwarder
from tests.servers.postgres import Postgres
from tests.servers.process import FORK_SERVER, Api, Program, wait_until

KILLS = int(os.environ.get("DRILL_KILLS", "50"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
RUNS = 480  # of one batch: a second or two of two cores
LEAST_WORK = 400  # runs that wait while it kills
LIFE = 4.0  # of a service that is killed again and again [s]
LIVES = 4  # times the runs of another batch
LONGEST_PAUSE = float(os.environ.get("DRILL_PAUSE", "120"))  # [s]
WHILE_WORKING = 0.7  # of the kills come while results come in, the others at any moment, such as during a start

Victim = Callable[[], str | None]  # kills something and tells what, or tells that there is nothing to kill


def drill(accepted: Accepted, victims: Sequence[Victim], chance: random.Random) -> None:
    """Kill at random moments, in rounds that shuffle the victims; then wait for everything."""
    killed: Counter[str] = Counter()
    next_victims: list[Victim] = []
    while killed.total() < KILLS:
        if accepted.waiting() < LEAST_WORK:
            accepted.submit()
        if chance.random() < WHILE_WORKING:
            accepted.await_work()
        time.sleep(chance.uniform(0.01, 1.5))  # the moment of the kill is what chance is for
        next_victims = next_victims or chance.sample(victims, len(victims))
        what = next_victims.pop()()
        if what is None:
            continue
        killed[what] += 1
        accepted.check_stored()
        print(f"{killed.total():3} of {KILLS}: killed {what}, {len(accepted.stored)} results stored")
    accepted.finish()
    with accepted.engine.connect() as connection:
        stored = connection.execute(select(func.count()).select_from(results)).scalar_one()
    assert stored == len(accepted.batches) * RUNS, "a result of every run, and none besides"
    print(f"killed {dict(killed)}; {len(accepted.batches)} batches, {stored} results")


def kill_program(program: Program) -> Victim:
    """The program itself, what it started left to notice."""

    def kill() -> str | None:
        if not program.running:
            return None
        program.kill()
        return program.name

    return kill


def kill_worker(program: Program, chance: random.Random) -> Victim:
    """One of the processes that compute for it."""

    def kill() -> str | None:
        workers = []
        for child in program.children():
            try:
                if FORK_SERVER in " ".join(child.cmdline()):  # what forks them too
                    workers.append(child)
            except psutil.NoSuchProcess:
                continue
        if not workers:
            return None
        try:
            chance.choice(workers).kill()
        except psutil.NoSuchProcess:
            return None
        return f"a process of {program.name}"

    return kill


def pause(program: Program, chance: random.Random) -> Victim:
    """Stop the program (SIGSTOP), and wake it into a world that has moved on."""

    def stop() -> str | None:
        if not program.running:
            return None
        pid = program.pid
        os.kill(pid, signal.SIGSTOP)
        seconds = chance.uniform(1, LONGEST_PAUSE)

        def wake() -> None:
            with contextlib.suppress(ProcessLookupError):  # it was killed meanwhile
                os.kill(pid, signal.SIGCONT)

        threading.Timer(seconds, wake).start()
        return f"{program.name} by a pause"

    return stop


def silence(forwarder: Forwarder, direction: Direction, chance: random.Random) -> Victim:
    """Have the database's connections swallow what is sent in that direction, for a while."""

    def swallow() -> str:
        seconds = chance.uniform(1, LONGEST_PAUSE)

        def cut() -> None:
            with forwarder.blocked(direction):
                time.sleep(seconds)

        threading.Thread(target=cut, daemon=True).start()
        return f"the network, {direction}"

    return swallow


def kill_everything(topology: Topology, postgres: Postgres) -> Victim:
    """Whatever is started again by itself, and the database with it, which is started again here."""

    def kill() -> str:
        for program in (*topology.replicas, *topology.workers, topology.scheduler):
            program.kill()
        postgres.kill()
        postgres.start()
        return "everything at once"

    return kill


@pytest.mark.timeout(60 * KILLS + 300)
def test_one_machine(tmp_path: Path) -> None:
    """One service with an embedded cluster on SQLite: the service and its processes are killed."""
    database = f"sqlite:///{tmp_path}/data/ridelab.sqlite"
    chance = random.Random(SEED)  # noqa: S311 - reproducible is what it has to be
    with Api(tmp_path, RIDELAB_LOG_LEVEL="warning") as api:
        api.wait_until_ready()
        victims = [kill_program(api), kill_worker(api, chance), kill_worker(api, chance)]
        drill(Accepted(url=api.url, database=database, seed=SEED, runs=RUNS), victims, chance)


@pytest.mark.timeout(600)
def test_a_service_that_never_lives_long_gets_on(tmp_path: Path) -> None:
    """Killed every four seconds, starts included, until a batch is complete: each few lives add to it.

    Where other programs keep the machine busy a life is longer: half as long again as it takes to the first results.
    """
    database = f"sqlite:///{tmp_path}/data/ridelab.sqlite"
    with Api(tmp_path, RIDELAB_LOG_LEVEL="warning") as api:
        accepted = Accepted(url=api.url, database=database, seed=SEED, runs=LIVES * RUNS)
        left = list[int]()
        accepted.submit()
        kill_and_wait_for_start(api)
        begin = time.monotonic()
        accepted.await_work()
        life = max(LIFE, 1.5 * (time.monotonic() - begin))
        while not left or left[-1]:
            kill_and_wait_for_start(api)
            time.sleep(life)  # whatever it does meanwhile
            left.append(accepted.waiting())
            assert len(left) < 10 * LIVES, f"it does not get on: {left}"
        print(f"\nkilled {len(left) + 1} times, every {life:.1f} s; runs left each time: {left}")
        accepted.finish()


def kill_and_wait_for_start(api: Api) -> None:
    api.kill()
    wait_until(lambda: api.running, "it is started again", pause=0.01)


@pytest.mark.timeout(180 * KILLS + 300)
def test_a_cluster(tmp_path: Path, postgres: Postgres) -> None:
    """Two replicas on PostgreSQL, a Dask scheduler and two workers: any of them, any process of theirs, all at once."""
    few: dict[str, Any] = {"API_WORKERS": "1", "WORKER_CORES": "1", "RIDELAB_LOG_LEVEL": "warning"}
    chance = random.Random(SEED)  # noqa: S311 - reproducible is what it has to be
    with (
        contextlib.closing(Forwarder(postgres.port)) as forwarder,
        Topology(tmp_path, postgres, port=forwarder.port, **few) as topology,
    ):
        topology.wait_until_ready()
        parts = [topology.scheduler, *topology.workers, *topology.replicas]
        victims = [kill_program(part) for part in parts]
        victims += [kill_worker(worker, chance) for worker in topology.workers]
        victims += [pause(part, chance) for part in (*parts, topology.proxy)]
        victims += [silence(forwarder, direction, chance) for direction in DIRECTIONS]
        victims.append(kill_everything(topology, postgres))
        accepted = Accepted(url=topology.url, database=topology.database, seed=SEED, runs=RUNS)
        drill(accepted, victims, chance)
