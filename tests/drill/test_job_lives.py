"""Jobs of a cluster whose parts are killed, paused and cut off in any order; and a service that never lives long.

DRILL_LIVES (10) lives of DRILL_STEPS (30) steps; a part rests for up to DRILL_PAUSE seconds (120). Of one machine
tests/faults/test_job_lives.py has fifty lives.
"""

import contextlib
import os
import random
import time
from pathlib import Path
from typing import Any

import pytest

from tests.servers.accepted import Accepted
from tests.servers.compose import Topology
from tests.servers.forwarder import DIRECTIONS, Forwarder
from tests.servers.job_lives import Victim, killing, killing_a_worker, live, pausing, silencing
from tests.servers.postgres import Postgres
from tests.servers.process import Api, wait_until

LIVES = int(os.environ.get("DRILL_LIVES", "10"))
STEPS = int(os.environ.get("DRILL_STEPS", "30"))
LONGEST_PAUSE = float(os.environ.get("DRILL_PAUSE", "120"))  # [s]
LIFE = 4.0  # of a service that is killed again and again [s]
MOST_LIVES = 40
RUNS = 2000  # that such a service takes several lives for


def killing_everything(topology: Topology, postgres: Postgres) -> Victim:
    """Kill whatever is started again by itself, and the database with it, which is started again here."""

    def kill() -> None:
        for program in (*topology.replicas, *topology.workers, topology.scheduler):
            program.kill()
        postgres.kill()
        postgres.start()

    return kill


@pytest.mark.timeout(900 * LIVES)
def test_a_cluster(tmp_path: Path, postgres: Postgres) -> None:
    """Two replicas on PostgreSQL, a Dask scheduler and two workers: any of them, any process of theirs, all at once."""
    few: dict[str, Any] = {"API_WORKERS": "1", "WORKER_CORES": "1", "RIDELAB_LOG_LEVEL": "warning"}
    chance = random.Random(1)  # noqa: S311 - reproducible is what it has to be
    with (
        contextlib.closing(Forwarder(postgres.port)) as forwarder,
        Topology(tmp_path, postgres, port=forwarder.port, **few) as topology,
    ):
        topology.wait_until_ready()
        parts = [topology.scheduler, *topology.workers, *topology.replicas]
        victims = [killing(part) for part in parts]
        victims += [killing_a_worker(worker, chance) for worker in topology.workers]
        victims += [pausing(part, chance, LONGEST_PAUSE) for part in (*parts, topology.proxy)]
        victims += [silencing(forwarder, direction, chance, LONGEST_PAUSE) for direction in DIRECTIONS]
        victims.append(killing_everything(topology, postgres))
        accepted = Accepted(url=topology.url, database=topology.database, seed=1, runs=60)
        live(accepted, victims, lives=LIVES, steps=STEPS)


@pytest.mark.timeout(600)
def test_a_service_that_never_lives_long_gets_on(tmp_path: Path) -> None:
    """Killed every four seconds, starts included, until a batch is complete: each few lives add to it.

    Where other programs keep the machine busy a life is longer: half as long again as it takes to the first results.
    """
    with Api(tmp_path, RIDELAB_LOG_LEVEL="warning") as api:
        accepted = Accepted(url=api.url, database=f"sqlite:///{tmp_path}/data/ridelab.sqlite", seed=1, runs=RUNS)
        accepted.submit()
        begin = time.monotonic()
        accepted.await_work()
        life, left = max(LIFE, 1.5 * (time.monotonic() - begin)), [RUNS]
        while left[-1]:
            api.kill()
            wait_until(lambda: api.running, "it is started again", pause=0.01)
            time.sleep(life)  # whatever it does meanwhile
            left.append(accepted.waiting())
            assert len(left) < MOST_LIVES, f"it does not get on: {left}"
        print(f"\nkilled {len(left) - 1} times, every {life:.1f} s; runs left each time: {left}")
        accepted.finish()
