"""Recorded drives: upload as CSV, read, export, list, take back."""

import json
from typing import Annotated, Literal

from fastapi import Path, Query, Response

from backend.api.lists import DEFAULT_LIMIT, Cursor, Limit, Owner
from backend.api.routing import API, TABLE_FILES, ApiRequest, router
from backend.api.tables import DRY_RUN, DryRun, TableParameter, described
from backend.errors import InvalidError
from backend.http import problems
from backend.http.answers import revalidated
from backend.http.openapi import BYTES
from backend.recordings.models import CreatedRecording, RecordingAnswer, RecordingPage
from backend.tables import parse_table
from sim_core.tables.titles import unit_in

reading = router("recordings", 408, 413, 415, 422, 429, 503, files=TABLE_FILES)
recordings = router("recordings", 404, 429, 503, computes=True)
listing = router("recordings", 403, 422, 503)
EXAMPLE = "time [s],body_acceleration [m/s^2]\n" + "".join(f"{n / 100},{n % 3 - 1}\n" for n in range(12))
BODY = {"requestBody": {"required": True, "content": {"text/csv": {"schema": BYTES, "example": EXAMPLE}}}}
LONGEST_MAPPING = 8000

RecordingId = Annotated[str, Path(alias="id", max_length=64, description="Of the recording")]
ColumnMapping = Annotated[
    str | None,
    Query(
        max_length=LONGEST_MAPPING,
        description='JSON: by name of a column its signal with the unit, `{"acc_z": "body_acceleration [g]"}`, or an '
        "empty text to leave it out; others are read by their own names",
    ),
]


@reading.post(
    "/recordings",
    operation_id="createRecording",
    status_code=201,
    response_model=CreatedRecording,
    responses=DRY_RUN,
    openapi_extra=BODY,
)
async def create_recording(
    request: ApiRequest,
    response: Response,
    columns: ColumnMapping = None,
    table: TableParameter = None,
    dry_run: DryRun = False,
) -> CreatedRecording | Response:
    """Store a recorded drive: a table of time or distance and signals of the catalogue.

    What its columns mean is found, or asked by a 422 `table-unsure`; `dry_run` answers how it would be read.
    """
    corrections = parse_table(table) or {}
    if columns:
        corrections["columns"] = [*corrections.get("columns", []), *_columns(columns)]
    content, services = await request.content(), request.services
    if dry_run:
        return described(await services.tables.described(request.client_id, content, corrections))
    created = await services.recordings.create(content, corrections, request.client_id, request.token)
    response.headers["Location"] = f"{API}/recordings/{created.id}"
    return created


@listing.get("/recordings", operation_id="listRecordings", response_model=RecordingPage)
async def list_recordings(
    request: ApiRequest, owner: Owner, limit: Limit = DEFAULT_LIMIT, cursor: Cursor = None
) -> RecordingPage:
    """The newest first, page by page: with tokens one's own, without them for the service's one person."""
    return await request.services.recordings.page(owner, limit, cursor)


@listing.delete(
    "/recordings/{id}",
    operation_id="deleteRecording",
    status_code=204,
    responses={404: problems.ANSWER, 409: problems.ANSWER},
)
async def delete_recording(request: ApiRequest, owner: Owner, recording: RecordingId) -> Response:
    """Take a recording back that no run or link names; one that another token sent too stays for that one."""
    await request.services.recordings.delete(recording, owner)
    return Response(status_code=204)


@recordings.get(
    "/recordings/{id}",
    operation_id="getRecording",
    response_model=RecordingAnswer,
    responses={200: {"content": {"text/csv": {}}}, 304: {"description": "Not changed"}},
)
async def get_recording(
    request: ApiRequest,
    recording: RecordingId,
    file_format: Annotated[
        Literal["json", "csv"], Query(alias="format", description="CSV has every sample and can be sent again")
    ] = "json",
) -> RecordingAnswer | Response:
    """A recorded drive; its samples never change."""
    if file_format == "json":
        return await request.services.recordings.get(recording, request.client_id)
    name = f"ridelab-recording-{recording}.csv"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return revalidated(
        request, await request.services.recordings.csv(recording, request.client_id), headers, "text/csv"
    )


def _columns(text: str) -> list[dict[str, str | None]]:
    try:
        mapping = json.loads(text)
    except (ValueError, RecursionError):
        mapping = None
    if not isinstance(mapping, dict) or not all(isinstance(value, str) for value in mapping.values()):
        raise InvalidError("This has to be JSON: by name of a column its signal with the unit", parameter="columns")
    parts = {title: unit_in(said, "1") for title, said in mapping.items()}
    return [{"title": title, "means": means, "unit": unit or None} for title, (means, unit) in parts.items()]
