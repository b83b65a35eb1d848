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
    """A scenario's controller or vehicle as an FMU, sources inside; 422 with the reason where it cannot be one."""
    content = await service.archive(body, client)
    name = "vehicle" if body.of == "vehicle" else body.strategy
    headers = {"Content-Disposition": f'attachment; filename="ridelab-{name}.fmu"'}
    return Response(content, headers=headers, media_type="application/zip")
