"""A long game of submitting, polling, cancelling and killing."""

from pathlib import Path

import pytest

from tests.faults.batch_machine import play


@pytest.mark.timeout(3600)
def test_what_was_said_once_stays_true(tmp_path: Path) -> None:
    play(tmp_path, games=25, steps=25)
