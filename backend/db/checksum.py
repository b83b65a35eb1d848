"""Checksums of rows: a bit that flips in what is stored is noticed when the row is read.

A table says in its definition which columns the checksum covers; its insertion computes it. A row of an older version
has `UNCHECKED` in its place and counts as intact. One without any is damaged: of a record that a flipped bit has
shortened SQLite reads the last columns as NULL.
"""

import hashlib
from collections.abc import Iterable, Mapping
from typing import Any

import orjson
from sqlalchemy import Column, Connection, LargeBinary, Row, String, Table, select, update

from backend.errors import DamagedError

UNCHECKED = "unchecked"
LENGTH = 16  # hexadecimal digits: 64 bits, which chance does not meet


def checksum_column(*covered: str) -> Column[str]:
    """A table's column `checksum`, filled when a row is inserted; it covers the columns of these names."""

    def of_inserted(context: Any) -> str:
        return digest_of(context.get_current_parameters()[name] for name in covered)

    return Column("checksum", String(LENGTH), nullable=True, default=of_inserted, info={"covered": covered})


def covered(table: Table) -> tuple[str, ...]:
    """Names of the columns that the table's checksum covers."""
    names: tuple[str, ...] = table.c.checksum.info["covered"]
    return names


def update_row(connection: Connection, table: Table, key: str, values: Mapping[str, Any]) -> None:
    """Change values of the row of that key, and with them its checksum.

    Raises:
        DamagedError: It was damaged before.
    """
    (column,) = table.primary_key
    changed = dict(values)
    if values.keys() & set(covered(table)):
        row = connection.execute(select(table).where(column == key).with_for_update(key_share=True)).one()
        check(table, row, "row")
        if row.checksum != UNCHECKED:
            changed["checksum"] = digest_of({**row._mapping, **values}[name] for name in covered(table))
    if changed:
        connection.execute(update(table).where(column == key).values(**changed))


def is_intact(table: Table, row: Row[Any], prefix: str = "") -> bool:
    """Whether a row of the table is as it was written.

    Args:
        table: Whose row it is.
        row: With the checksum and all columns that it covers.
        prefix: Of their names in the row.
    """
    stored = row._mapping[f"{prefix}checksum"]
    values = {name: row._mapping[f"{prefix}{name}"] for name in covered(table)}
    # SQLite keeps a type with each value: one flipped bit there makes bytes of a text.
    if any(
        isinstance(value, bytes) and not isinstance(table.c[name].type, LargeBinary) for name, value in values.items()
    ):
        return False
    return stored in (UNCHECKED, digest_of(values.values()))


def check(table: Table, row: Row[Any], what: str) -> None:
    """Raise where a row is not as it was written.

    Raises:
        DamagedError: It is not; `what` is for its reader.
    """
    if not is_intact(table, row):
        raise DamagedError(what)


def digest_of(values: Iterable[Any]) -> str:
    """The checksum of these values in this order."""
    digest = hashlib.blake2b(digest_size=LENGTH // 2)
    for value in values:
        part = _bytes(value)
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
