"""Measured roads: upload as CSV or OpenCRG, read, export, list, take back."""

from typing import Annotated, Literal

from fastapi import Path, Query, Response

from backend.api.lists import DEFAULT_LIMIT, Cursor, Limit, Owner
from backend.api.routing import API, TABLE_FILES, ApiRequest, router
from backend.api.tables import DRY_RUN, DryRun, TableParameter, described
from backend.errors import InvalidError
from backend.http import problems
from backend.http.answers import revalidated
from backend.http.openapi import BYTES
from backend.models import MAX_POINTS
from backend.roads import export, opencrg, survey
from backend.roads.models import CreatedRoad, RoadAnswer, RoadPage
from backend.tables import parse_table

OPENCRG = "application/x-opencrg"
LONGEST_GRID = 16 * 1024 * 1024  # of an OpenCRG file [bytes]
FAR = 100.0  # from the reference line [m]


surveying = router("roads", 408, 413, 415, 429, 503, files={**TABLE_FILES, OPENCRG: LONGEST_GRID})
roads = router("roads", 404, 429, 503, computes=True)
listing = router("roads", 403, 422, 503)
EXAMPLE = "distance [m],height [mm]\n0,0\n5,12\n10,3\n"


RoadId = Annotated[str, Path(alias="id", max_length=64, description="Of the road")]


@surveying.post(
    "/roads",
    operation_id="createRoad",
    status_code=201,
    response_model=CreatedRoad,
    responses=DRY_RUN,
    openapi_extra={
        "requestBody": {
            "required": True,
            # A client by openapi-python-client sends files as the last type named.
            "content": {OPENCRG: {"schema": BYTES}, "text/csv": {"schema": BYTES, "example": EXAMPLE}},
        }
    },
)
async def create_road(
    request: ApiRequest,
    response: Response,
    left: Annotated[float | None, Query(ge=-FAR, le=FAR, description="Of OpenCRG: v of the left wheel [m]")] = None,
    right: Annotated[float | None, Query(ge=-FAR, le=FAR, description="Of OpenCRG: v of the right wheel [m]")] = None,
    table: TableParameter = None,
    dry_run: DryRun = False,
) -> CreatedRoad | Response:
    """Store a measured profile: a table of distance and height, or left and right height, or an OpenCRG file.

    What a table's columns mean is found, or asked by a 422 `table-unsure`; `dry_run` answers how it would be read. Of
    OpenCRG two wheel tracks are taken, 0.75 m left and right of the reference line if `left` and `right` say no other.
    """
    content, corrections, services = await request.content(), parse_table(table), request.services
    if request.headers["content-type"].lower().startswith(OPENCRG):
        if dry_run or corrections:
            raise InvalidError("An OpenCRG file says itself what it holds", parameter="dry_run" if dry_run else "table")
        created = await services.roads.create(request.client_id, request.token, opencrg.read, content, left, right)
    elif left is None and right is None:
        if dry_run:
            return described(await services.tables.described(request.client_id, content, corrections))
        created = await services.roads.create(request.client_id, request.token, survey.read, content, corrections)
    else:
        raise InvalidError("Only an OpenCRG file has wheels to place", parameter="right" if left is None else "left")
    response.headers["Location"] = f"{API}/roads/{created.id}"
    return created


@listing.get("/roads", operation_id="listRoads", response_model=RoadPage)
async def list_roads(
    request: ApiRequest, owner: Owner, limit: Limit = DEFAULT_LIMIT, cursor: Cursor = None
) -> RoadPage:
    """The newest first, page by page: with tokens one's own, without them for the service's one person."""
    return await request.services.roads.page(owner, limit, cursor)


@listing.delete(
    "/roads/{id}", operation_id="deleteRoad", status_code=204, responses={404: problems.ANSWER, 409: problems.ANSWER}
)
async def delete_road(request: ApiRequest, owner: Owner, road_id: RoadId) -> Response:
    """Take a road back that no run, job or link names; one that another token sent too stays for that one."""
    await request.services.roads.delete(road_id, owner)
    return Response(status_code=204)


@roads.get(
    "/roads/{id}",
    operation_id="getRoad",
    response_model=RoadAnswer,
    responses={200: {"content": {"text/csv": {}, OPENCRG: {}}}, 304: {"description": "Not changed"}},
)
async def get_road(
    request: ApiRequest,
    road_id: RoadId,
    points: Annotated[int, Query(ge=2, le=MAX_POINTS, description="Of JSON: at most how many heights")] = 2000,
    file_format: Annotated[
        Literal["json", "csv", "crg"],
        Query(alias="format", description="CSV and OpenCRG have every height and can be sent again"),
    ] = "json",
    encoding: Annotated[Literal["binary", "text"], Query(description="Of OpenCRG: of its values")] = "binary",
) -> RoadAnswer | Response:
    """A measured road; its heights never change."""
    if file_format == "json":
        return await request.services.roads.get(road_id, points, request.client_id)
    name, media_type = f"ridelab-road-{road_id}.{file_format}", "text/csv" if file_format == "csv" else OPENCRG
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    writers = {"csv": export.as_csv, "crg": opencrg.as_text if encoding == "text" else opencrg.as_binary}
    content = await request.services.roads.exported(road_id, request.client_id, writers[file_format])
    return revalidated(request, content, headers, media_type)
