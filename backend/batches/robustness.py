"""The fields that a robustness study varies by default, with their ranges, from uncertain.toml."""

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

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


_DATA = tomllib.loads(Path(__file__).with_name("uncertain.toml").read_text(encoding="utf-8"))
UNCERTAINTIES = [
    UncertainRange(**each, title=dotted.field(each["field"]).title, unit=dotted.field(each["field"]).unit)
    for each in _DATA["uncertain"]
]


def defaults() -> RobustnessDefaults:
    """Return what a study varies, where nobody says otherwise."""
    return RobustnessDefaults(
        ranges=UNCERTAINTIES, samples=SAMPLES, strategies=STRATEGIES, baseline=BASELINE, figures=FIGURES
    )


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
