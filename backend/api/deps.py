"""What routes need from the application, and how they answer."""

from typing import Annotated

from fastapi import Depends, Request, Response
from fastapi.responses import HTMLResponse

from backend.http.routing import client_address
from backend.runs.links.service import Links
from backend.runs.reports.page import Report
from backend.runs.service import Runs


async def _runs(request: Request) -> Runs:
    service: Runs = request.app.state.runs
    return service


async def _links(request: Request) -> Links:
    service: Links = request.app.state.links
    return service


async def _client(request: Request) -> str:
    return client_address(request)


RunsService = Annotated[Runs, Depends(_runs)]
LinksService = Annotated[Links, Depends(_links)]


Client = Annotated[str, Depends(_client)]


def html_answer(report: Report, name: str) -> Response:
    """A report under its own content security policy, to be read or kept under that file name."""
    headers = {**report.headers, "Cache-Control": "no-cache", "Content-Disposition": f'inline; filename="{name}"'}
    return HTMLResponse(report.content, headers=headers)
