"""DRILL_FLIPS flipped bits (10,000, chosen by DRILL_SEED) of a database of every kind of thing, one at a time."""

import logging
import os
from pathlib import Path

import pytest

from tests.faults import bits

FLIPS = int(os.environ.get("DRILL_FLIPS", "10000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))


def test_no_flipped_bit_changes_an_answer_without_a_word(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.CRITICAL)
    bits.fill(tmp_path / "ridelab.sqlite")
    fates, silent = bits.flip(tmp_path / "ridelab.sqlite", seed=SEED, count=FLIPS)
    print(f"\n{FLIPS} flipped bits, seed {SEED}: {dict(fates)}")
    assert not silent, silent
