"""The only catalogue of signals, windows, statistics, stages and metrics: catalogue.toml, by key.

Everything that shows a number (tables, plots, CSV headers, API documentation) reads it from here.
Units are SI; a view may show others, and then converts itself.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One thing that is named.

    Attributes:
        key: Its name in results, files and addresses.
        label: In words.
        unit: SI unit, `1` for none.
        description: What else there is to say.
        symbol: As in docs/reference/nomenclature.md.
        notable: Of those in LIMITS_EXCEEDED, the value [unit] from which on a warning is shown.
    """

    key: str
    label: str
    unit: str
    description: str = ""
    symbol: str = ""
    notable: float = 0.0


_TABLES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def _entries(table: str) -> dict[str, Entry]:
    return {key: Entry(key=key, **entry) for key, entry in _TABLES[table].items()}


SIGNALS = _entries("signals")
WINDOWS, STATISTICS, STAGES = map(_entries, ("windows", "statistics", "stages"))
# Metrics beside those of windows; the catalogue of the API has the last ones, those of a whole run, as `run_figures`.
COMFORT, EVENTS, RUN_FIGURES = map(_entries, ("comfort", "events", "run_metrics"))
REFERENCES = _entries("references")  # lines that a plot draws beside the curves

# SI unit -> the unit in which a person reads it, and the factor to that; other units are shown as they are.
SHOWN_UNITS = {"m": ("mm", 1000.0), "m/s": ("km/h", 3.6), "Pa": ("MPa", 1e-6), "N": ("kN", 1e-3)}

# Those that a suspension changes: they get an RMS and a peak in each window.
METRIC_SIGNALS = tuple(SIGNALS)[7:]

# The four the paper's tables compare.
PAPER_SIGNALS = METRIC_SIGNALS[:4]

ROUGH_ROAD, BUMP, WHOLE = WINDOWS
RMS, PEAK = STATISTICS
# What of PAPER_SIGNALS: RMS on the rough road (Tables 4, 7, 9), peaks on the bump (Tables 5, 8, 10).
PAPER_VIEWS = ((ROUGH_ROAD, RMS), (BUMP, PEAK))

# Metrics that are 0 where a limit of the car is satisfied.
LIMITS_EXCEEDED = ("events.travel_exceeded_mm", "events.airborne_ms")

_FLAGS = ("target_reached", "bump_complete")  # the events that are true or false


@dataclass(frozen=True, slots=True, kw_only=True)
class Metric:
    """One number of a strategy's result, or something true or false.

    Attributes:
        path: Where it stands in a result's summary.
        label: In words.
        unit: SI unit, `1` for none.
        flag: Whether it is true or false.
    """

    path: tuple[str, ...]
    label: str
    unit: str
    flag: bool = False

    @property
    def key(self) -> str:
        """Return the flat name, as the columns of tables have it: `bump.body_acceleration.peak`."""
        return ".".join(self.path).removeprefix("metrics.")

    def of(self, summary: Mapping[str, Any]) -> Any:
        """Return its value in a result's summary; None where that has none."""
        value: Any = summary
        for name in self.path:
            value = value.get(name) if isinstance(value, (dict, Mapping)) else None  # dict first: an ABC takes long
        return value


def metric_key(window: str, signal: str, statistic: str) -> str:
    """Return the flat name of one signal's statistic in one window."""
    return f"{window}.{signal}.{statistic}"


def _metrics() -> dict[str, Metric]:
    statistics = {RMS: "RMS", PEAK: "peak"}
    metrics = [
        Metric(
            path=("metrics", window.key, signal, statistic),
            label=f"{SIGNALS[signal].label}, {words}, {window.label.lower()}",
            unit=SIGNALS[signal].unit,
        )
        for window in WINDOWS.values()
        for signal in METRIC_SIGNALS
        for statistic, words in statistics.items()
    ]
    for part, items in ((("comfort",), COMFORT), (("events",), EVENTS), ((), RUN_FIGURES)):
        metrics += [
            Metric(path=(*part, key), label=item.label, unit=item.unit, flag=key in _FLAGS)
            for key, item in items.items()
        ]
    return {metric.key: metric for metric in metrics}


# Every number of a result by its flat name: the columns of tables, the metrics of summaries, objectives and limits.
METRICS = _metrics()
NUMBERS = tuple(key for key, metric in METRICS.items() if not metric.flag)
PAPER_METRICS = tuple(
    metric_key(window, signal, statistic) for window, statistic in PAPER_VIEWS for signal in PAPER_SIGNALS
)
