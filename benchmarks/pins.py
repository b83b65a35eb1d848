"""Pinned time histories: size and time by format, against computing them again; `python -m benchmarks.pins`."""

import io
from collections.abc import Callable, Mapping
from functools import partial
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
import pyarrow as pa
from pyarrow import parquet

from backend.runs import pins
from backend.runs.series import ROWS, SamplingHints, SeriesArray, pack
from benchmarks.timing import table
from sim_core.scenario import Scenario
from sim_core.scenario.presets import preset
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

REPEATS = 5
FORMATS: dict[str, dict[str, Any]] = {
    "plain": {"compression": "none"},
    "zstd 1": {"compression": "zstd", "compression_level": 1},
    "split, lz4": {"compression": "lz4", "use_byte_stream_split": True},
    "split, zstd 1 (ours)": {"compression": "zstd", "compression_level": 1, "use_byte_stream_split": True},
    "split, zstd 3": {"compression": "zstd", "compression_level": 3, "use_byte_stream_split": True},
    "split, zstd 9": {"compression": "zstd", "compression_level": 9, "use_byte_stream_split": True},
    "split, zstd 15": {"compression": "zstd", "compression_level": 15, "use_byte_stream_split": True},
}


def run() -> None:
    """Print both tables, for the paper's scenario with every strategy."""
    paper = preset("paper")
    for name in STRATEGIES:  # imports and matrices
        simulate(paper, name)
    arrays = {name: pack(simulate(paper, name)) for name in STRATEGIES}
    raw = sum(array.nbytes for array in arrays.values())
    rows: list[list[object]] = []
    for name, options in FORMATS.items():
        files = _written(arrays, options)
        rows.append(
            [
                name,
                sum(map(len, files.values())) / 1e6,
                sum(map(len, files.values())) / raw,
                _median_ms(partial(_written, arrays, options)),
                _median_ms(partial(_read, files)),
            ]
        )
    table(
        f"All {len(arrays)} strategies of the paper's scenario",
        ["", "MB", "of float32", "ms to write", "ms to read"],
        rows,
    )
    _against_computing(paper)


def _against_computing(paper: Scenario) -> None:
    """What a reader of a link waits for in the worker: 2000 points of every strategy, pinned or computed again."""
    files = pins.make(paper, list(STRATEGIES))
    stages = {
        name: SamplingHints.of((span.stage, span.start_time, span.end_time) for span in simulate(paper, name).stages)
        for name in STRATEGIES
    }
    opened = _median_ms(lambda: pins.opened(files, stages, 2000))
    seeds = iter(range(5000, 6000))

    def compute() -> None:
        road = paper.road.model_copy(update={"seed": next(seeds)})
        for name in STRATEGIES:
            pack(simulate(paper.model_copy(update={"road": road}), name), 2000)

    computed = _median_ms(compute)
    table("2000 points of each, in a worker", ["", "ms"], [["pinned", opened], ["computed again", computed]])


def _written(arrays: Mapping[str, SeriesArray], options: Mapping[str, Any]) -> dict[str, bytes]:
    files = {}
    for name, array in arrays.items():
        sink = io.BytesIO()
        columns = pa.table({key: np.ascontiguousarray(array[row]) for key, row in ROWS.items()})
        parquet.write_table(columns, sink, use_dictionary=False, write_statistics=False, **options)
        files[name] = sink.getvalue()
    return files


def _read(files: Mapping[str, bytes]) -> None:
    for content in files.values():
        columns = parquet.read_table(pa.BufferReader(content))
        np.stack([column.to_numpy() for column in columns.columns])


def _median_ms(work: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        begin = perf_counter()
        work()
        times.append(perf_counter() - begin)
    return 1000 * median(times)


if __name__ == "__main__":
    run()
