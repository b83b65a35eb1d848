"""Measured roads: upload as CSV, read, and export."""

from typing import Annotated, Literal

from fastapi import Path, Query, Request, Response

from backend.api import API, router
from backend.api.deps import Client, service
from backend.http.answers import IMMUTABLE
from backend.http.openapi import BYTES
from backend.http.routing import ComputingRoute, CsvRoute
from backend.models import MAX_POINTS
from backend.roads.models import CreatedRoad, RoadAnswer
from backend.roads.service import MeasuredRoads

surveying = router("roads", 408, 413, 415, 429, 503, route_class=CsvRoute)
roads = router("roads", 404, 429, 503, route_class=ComputingRoute)
EXAMPLE = "distance [m],height [mm]\n0,0\n5,12\n10,3\n"


RoadsService = Annotated[MeasuredRoads, service(lambda services: services.roads)]


@surveying.post(
    "/roads",
    operation_id="createRoad",
    status_code=201,
    response_model=CreatedRoad,
    openapi_extra={"requestBody": {"required": True, "content": {"text/csv": {"schema": BYTES, "example": EXAMPLE}}}},
)
async def create_road(request: Request, response: Response, service: RoadsService, client: Client) -> CreatedRoad:
    """Store a measured profile: distance and height, or left and right height, each column's unit in the header."""
    created = await service.create(await request.body(), client)
    response.headers["Location"] = f"{API}/roads/{created.id}"
    return created


@roads.get(
    "/roads/{id}",
    operation_id="getRoad",
    response_model=RoadAnswer,
    responses={200: {"content": {"text/csv": {}}}},
)
async def get_road(
    service: RoadsService,
    client: Client,
    road_id: Annotated[str, Path(alias="id", max_length=64, description="Of the road")],
    points: Annotated[int, Query(ge=2, le=MAX_POINTS, description="Of JSON: about how many heights")] = 2000,
    file_format: Annotated[
        Literal["json", "csv"], Query(alias="format", description="CSV has every height and can be sent again")
    ] = "json",
) -> RoadAnswer | Response:
    """A measured road; it never changes."""
    if file_format == "json":
        return await service.get(road_id, points, client)
    headers = {"Content-Disposition": f'attachment; filename="ridelab-road-{road_id}.csv"', "Cache-Control": IMMUTABLE}
    return Response(await service.csv(road_id, client), headers=headers, media_type="text/csv")
