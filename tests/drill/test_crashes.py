"""The crash drill at length: DRILL_KILLS kills (50) of each topology, the choices by DRILL_SEED (1)."""

import os
import random
from pathlib import Path

import pytest

from tests.faults.crash_drill import Drill, database, kill_program, kill_worker
from tests.faults.test_crash_drill import drill_one_machine
from tests.servers.compose import Topology
from tests.servers.postgres import Postgres

KILLS = int(os.environ.get("DRILL_KILLS", "50"))
SEED = int(os.environ.get("DRILL_SEED", "1"))


@pytest.mark.timeout(60 * KILLS + 300)
def test_one_machine(tmp_path: Path) -> None:
    drill_one_machine(tmp_path, KILLS, SEED)


@pytest.mark.timeout(60 * KILLS + 300)
def test_a_cluster(tmp_path: Path, postgres: Postgres) -> None:
    """Two replicas on PostgreSQL, a Dask scheduler and two workers: any of them, and any process of theirs."""
    topology = Topology(tmp_path, postgres, API_WORKERS="1", WORKER_CORES="1", RIDELAB_LOG_LEVEL="warning")
    try:
        topology.wait_until_ready()
        chance = random.Random(SEED)  # noqa: S311 - reproducible is what it has to be
        parts = [topology.scheduler, *topology.workers, *topology.replicas]
        victims = [kill_program(part) for part in parts]
        victims += [kill_worker(worker, chance) for worker in topology.workers]
        engine = database(topology.database)
        Drill(url=topology.url, victims=victims, engine=engine, seed=SEED).run(KILLS, print)
        engine.dispose()
    finally:
        topology.end()
