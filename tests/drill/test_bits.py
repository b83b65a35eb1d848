"""DRILL_FLIPS flipped bits (10,000, chosen by DRILL_SEED) of a database of every kind of thing, one at a time."""

import logging
import os
from contextlib import closing
from pathlib import Path

import pytest

from backend.store import Store
from tests.faults import bits
from tests.servers.postgres import Postgres

FLIPS = int(os.environ.get("DRILL_FLIPS", "10000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))


@pytest.mark.timeout(7200)
def test_no_flipped_bit_changes_an_answer_without_a_word(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.CRITICAL)
    bits.fill(f"sqlite:///{tmp_path / 'ridelab.sqlite'}")
    fates, silent = bits.flip(tmp_path / "ridelab.sqlite", seed=SEED, count=FLIPS)
    print(f"\n{FLIPS} flipped bits, seed {SEED}: {dict(fates)}")
    assert not silent, silent


def test_no_flipped_bit_of_a_value_on_postgresql_goes_unnoticed(postgres: Postgres) -> None:
    url = postgres.new_database()
    bits.fill(url)
    with closing(Store(url)) as store:
        fates, silent = bits.flip_on_server(store, seed=SEED, count=FLIPS // 50)
    print(f"\n{fates.total()} flipped bits of values on PostgreSQL, seed {SEED}: {dict(fates)}")
    assert not silent, silent
