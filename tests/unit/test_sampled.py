"""The sums of a recording's samples: those of the signal that was sampled, however coarsely."""

import numpy as np
import pytest

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.metrics.definition import Sums
from sim_core.metrics.sampled import sampled_sums

SECTIONS = [(0.0, 11.997), (11.997, 13.0), (13.0, 20.0)]  # one end lies between samples
BODY = METRIC_SIGNALS.index("body_acceleration")


def sums_of(time: FloatArray, acceleration: FloatArray) -> Sums:
    """Return the sums of a recording of one acceleration."""
    signals = {key: np.full(len(time), np.nan) for key in METRIC_SIGNALS}
    signals |= {"time": time, "body_acceleration": acceleration}
    return sampled_sums(signals, SECTIONS, (1.0, 1.0), ((np.inf, np.inf), (np.inf, np.inf)))


def vibration(time: FloatArray) -> FloatArray:
    """Return noise of 0.5 to 30 Hz, where it is as strong at every frequency."""
    frequency = np.arange(0.5, 30, 0.03)
    phase = np.random.default_rng(1).uniform(0, 2 * np.pi, len(frequency))
    noise: FloatArray = np.cos(2 * np.pi * frequency * time[:, None] + phase).sum(axis=1)
    return noise


@pytest.mark.parametrize("jitter", [0.0, 4e-4])
def test_a_coarse_recording_has_the_rms_and_weighted_rms_of_the_signal(jitter: float) -> None:
    """Lines between samples would lack 9 % of its RMS and 6 % of its weighted RMS."""
    fine, coarse = np.arange(40_001) / 2000, np.arange(2001) / 100
    coarse[1:-1] += np.random.default_rng(2).uniform(-jitter, jitter, len(coarse) - 2)
    true, found = (sums_of(time, vibration(time)) for time in (fine, coarse))
    for section in (0, 2):
        assert found.squares[section, BODY] == pytest.approx(true.squares[section, BODY], rel=0.01)
    whole, expected = found.squares[:, BODY].sum(), true.squares[:, BODY].sum()
    assert np.sqrt(whole / expected) == pytest.approx(1, abs=0.005)
    weighted = [each.weighted_squares / each.weighted_samples for each in (found, true)]
    assert np.sqrt(weighted[0] / weighted[1]) == pytest.approx(1, abs=0.005)
