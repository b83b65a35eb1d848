"""Checksums of rows that never change: a bit that flips in what is stored is noticed when the row is read.

A table says in its definition which columns the checksum covers; its insertion computes it. A row that a version
without checksums has written has `UNCHECKED` in its place and counts as intact. One without any is damaged: of a record
that a flipped bit has shortened SQLite reads the last columns as NULL.
"""

import hashlib
from collections.abc import Mapping
from typing import Any

import orjson
from sqlalchemy import Column, Row, String, Table

from backend.errors import DamagedError

UNCHECKED = "unchecked"
LENGTH = 16  # hexadecimal digits: 64 bits, which chance does not meet


def checksum_column(*covered: str) -> Column[str]:
    """Return a table's column `checksum` of the columns with these names, filled when a row is inserted."""

    def of_inserted(context: Any) -> str:
        return _checksum(covered, context.get_current_parameters())

    return Column("checksum", String(LENGTH), nullable=True, default=of_inserted, info={"covered": covered})


def checksum_of(table: Table, values: Mapping[str, Any]) -> str:
    """Return the checksum of a row of the table with these values."""
    return _checksum(table.c.checksum.info["covered"], values)


def is_intact(table: Table, row: Row[Any], prefix: str = "") -> bool:
    """Check whether a row of the table is as it was written.

    Args:
        table: Whose row it is.
        row: With the checksum and all columns that it covers.
        prefix: What their names in the row begin with.
    """
    stored = row._mapping[f"{prefix}checksum"]
    values = {name: row._mapping[f"{prefix}{name}"] for name in table.c.checksum.info["covered"]}
    # SQLite keeps a type with each value: one flipped bit there makes bytes of a text.
    texts = (value for name, value in values.items() if isinstance(table.c[name].type, String))
    return all(isinstance(each, str | None) for each in texts) and stored in (UNCHECKED, checksum_of(table, values))


def check(table: Table, row: Row[Any], what: str) -> None:
    """Refuse a row that is not as it was written.

    Raises:
        DamagedError: It is not; `what` is for its reader.
    """
    if not is_intact(table, row):
        raise DamagedError(what)


def _checksum(names: tuple[str, ...], values: Mapping[str, Any]) -> str:
    digest = hashlib.blake2b(digest_size=LENGTH // 2)
    for name in names:
        part = _bytes(values.get(name))
        digest.update(len(part).to_bytes(8, "big"))
        digest.update(part)
    return digest.hexdigest()


def _bytes(value: Any) -> bytes:
    if isinstance(value, str):
        return value.encode()
    if isinstance(value, bytes | memoryview):
        return bytes(value)
    if isinstance(value, int) and not isinstance(value, bool):
        value = float(value)  # a column of floats gives 1 back as 1.0
    return orjson.dumps(value, option=orjson.OPT_SORT_KEYS)
