"""The crash drill, a few kills of it; `make drill` does fifty."""

import random
from pathlib import Path

from tests.faults.crash_drill import Drill, database, kill_program, kill_worker
from tests.servers.api import Api


def drill_one_machine(folder: Path, kills: int, seed: int) -> None:
    """One service with an embedded cluster on SQLite: the service and its processes are killed."""
    api = Api(folder, RIDELAB_LOG_LEVEL="warning")
    try:
        api.wait_until_ready()
        chance = random.Random(seed)  # noqa: S311
        engine = database(f"sqlite:///{folder}/data/ridelab.sqlite")
        victims = [kill_program(api), kill_worker(api, chance), kill_worker(api, chance)]
        Drill(url=api.url, victims=victims, engine=engine, seed=seed).run(kills, print)
        engine.dispose()
    finally:
        api.end()


def test_nothing_is_lost_however_often_a_machine_is_shot_at(tmp_path: Path) -> None:
    drill_one_machine(tmp_path, kills=5, seed=7)
