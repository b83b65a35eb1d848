"""The formats in which tables and time histories are answered; Parquet where the extra `parquet` is installed."""

from importlib.util import find_spec
from typing import Annotated, Literal

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

NO_PARQUET = "There is no Parquet here: whoever runs this service installs it by pip install pyarrow"
MEDIA_TYPES = {
    "json": "application/json",
    "csv": "text/csv; charset=utf-8; header=present",
    "parquet": "application/vnd.apache.parquet",
}
BINARY = "application/octet-stream"  # numbers as they are: hardly smaller compressed


def has_parquet() -> bool:
    """Whether its library is installed."""
    return find_spec("pyarrow") is not None


def _available(file_format: str) -> str:
    if file_format == "parquet" and not has_parquet():
        raise PydanticCustomError("not_installed", NO_PARQUET)
    return file_format


FormatName = Literal["json", "csv", "parquet"]
FileFormat = Annotated[FormatName, AfterValidator(_available)]
