"""What routes share that take tables of measurements."""

from typing import Annotated, Any

from fastapi import Query, Response

from backend.table_models import DescribedTable

LONGEST_TABLE = 16_384  # characters of corrections

TableParameter = Annotated[
    str | None,
    Query(
        max_length=LONGEST_TABLE,
        description="JSON: what is said of the table in place of what is found: a dry run's answer, or parts of it",
    ),
]
DryRun = Annotated[bool, Query(description="Store nothing: answer 200 with how the file would be read, and as what")]
DRY_RUN: dict[int | str, dict[str, Any]] = {200: {"model": DescribedTable, "description": "Of a dry run"}}


def described(found: Any) -> Response:
    """Return the answer of a dry run."""
    answer = DescribedTable.model_validate(found)
    return Response(answer.model_dump_json(by_alias=True), media_type="application/json")
