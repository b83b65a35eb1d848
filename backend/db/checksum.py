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


def checksum_column(*covered: str, if_present: str | None = None) -> Column[str]:
    """A table's column `checksum`, filled when a row is inserted.

    Args:
        covered: Names of the columns that it covers.
        if_present: One more, covered in rows where it holds a text; older rows have a checksum of the others alone.
    """
    names = covered if if_present is None else (*covered, if_present)
    info = {"covered": names, "if_present": if_present}

    def of_inserted(context: Any) -> str:
        return _checksum(info, context.get_current_parameters())

    return Column("checksum", String(LENGTH), nullable=True, default=of_inserted, info=info)


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
        changed["checksum"] = changed_checksum(table, row, values)
    if changed:
        connection.execute(update(table).where(column == key).values(**changed))


def changed_checksum(table: Table, row: Row[Any], values: Mapping[str, Any]) -> str:
    """The checksum of an intact row once it has these values; `UNCHECKED` stays."""
    return UNCHECKED if row.checksum == UNCHECKED else _checksum(table.c.checksum.info, {**row._mapping, **values})


def is_intact(table: Table, row: Row[Any], prefix: str = "") -> bool:
    """Whether a row of the table is as it was written.

    Args:
        table: Whose row it is.
        row: With the checksum and all columns that it covers.
        prefix: Of their names in the row.
    """
    stored = row._mapping[f"{prefix}checksum"]
    values = {name: row._mapping[f"{prefix}{name}"] for name in covered(table)}
    if not all(_is_of_its_type(table.c[name], value) for name, value in values.items()):
        return False
    info = table.c.checksum.info
    if stored in (UNCHECKED, _checksum(info, values)):
        return True
    return info["if_present"] is not None and stored == _checksum(info, values | {info["if_present"]: None})


def check(table: Table, row: Row[Any], what: str) -> None:
    """Raise where a row is not as it was written.

    Raises:
        DamagedError: It is not; `what` is for its reader.
    """
    if not is_intact(table, row):
        raise DamagedError(what)


def _is_of_its_type(column: Column[Any], value: Any) -> bool:
    """SQLite keeps a type with each value: one flipped bit there makes bytes of a text, or a number of nothing."""
    if isinstance(column.type, String):
        return isinstance(value, str | None)
    return isinstance(column.type, LargeBinary) or not isinstance(value, bytes)


def _checksum(info: Mapping[str, Any], values: Mapping[str, Any]) -> str:
    """Of a row with these values; `info` is that of its table's column."""
    names = (name for name in info["covered"] if name != info["if_present"] or values.get(name) is not None)
    return digest_of(values[name] for name in names)


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
