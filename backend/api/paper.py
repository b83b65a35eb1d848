"""The paper page: tables, interpretations, what each part contributes, figures."""

from typing import Annotated, Any

from fastapi import Query, Response
from fastapi.responses import HTMLResponse

from backend.api.routing import ApiRequest, html_answer, json_answer, router
from backend.http.answers import takes_gzip
from backend.paper import models, queries

paper = router("paper", 422, 429, 503)


ForPage: Any = Annotated[queries.PaperQuery, Query()]
ForReport: Any = Annotated[queries.ReportQuery, Query()]
OverRoads = Annotated[queries.RoadsQuery, Query()]


@paper.get("/paper", operation_id="getPaper", response_model=models.PaperAnswer)
async def get_paper(request: ApiRequest, query: ForPage) -> Response:
    """Every printed change of Tables 4-5 and 7-10 with ours and a verdict; readings by name of a set or singly."""
    answering = request.services.paper.reproduction(
        query.choices(), query.roads, request.client_id, partial=query.partial
    )
    return json_answer(await answering)


@paper.get("/paper/readings", operation_id="getPaperReadings", response_model=models.ReadingsAnswer)
async def get_readings(request: ApiRequest, query: OverRoads) -> Response:
    """What each reading does to the verdicts by itself; ask again while it is not complete."""
    return json_answer(await request.services.paper.readings(query.roads, request.client_id))


@paper.get("/paper/attribution", operation_id="getPaperAttribution", response_model=models.AttributionAnswer)
async def get_attribution(request: ApiRequest, query: OverRoads) -> Response:
    """Preview, weights and speed varied one at a time, and how much of LV's gain each is."""
    return json_answer(await request.services.paper.attribution(query.roads, request.client_id))


@paper.get("/paper/figures", operation_id="getPaperFigures", response_model=models.PaperFigures)
async def get_figures(request: ApiRequest, query: OverRoads) -> Response:
    """Figures 3-6, 8, 10-17 and 19-22 from our own runs."""
    return json_answer(await request.services.paper.figures(query.roads, request.client_id))


@paper.get(
    "/paper/report.html",
    operation_id="getPaperReport",
    response_class=HTMLResponse,
    responses={200: {"content": {"text/html": {}}}},
)
async def get_report(query: ForReport, request: ApiRequest) -> Response:
    """All of this as one HTML file that needs nothing else; each reading may be chosen for its tables."""
    work = request.services.paper.report(
        query.choices(), query.roads, request.client_id, compressed=takes_gzip(request)
    )
    return html_answer(await work, "ridelab-paper.html")
