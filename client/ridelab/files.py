"""Answers written to files: the whole file or none. Parquet is made here, of the service's CSV."""

import io
import os
import uuid
from collections.abc import Callable, Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path

from ridelab.notebooks import needed

FORMATS = ("json", "csv", "parquet")


def format_of(path: str | os.PathLike[str], file_format: str | None = None) -> str:
    """Return the format named, else that of the name's ending.

    Raises:
        ValueError: There is no such format, or its library is not installed; the message says what there is.
    """
    kind = (file_format or Path(path).suffix.removeprefix(".")).lower()
    if kind not in FORMATS:
        raise ValueError(f"The file's format has to be {', '.join(FORMATS[:-1])} or {FORMATS[-1]}")
    if kind == "parquet" and find_spec("pyarrow") is None:
        raise ValueError("Parquet needs pyarrow: pip install pyarrow")
    return kind


def table_in(file_format: str, content: Callable[[str], Iterator[bytes]]) -> Iterator[bytes]:
    """Return the bytes of a table, which `content` gives in the service's formats, in any of `FORMATS`."""
    return _as_parquet(content("csv")) if file_format == "parquet" else content(file_format)


def _as_parquet(table: Iterable[bytes]) -> Iterator[bytes]:
    """Make Parquet of CSV with units in its header; a column's unit is in its field's metadata too.

    Raises:
        ImportError: pyarrow is not installed.
    """
    arrow, csv, parquet = (needed("pyarrow", "Parquet", f"pyarrow{module}") for module in ("", ".csv", ".parquet"))
    columns = csv.read_csv(io.BytesIO(b"".join(table)))
    fields = []
    for field in columns.schema:
        _, _, unit = field.name.removesuffix("]").partition(" [")
        if arrow.types.is_null(field.type):
            field = field.with_type(arrow.string())
        elif unit and arrow.types.is_integer(field.type):  # whole numbers of a quantity that has others elsewhere
            field = field.with_type(arrow.float64())
        fields.append(field.with_metadata({"unit": unit}) if unit else field)
    sink = io.BytesIO()
    parquet.write_table(columns.cast(arrow.schema(fields)), sink, compression="zstd")
    yield sink.getvalue()


def save(pieces: Iterable[bytes], path: str | os.PathLike[str]) -> Path:
    """Write the pieces beside `path`, then put them in its place: a broken answer leaves what was there.

    Raises:
        OSError: It cannot be written.
    """
    target = Path(path)
    beside = target.with_name(f".{target.name}.{uuid.uuid4().hex[:8]}")
    try:
        with beside.open("xb") as file:
            file.writelines(pieces)
        return beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
