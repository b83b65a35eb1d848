"""Time histories of a run as a file: JSON, CSV or Parquet; pinned, or simulated again; in a worker."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import orjson
import pyarrow as pa
from pyarrow import csv, parquet

from backend.ecu.drive import simulate
from backend.json_types import JsonObject
from backend.runs import pins
from backend.runs.series import ROWS, SeriesArray, Stages, as_json, pack
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class Export:
    """Which time histories to export, and in which format.

    Attributes:
        strategies: Ids, in the order they come out.
        signals: Keys, in the catalogue's order.
        points: About how many samples of each strategy, None for all.
        provenance: Where they come from, kept in the file where its format has a place for it.
    """

    strategies: Sequence[str]
    signals: Sequence[str]
    points: int | None
    file_format: Literal["json", "csv", "parquet"]
    encoding: Literal["list", "base64"]
    provenance: Mapping[str, str]


def render(scenario: Scenario, export: Export) -> bytes:
    """Simulate and render."""
    return _rendered({name: pack(simulate(scenario, name), export.points) for name in export.strategies}, export)


def render_pinned(pinned: Mapping[str, bytes], stages: Mapping[str, Stages], export: Export) -> bytes:
    """Render pinned time histories (arguments as for `pins.opened`); signals that were not pinned are left out."""
    members = pins.opened(pinned, stages, export.points)
    present = [key for key in export.signals if not any(np.isnan(array[ROWS[key]]).all() for array in members.values())]
    return _rendered(members, replace(export, signals=present))


def _rendered(members: Mapping[str, SeriesArray], export: Export) -> bytes:
    if export.file_format == "csv":
        return render_csv(members, export)
    if export.file_format == "parquet":
        return render_parquet(members, export)
    return render_json(members, export)


def render_json(members: Mapping[str, SeriesArray], export: Export) -> bytes:
    """`{strategy, series}` of one strategy, `{strategies}` of several, with the units beside."""
    bodies = {name: as_json(array, export.signals, export.encoding) for name, array in members.items()}
    if len(bodies) == 1:
        ((name, body),) = bodies.items()
        content: JsonObject = {"strategy": name, "series": body}
    else:
        content = {"strategies": bodies}
    units = {key: SIGNALS[key].unit for key in export.signals}
    head = {"core_version": export.provenance["core_version"], "units": units}
    return orjson.dumps({**head, **content}, option=orjson.OPT_SERIALIZE_NUMPY)


def render_csv(members: Mapping[str, SeriesArray], export: Export) -> bytes:
    """A table with units in its header and nothing else, as spreadsheets read it."""
    sink = io.BytesIO()
    csv.write_csv(_table(members, export.signals), sink, csv.WriteOptions(quoting_header="none"))
    return sink.getvalue()


def render_parquet(members: Mapping[str, SeriesArray], export: Export) -> bytes:
    """The table as Parquet; units are field metadata, the provenance is the file's."""
    table = _table(members, export.signals)
    units = {column_name(key): {"signal": key, "unit": SIGNALS[key].unit} for key in export.signals}
    fields = [field.with_metadata(units.get(field.name, {})) for field in table.schema]
    provenance = {f"ridelab.{key}": value for key, value in export.provenance.items()}
    sink = io.BytesIO()
    parquet.write_table(table.cast(pa.schema(fields, metadata=provenance)), sink, compression="zstd")
    return sink.getvalue()


def column_name(key: str) -> str:
    """The name of a signal's column: `body_acceleration [m/s^2]`."""
    return f"{key} [{SIGNALS[key].unit}]"


def _table(members: Mapping[str, SeriesArray], signals: Sequence[str]) -> pa.Table:
    """A table with a row for each sample; a first column names the strategy where there are several."""
    columns = {}
    if len(members) > 1:
        lengths = [array.shape[1] for array in members.values()]
        columns["strategy"] = pa.array(np.repeat(list(members), lengths))
    for key in signals:
        columns[column_name(key)] = pa.array(np.concatenate([array[ROWS[key]] for array in members.values()]))
    return pa.table(columns)
