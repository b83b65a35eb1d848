"""The controller as an ECU's program: its C sources and whether they fit a part; and as an FMU."""

from typing import Annotated

from fastapi import Response

from backend.api import router
from backend.api.deps import Client, service
from backend.ecu import models
from backend.ecu.export import FOLDER
from backend.ecu.service import Controllers
from backend.errors import GoneError
from backend.fmu.models import FmuRequest
from backend.fmu.service import Fmus
from backend.http.answers import json_answer
from backend.http.routing import ScenarioRoute

controller = router("controller", 400, 413, 415, 422, 429, 503, route_class=ScenarioRoute)
compilers = router("controller")
withdrawn = router("controller", 410)

ControllersService = Annotated[Controllers, service(lambda services: services.controllers)]
FmusService = Annotated[Fmus, service(lambda services: services.fmus)]

NO_CLOCK = (
    "There is no drive by the clock any more: an ordinary system's times say nothing about an ECU. "
    "POST /api/v1/controller/report has a step's time on the ECU's own processor; "
    "hil.jitter and hil.packet_loss of a scenario show what late and lost answers do."
)


@controller.post(
    "/controller",
    operation_id="exportController",
    response_class=Response,
    responses={200: {"content": {"application/zip": {}}, "description": "A zip with README, Makefile and C sources"}},
)
async def export_controller(body: models.ControllerRequest, service: ControllersService, client: Client) -> Response:
    """The scenario's `lv_hil` controller as C sources; the same scenario gives the same bytes."""
    content = await service.archive(body.scenario, client)
    headers = {"Content-Disposition": f'attachment; filename="{FOLDER}.zip"'}
    return Response(content, headers=headers, media_type="application/zip")


@compilers.get("/controller/compilers", operation_id="getCompilers", response_model=models.Compilers)
async def get_compilers(service: ControllersService) -> Response:
    """Whether the ECU's program can be built here, known before a report is asked for."""
    return json_answer(service.compilers())


@controller.post("/controller/report", operation_id="reportController", response_model=models.ControllerReport)
async def report_controller(body: models.ControllerRequest, service: ControllersService, client: Client) -> Response:
    """Whether it fits an STM32F103, and which smaller controllers do; takes about ten seconds, one at a time."""
    return json_answer(await service.report(body.scenario, client))


@withdrawn.post("/controller/realtime", operation_id="driveByClock", deprecated=True)
async def drive_by_clock() -> Response:
    """Nothing any more: always 410, with what to use instead."""
    raise GoneError(NO_CLOCK, kind="withdrawn")


@controller.post(
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
