"""The fields that a robustness study varies by default, with their ranges.

docs/explanation/robustness.md gives the reasons.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from backend.batches.summary_models import RobustnessDefaults, UncertainRange
from backend.json_types import JsonObject
from sim_core.catalogue import LIMITS_EXCEEDED, PAPER_METRICS
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.dotted import is_within
from sim_core.strategies import reads, reads_in, strategies

SAMPLES = 200
BASELINE = "lv"
STRATEGIES = ("lv", "lqr", "skyhook", "speed_only", "passive")
FIGURES = (*PAPER_METRICS, *LIMITS_EXCEEDED)


@dataclass(frozen=True, slots=True, kw_only=True)
class Uncertainty:
    """A field nobody knows exactly, the range its true value lies in, and where that range comes from."""

    field: str
    low: float
    high: float
    why: str


UNCERTAINTIES = (
    Uncertainty(field="mismatch.body_mass", low=0.8, high=1.25, why="From the driver alone to a full load"),
    Uncertainty(field="mismatch.springs", low=0.9, high=1.1, why="Scatter of manufacture, and age"),
    Uncertainty(field="mismatch.damping", low=0.7, high=1.3, why="Oil temperature and wear"),
    Uncertainty(field="mismatch.tyres", low=0.9, high=1.1, why="Pressure and temperature"),
    Uncertainty(field="mismatch.rebound_ratio", low=1, high=3, why="Dampers resist rebound more than compression"),
    Uncertainty(field="mismatch.preview_offset", low=-0.3, high=0.3, why="Where the sensors place the road ahead"),
    Uncertainty(field="mismatch.preview_gain", low=0.85, high=1.15, why="Scale of the measured height"),
    Uncertainty(field="mismatch.preview_noise", low=0, high=0.003, why="Noise of each measured height"),
    Uncertainty(field="mismatch.preview_delay", low=0, high=0.03, why="Exposure, transfer and processing"),
    Uncertainty(field="actuator.bandwidth", low=5, high=30, why="From hydraulic to electric actuators"),
    Uncertainty(field="actuator.saturation", low=1500, high=5000, why="What the actuator gives, hot or at low supply"),
    Uncertainty(field="road.seed", low=1, high=1000, why="Another road of the same class at every point"),
)


def defaults() -> RobustnessDefaults:
    """Return what a study varies, where nobody says otherwise."""
    described = {each.field: dotted.field(each.field) for each in UNCERTAINTIES}
    ranges = [
        UncertainRange(**asdict(each), title=described[each.field].title, unit=described[each.field].unit)
        for each in UNCERTAINTIES
    ]
    return RobustnessDefaults(ranges=ranges, samples=SAMPLES, strategies=STRATEGIES, baseline=BASELINE, figures=FIGURES)


def drawn(seed: int) -> dict[str, float]:
    """Draw a point of those ranges, the same one for the same seed; the road is not drawn."""
    ranges = [each for each in UNCERTAINTIES if each.field != "road.seed"]
    shares = np.random.default_rng(seed).random(len(ranges))
    pairs = zip(ranges, shares, strict=True)
    return {each.field: each.low + float(share) * (each.high - each.low) for each, share in pairs}


def sweep(ranges: Mapping[str, Sequence[float]], samples: int, seed: int) -> JsonObject:
    """Make the Latin hypercube over those ranges, as a batch takes it."""
    return {"latin_hypercube": {"ranges": {k: list(v) for k, v in ranges.items()}, "samples": samples, "seed": seed}}


def fields_read(strategy: str, fields: Sequence[str], scenario: Scenario) -> list[str]:
    """Return the fields that can change the strategy's result; errors of preview only where it has preview.

    Args:
        strategy: Its id.
        fields: Those that are varied.
        scenario: The one that they are varied in.
    """
    offered = strategies()
    if strategy not in offered:  # another version's, or a file's that is gone
        return list(fields)
    kind = offered[strategy]
    varied_preview = any(name.endswith(".preview") for name in fields)
    parts = reads(kind, scenario.speed.policy) if varied_preview else reads_in(scenario, kind)
    return [name for name in fields if any(is_within(name, part) for part in parts)]
