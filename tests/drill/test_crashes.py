"""The crash drill at length: RIDELAB_KILLS kills (50), beginning with RIDELAB_SEED (1)."""

import os
from pathlib import Path

import pytest

from tests.faults.test_crash_drill import drill_one_machine

KILLS = int(os.environ.get("RIDELAB_KILLS", "50"))
SEED = int(os.environ.get("RIDELAB_SEED", "1"))


@pytest.mark.timeout(30 * KILLS + 300)
def test_one_machine(tmp_path: Path) -> None:
    drill_one_machine(tmp_path, KILLS, SEED)
