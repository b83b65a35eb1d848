"""A short game of submitting, polling, cancelling and killing."""

from pathlib import Path

from tests.faults.batch_machine import play


def test_what_was_said_once_stays_true(tmp_path: Path) -> None:
    play(tmp_path, games=3, steps=10)
