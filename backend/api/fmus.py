"""A controller or a vehicle as an FMU."""

from typing import Annotated

from fastapi import Response

from backend.api import router
from backend.api.deps import Client, service
from backend.fmu.models import FmuRequest
from backend.fmu.service import Fmus
from backend.http.routing import ScenarioRoute

fmus = router("controller", 400, 413, 415, 422, 429, 503, route_class=ScenarioRoute)

FmusService = Annotated[Fmus, service(lambda services: services.fmus)]


@fmus.post(
    "/fmus",
    operation_id="exportFmu",
    response_class=Response,
    responses={
        200: {"content": {"application/zip": {}}, "description": "An FMU: a zip with description, C and binaries"}
    },
)
async def export_fmu(body: FmuRequest, service: FmusService, client: Client) -> Response:
    """A scenario's controller as an FMU for co-simulation, sources inside; 422 with the reason where there is none."""
    content = await service.archive(body, client)
    headers = {"Content-Disposition": f'attachment; filename="ridelab-{body.strategy}.fmu"'}
    return Response(content, headers=headers, media_type="application/zip")
