"""Tables that were sent: described, or read by a worker; what is wrong or unsure in them is a problem."""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any, TypeVar

from backend.compute.workers import Workers
from backend.errors import BusyError, InvalidError, TooManyRequestsError, UnsureError
from backend.gate import Gate
from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.tables.errors import TableError, UnsureTableError
from sim_core.tables.table import read_table

DRAWN = 800  # points
LARGE_AT_ONCE = 2  # files that were written to disk
COST = 2.0  # of reading the longest file allowed [s of one core]
Read = TypeVar("Read")


@dataclass(eq=False, kw_only=True)
class Tables:
    """The one service that reads files of measurements."""

    workers: Workers
    gate: Gate
    _large: set[str] = field(default_factory=set)  # clients of whom a large file is being read

    async def read(self, client: str, read: Callable[..., Read], *file: object) -> Read:
        """Return what a worker reads from a file.

        Raises:
            UnsureError: It has to be asked about first.
            InvalidError: It is none of what is read; the message has the line.
            TemporaryError: Too much is being read.
        """
        with self.gate.computing(client, COST), self._place(client, file[0]):
            try:
                return await self.workers.call(read, *file, client=client, cost=COST)
            except UnsureTableError as error:
                raise UnsureError(error.message, error.description) from None
            except TableError as error:
                place = "" if error.line is None else f"Line {error.line}: "
                raise InvalidError(f"{place}{error.message}.", pointer="") from None

    @contextmanager
    def _place(self, client: str, content: object) -> Iterator[None]:
        """Hold one of the two places of large files, which take memory: one of a client."""
        if not isinstance(content, Path):
            yield
            return
        if client in self._large:
            raise TooManyRequestsError("One large file of a client is read at a time.")
        if len(self._large) >= LARGE_AT_ONCE:
            raise BusyError(f"{LARGE_AT_ONCE} large files are being read.")
        self._large.add(client)
        try:
            yield
        finally:
            self._large.discard(client)

    async def described(self, client: str, content: bytes | Path, table: Mapping[str, Any] | None) -> dict[str, Any]:
        """Return how a file would be read, what has to be asked about it, and a curve of what comes of it."""
        return await self.read(client, describe, content, table)


def describe(content: bytes | Path, table: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the description of a table and its curve; by a worker."""
    found = read_table(content, None, table)
    return {"table": found.description(), "curve": _curve(found.guessed)}


def _curve(signals: Mapping[str, FloatArray]) -> dict[str, Any] | None:
    """Return about `DRAWN` points of the heights, or of the first signal that has metrics."""
    along = next((key for key in ("distance", "time", "position") if key in signals), None)
    drawn = [key for key in ("height", "left", "right") if key in signals]
    drawn = drawn or [key for key in METRIC_SIGNALS if key in signals][:1]
    if along is None or not drawn:
        return None
    step = max(1, len(signals[along]) // DRAWN)
    values = [[value if isfinite(value) else None for value in signals[key][::step].tolist()] for key in drawn]
    return {"along": along, "x": signals[along][::step].tolist(), "signals": drawn, "values": values}


def parse_table(text: str | None) -> dict[str, Any] | None:
    """Return the corrections in a parameter.

    Raises:
        InvalidError: They are no JSON object.
    """
    try:
        table = json.loads(text) if text else None
    except (ValueError, RecursionError):
        table = text
    if table is not None and not isinstance(table, dict):
        message = "This has to be a JSON object: what a dry run answers as `table`, or parts of it"
        raise InvalidError(message, parameter="table")
    return table
