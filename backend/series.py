"""Time histories in the forms they leave the service: decimated, JSON, CSV, Parquet.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.signals.SIGNALS`).
"""

import base64
import io
import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import orjson
import pyarrow as pa
from numpy.typing import NDArray
from pyarrow import csv, parquet

from sim_core.signals import SIGNALS

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
ALWAYS = ("time", "position")


def chosen(signals: Iterable[str] | None) -> list[str]:
    """The signals asked for in the catalogue's order, always with time and position; None is all."""
    wanted = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in wanted]


def decimate(series: SeriesArray, points: int | None, breaks: Sequence[float] = ()) -> SeriesArray:
    """About `points` samples of a series, the same ones for all signals, with every peak kept.

    Half of the samples lie evenly; between two of them goes the sample that a straight line misses most (relative to
    its signal's range). Added is each signal's largest and smallest value between two `breaks`.

    Args:
        series: Shape (signals, samples), its first row the time [s].
        points: How many samples, or None for all.
        breaks: Times [s] at which a window begins or ends whose own extremes have to survive.
    """
    count = series.shape[1]
    if points is None or points >= count:
        return series
    stride = -(-2 * count // points)
    whole = (count - 1) // stride  # complete strides
    nodes = np.arange(whole + 1) * stride
    inner = series[:, : whole * stride].reshape(len(series), whole, stride)
    start, end = series[:, nodes[:-1]], series[:, nodes[1:]]
    fraction = np.arange(stride, dtype=np.float32) / np.float32(stride)
    missed = np.abs(inner - (start[:, :, None] + (end - start)[:, :, None] * fraction))
    span = np.ptp(series, axis=1)
    span[span == 0] = 1
    worst = (missed / span[:, None, None]).max(axis=0).argmax(axis=1)
    keep = np.concatenate([nodes, nodes[:-1] + worst, [count - 1], _extremes(series, breaks)])
    return np.take(series, np.unique(keep), axis=1)


def _extremes(series: SeriesArray, breaks: Sequence[float]) -> NDArray[np.int64]:
    """Indices of each signal's extremes in each window between the breaks."""
    cuts = np.searchsorted(series[0], np.asarray(breaks, dtype=np.float32))
    edges = np.unique(np.concatenate([[0], cuts, [series.shape[1]]]))
    found = [
        start + extreme(series[:, start:end], axis=1)
        for start, end in itertools.pairwise(edges)
        for extreme in (np.argmin, np.argmax)
    ]
    return np.concatenate(found)


def packed(values: NDArray[np.float32]) -> dict[str, str]:
    """One signal in plotly's typed-array form: little-endian float32 in base64."""
    data = np.ascontiguousarray(values, dtype="<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(data.data).decode("ascii")}


def as_json(series: SeriesArray, signals: Iterable[str], encoding: str) -> dict[str, Any]:
    """By signal its values, as lists (`list`) or typed arrays (`base64`)."""
    if encoding == "base64":
        return {key: packed(series[ROWS[key]]) for key in signals}
    return {key: series[ROWS[key]] for key in signals}


def column_name(key: str) -> str:
    """A table's column: `body_acceleration [m/s^2]`."""
    return f"{key} [{SIGNALS[key].unit}]"


def _table(members: Mapping[str, SeriesArray], signals: Sequence[str]) -> pa.Table:
    """One row a sample; a first column names the strategy where there are several."""
    columns = {}
    if len(members) > 1:
        lengths = [series.shape[1] for series in members.values()]
        columns["strategy"] = pa.array(np.repeat(list(members), lengths))
    for key in signals:
        columns[column_name(key)] = pa.array(np.concatenate([series[ROWS[key]] for series in members.values()]))
    return pa.table(columns)


def render_csv(members: Mapping[str, SeriesArray], signals: Sequence[str]) -> bytes:
    """A table with units in its header and nothing else, as spreadsheets read it."""
    sink = io.BytesIO()
    csv.write_csv(_table(members, signals), sink, csv.WriteOptions(quoting_header="none"))
    return sink.getvalue()


def render_parquet(members: Mapping[str, SeriesArray], signals: Sequence[str], provenance: Mapping[str, str]) -> bytes:
    """The same table as Parquet; units are field metadata, the provenance is the file's."""
    table = _table(members, signals)
    units = {column_name(key): {"signal": key, "unit": SIGNALS[key].unit} for key in signals}
    fields = [field.with_metadata(units.get(field.name, {})) for field in table.schema]
    sink = io.BytesIO()
    parquet.write_table(table.cast(pa.schema(fields, metadata=dict(provenance))), sink, compression="zstd")
    return sink.getvalue()


def render_json(members: Mapping[str, SeriesArray], signals: Sequence[str], encoding: str, core_version: str) -> bytes:
    """`{strategy, series}` of one strategy, `{strategies}` of several, with the units beside."""
    bodies = {name: as_json(series, signals, encoding) for name, series in members.items()}
    if len(bodies) == 1:
        ((name, body),) = bodies.items()
        content: dict[str, Any] = {"strategy": name, "series": body}
    else:
        content = {"strategies": bodies}
    units = {key: SIGNALS[key].unit for key in signals}
    return orjson.dumps({"core_version": core_version, "units": units, **content}, option=orjson.OPT_SERIALIZE_NUMPY)
