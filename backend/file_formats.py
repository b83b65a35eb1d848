"""The formats in which tables and time histories are answered."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

NO_PARQUET = "The service writes json and csv; ridelab export ID --out FILE.parquet makes Parquet of them"
MEDIA_TYPES = {"json": "application/json", "csv": "text/csv; charset=utf-8; header=present"}
BINARY = "application/octet-stream"  # numbers as they are: hardly smaller compressed


def _written(file_format: Any) -> Any:
    """Refuse the format that earlier versions wrote."""
    if file_format == "parquet":
        raise PydanticCustomError("no_parquet", NO_PARQUET)
    return file_format


FormatName = Literal["json", "csv"]
FileFormat = Annotated[FormatName, BeforeValidator(_written)]
