"""Jobs of one service that is killed, ended in order, or loses a worker, in any order with what its users do."""

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.servers.accepted import Accepted
from tests.servers.job_lives import ending, killing, killing_a_worker, live
from tests.servers.process import Api


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    limits = {"RIDELAB_MAX_REQUEST_COST": "1000", "RIDELAB_RUN_TIMEOUT": "3600"}
    with Api(tmp_path, **limits) as api:
        api.wait_until_ready()
        yield api


@pytest.mark.parametrize(
    ("lives", "steps"), [(2, 6), pytest.param(50, 20, marks=[pytest.mark.thorough, pytest.mark.timeout(7200)])]
)
def test_what_was_accepted_ends_as_its_requests_say(api: Api, tmp_path: Path, lives: int, steps: int) -> None:
    accepted = Accepted(url=api.url, database=f"sqlite:///{tmp_path}/data/ridelab.sqlite", seed=7, runs=60)
    victims = [killing(api), ending(api), killing_a_worker(api, random.Random(1))]  # noqa: S311
    live(accepted, victims, lives=lives, steps=steps)
