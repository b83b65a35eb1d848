"""The controller as an ECU's program: its C sources and whether they fit a part; and as an FMU."""

from fastapi import Response

from backend.api.routing import SCENARIO_VALUES, ApiRequest, json_answer, router
from backend.ecu import models
from backend.ecu.export import FOLDER
from backend.errors import GoneError
from backend.fmu.models import FmuRequest

controller = router("controller", 400, 413, 415, 422, 429, 503, computes=True, max_values=SCENARIO_VALUES)
compilers = router("controller")
withdrawn = router("controller", 410)


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
async def export_controller(body: models.ControllerRequest, request: ApiRequest) -> Response:
    """The scenario's `lv_hil` controller as C sources; the same scenario gives the same bytes."""
    content = await request.services.controllers.archive(body.scenario, request.client_id)
    headers = {"Content-Disposition": f'attachment; filename="{FOLDER}.zip"'}
    return Response(content, headers=headers, media_type="application/zip")


@compilers.get("/controller/compilers", operation_id="getCompilers", response_model=models.Compilers, deprecated=True)
async def get_compilers() -> Response:
    """What a report lacks here: nothing, since it needs no compiler any more."""
    return json_answer(models.Compilers(report=None))


@controller.post("/controller/report", operation_id="reportController", response_model=models.ControllerReport)
async def report_controller(body: models.ControllerRequest, request: ApiRequest) -> Response:
    """Whether it fits an STM32F103, and which smaller controllers do; takes some seconds, one at a time."""
    return json_answer(await request.services.controllers.report(body.scenario, request.client_id))


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
async def export_fmu(body: FmuRequest, request: ApiRequest) -> Response:
    """A scenario's controller or vehicle as an FMU, sources inside; 422 with the reason where it cannot be one."""
    content = await request.services.fmus.archive(body, request.client_id)
    name = "vehicle" if body.of == "vehicle" else body.strategy
    headers = {"Content-Disposition": f'attachment; filename="ridelab-{name}.fmu"'}
    return Response(content, headers=headers, media_type="application/zip")
