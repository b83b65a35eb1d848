"""A power cut takes nothing back that was acknowledged; `make drill` tries DRILL_CUTS (1,000) by DRILL_SEED."""

import os
from pathlib import Path

import pytest

from tests.faults.power.cuts import cut, record

CUTS = int(os.environ.get("DRILL_CUTS", "1000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
EACH, PIECES = 50, 150  # cuts of one recording, and its pieces of work


@pytest.mark.parametrize("mode", ["DELETE", "WAL"])
def test_what_was_acknowledged_is_there_after_a_power_cut(tmp_path: Path, mode: str) -> None:
    cuts = cut(record(tmp_path, seed=1, pieces=8, mode=mode), tmp_path / "data-1", seed=1, count=5)
    assert cuts.fates.total() == 5
    assert not cuts.broken


def test_power_cuts_show_that_nothing_was_synced(tmp_path: Path) -> None:
    """Else they would prove nothing."""
    assert cut(record(tmp_path, seed=1, pieces=8, mode="off"), tmp_path / "data-1", seed=1, count=20).broken


@pytest.mark.thorough
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("mode", ["DELETE", "WAL"])
def test_many_power_cuts_take_nothing_back(tmp_path: Path, mode: str) -> None:
    broken, calls = list[str](), 0
    for seed in range(SEED, SEED + -(-CUTS // EACH)):
        recorded = record(tmp_path, seed=seed, pieces=PIECES, mode=mode)
        broken += cut(recorded, tmp_path / f"data-{seed}", seed=seed, count=EACH).broken
        calls += len(recorded)
    print(f"\n{CUTS} power cuts of {calls} calls, seeds from {SEED}")
    assert not broken, broken
