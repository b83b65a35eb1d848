"""Short histories by seed of requests and of jobs; the drill drives a million steps, and puts mended faults back."""

from pathlib import Path

import pytest

from tests.faults.histories.jobs import Jobs
from tests.faults.histories.requests import Requests


@pytest.mark.parametrize("seed", [3, 4])
def test_a_history_of_requests_keeps_its_promises(seed: int) -> None:
    assert Requests(seed, lasts=100.0).run() > 1000


def test_a_history_of_jobs_keeps_its_promises(tmp_path: Path) -> None:
    assert Jobs(1, tmp_path, lasts=10.0).run() > 300
