"""Runs: create, read, drag, search a limit, time histories, figures."""

from typing import Annotated, Any, Literal

from fastapi import Path, Query, Response
from fastapi.responses import HTMLResponse

from backend import models
from backend.api.lists import names_in
from backend.api.routing import SCENARIO_VALUES, ApiRequest, html_answer, json_answer, router
from backend.digest import RUN_ID_LENGTH
from backend.file_formats import BINARY, MEDIA_TYPES, FileFormat
from backend.http.answers import content_answer, revalidated, takes_gzip
from backend.json_types import JsonObject
from backend.requirements import read
from backend.runs.deviations import Deviations
from backend.runs.figures import PANELS
from backend.runs.frequency import FrequencyAnswer, FrequencyRequest
from backend.runs.fuzzy import FuzzyAnswer, FuzzyRequest
from backend.runs.instants import InstantAnswer
from backend.runs.models import (
    Bands,
    CreatedRoadsRun,
    CreatedRun,
    LiveRequest,
    LiveRun,
    PairedChanges,
    RoadsRun,
    Run,
    RunRequest,
)
from backend.runs.solve.models import Solution, SolveRequest
from sim_core.catalogue import SIGNALS

runs = router("runs", 404, 410, 422, 429, 503)
computing = router("runs", 400, 413, 415, 422, 429, 503, computes=True, max_values=SCENARIO_VALUES)
drawing = router("runs", 404, 410, 422, 429, 503, computes=True)

Signals = Annotated[str | None, Query(description="Keys with commas; omitted is all")]
Points = Annotated[
    int | None, Query(ge=2, le=models.MAX_POINTS, description="At most how many samples; omitted is all")
]
RunId = Annotated[str, Path(alias="id", description=f"{RUN_ID_LENGTH} characters", max_length=64)]
Axis = Annotated[Literal["position", "time"], Query(description="What is on the x axis")]
Required = Annotated[
    str | None,
    Query(description="What it is held to: a list of requirements as of `POST /runs`, as JSON", max_length=6000),
]
NOT_CHANGED: dict[int | str, dict[str, Any]] = {304: {"description": "Not changed"}}


@computing.post("/runs", operation_id="createRun", response_model=CreatedRun | CreatedRoadsRun)
async def create_run(body: RunRequest, request: ApiRequest) -> Response:
    """Run what is not stored yet, on one road or several; the answer comes after the commit."""
    work = request.services.runs.create(
        body.scenario,
        body.strategies,
        request.client_id,
        roads=body.roads,
        baseline=body.baseline,
        requirements=body.requirements,
        against=body.against,
    )
    return json_answer(await work)


@computing.post("/live", operation_id="live", response_model=LiveRun, responses={200: {"content": {BINARY: {}}}})
async def live(body: LiveRequest, request: ApiRequest) -> Response:
    """Metrics and decimated time histories while somebody drags; nothing is stored."""
    content = await request.services.runs.live(body, request.client_id)
    return content_answer(content, {}, BINARY if body.encoding == "binary" else MEDIA_TYPES["json"])


@computing.post("/solve", operation_id="solve", response_model=Solution)
async def solve(body: SolveRequest, request: ApiRequest) -> Response:
    """The largest value of one field that keeps one metric at or below a limit, and the run at that value."""
    return json_answer(await request.services.solver.solve(body, request.client_id))


@computing.post("/frequency", operation_id="frequency", response_model=FrequencyAnswer)
async def frequency(body: FrequencyRequest, request: ApiRequest) -> Response:
    """Responses from the road to ride and tyre loads, modes, margins and spectra while no limit binds."""
    return json_answer(await request.services.analysis.frequency(body, request.client_id))


@computing.post("/fuzzy", operation_id="fuzzy", response_model=FuzzyAnswer)
async def fuzzy(body: FuzzyRequest, request: ApiRequest) -> Response:
    """The fuzzy speed controller's sets as curves, its rules written out, and the torque surface they come to."""
    return json_answer(await request.services.analysis.fuzzy(body, request.client_id))


@runs.get("/runs/{id}", operation_id="getRun", response_model=Run | RoadsRun, responses=NOT_CHANGED)
async def get_run(
    run_id: RunId,
    request: ApiRequest,
    requirements: Required = None,
    baseline: Annotated[
        str | None,
        Query(
            description="The strategy that all changes refer to, those of requirements too; omitted is the run's own, "
            "or passive, or the first",
            min_length=1,
            max_length=64,
        ),
    ] = None,
    compare: Annotated[
        str | None,
        Query(description="Ids with commas: which strategies `comparison` is of, beside its baseline; omitted is all"),
    ] = None,
    against: Annotated[
        str | None,
        Query(
            description="Id of a run that the `changes_against` of `comparison` refer to; over several roads it has to "
            "be of the same ones",
            max_length=64,
        ),
    ] = None,
) -> Response:
    """A stored run; its numbers change only where results that are not stored are computed again."""
    work = request.services.runs.get(
        run_id,
        request.client_id,
        requirements=read(requirements),
        baseline=baseline,
        compared=names_in("compare", compare),
        against=against,
    )
    return revalidated(request, await work)


@runs.get("/runs/{id}/changes", operation_id="getChanges", response_model=PairedChanges, responses=NOT_CHANGED)
async def get_changes(
    run_id: RunId,
    request: ApiRequest,
    against: Annotated[str | None, Query(description="Id of a run over the same roads", max_length=64)] = None,
    baseline: Annotated[
        str | None, Query(description="In its place one of this run's strategies", min_length=1)
    ] = None,
) -> Response:
    """Of a run over several roads: changes against another run, strategy by strategy, or a strategy; paired by road."""
    work = request.services.runs.changes(run_id, request.client_id, against=against, baseline=baseline)
    return revalidated(request, await work)


@drawing.get(
    "/runs/{id}/series",
    operation_id="getSeries",
    response_model=models.Series | models.SeriesOfSeveral,
    responses={200: {"content": {"text/csv": {}}}, **NOT_CHANGED},
)
async def get_series(
    run_id: RunId,
    request: ApiRequest,
    strategy: Annotated[str | None, Query(description="Ids with commas; may be omitted where the run has one")] = None,
    signals: Signals = None,
    file_format: Annotated[FileFormat, Query(alias="format", description="Of it")] = "json",
    points: Points = None,
    encoding: Annotated[Literal["list", "base64"], Query(description="Of JSON only")] = "list",
) -> Response:
    """Time histories in SI units; time and position always come along.

    All samples are two at an instant at which a held force jumps: the values before and after.
    """
    names = names_in("strategy", strategy)
    content = await request.services.curves.series(
        run_id,
        request.client_id,
        strategies=names,
        signals=names_in("signals", signals, SIGNALS),
        points=points,
        file_format=file_format,
        encoding=encoding,
    )
    headers = {}
    if file_format != "json":
        headers["Content-Disposition"] = (
            f'attachment; filename="{"-".join(["ridelab", run_id, *(names or [])])}.{file_format}"'
        )
    return revalidated(request, content, headers, MEDIA_TYPES[file_format])


@drawing.get("/runs/{id}/instant", operation_id="getInstant", response_model=InstantAnswer, responses=NOT_CHANGED)
async def get_instant(
    run_id: RunId,
    request: ApiRequest,
    strategy: Annotated[str | None, Query(description="Id; may be omitted where the run has one")] = None,
    position: Annotated[float | None, Query(description="Of the front axle [m]", allow_inf_nan=False)] = None,
    time: Annotated[float | None, Query(description="In place of a position [s]", allow_inf_nan=False)] = None,
) -> Response:
    """What a controller saw and decided in the control step there, which limits shaped it, and at what price."""
    work = request.services.analysis.instant(run_id, strategy, position, time, request.client_id)
    return revalidated(request, await work)


@drawing.get("/runs/{id}/differences", operation_id="getDifferences", response_model=Deviations, responses=NOT_CHANGED)
async def get_differences(
    run_id: RunId,
    request: ApiRequest,
    baseline: Annotated[
        str | None,
        Query(
            description="Strategy or recording that they are against; omitted is passive, or the first", min_length=1
        ),
    ] = None,
) -> Response:
    """How far every strategy's curves lie from one's at the same positions, signal by signal, on the first road."""
    return revalidated(request, await request.services.curves.deviations(run_id, baseline, request.client_id))


@drawing.get("/runs/{id}/bands", operation_id="getBands", response_model=Bands, responses=NOT_CHANGED)
async def get_bands(
    run_id: RunId,
    request: ApiRequest,
    strategy: Annotated[str | None, Query(description="Ids with commas; omitted is all of the run's")] = None,
    signals: Signals = None,
    points: Points = None,
    encoding: Annotated[Literal["list", "base64"], Query(description="Of numbers")] = "list",
) -> Response:
    """Of a run over several roads: mean, smallest and largest value over all roads at each sample, in SI units."""
    content = await request.services.curves.bands(
        run_id,
        request.client_id,
        strategies=names_in("strategy", strategy),
        signals=names_in("signals", signals, SIGNALS),
        points=points,
        encoding=encoding,
    )
    return revalidated(request, content)


@drawing.get("/runs/{id}/figures", operation_id="getRunFigures", response_model=models.Figures)
async def get_run_figures(request: ApiRequest, run_id: RunId, x: Axis = "position") -> Response:
    """Every figure with this run's data."""
    return json_answer(await request.services.curves.figures(run_id, None, x, request.client_id))


@drawing.get("/runs/{id}/figures/{name}", operation_id="getRunFigure", response_model=JsonObject)
async def get_run_figure(
    request: ApiRequest,
    run_id: RunId,
    name: Annotated[str, Path(json_schema_extra={"enum": list(PANELS)}, description="Of the figure")],
    x: Axis = "position",
) -> Response:
    """One figure with this run's data."""
    return json_answer(await request.services.curves.figures(run_id, name, x, request.client_id))


@drawing.get(
    "/runs/{id}/report.html",
    operation_id="getRunReport",
    response_class=HTMLResponse,
    responses={200: {"content": {"text/html": {}}}},
)
async def get_run_report(
    run_id: RunId,
    request: ApiRequest,
    baseline: Annotated[
        str | None, Query(description="Whose figures the changes refer to; omitted is passive", min_length=1)
    ] = None,
    against: Annotated[str | None, Query(description="A run they refer to instead, by strategy", max_length=64)] = None,
    x: Axis = "position",
    requirements: Required = None,
) -> Response:
    """The run as one HTML file that needs nothing else; its figures are inside, or it says why there are none."""
    compressed = takes_gzip(request)
    report = await request.services.reports.report(
        run_id,
        request.client_id,
        baseline=baseline,
        against=against,
        axis=x,
        compressed=compressed,
        requirements=read(requirements),
    )
    return html_answer(report, f"ridelab-{run_id}.html")
