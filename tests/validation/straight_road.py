"""Nonlinear cars on the road that linear ones drive on."""

from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch


@contextmanager
def straight_within_fine_steps() -> Iterator[None]:
    """The road of every car is straight within a fine step."""
    with patch("sim_core.loop.drive.under_axles", lambda _: None):
        yield
