"""What routes need from the application, and how they answer."""

from typing import Annotated, Any

from fastapi import Depends, Request, Response
from fastapi.responses import HTMLResponse

from backend.http.routing import client_of
from backend.links.service import Links
from backend.runs.reports.page import Report
from backend.runs.service import Runs
from backend.runs.solve.service import Solver


def service(name: str) -> Any:
    """The dependency that gives a route this part of the application."""

    async def part(request: Request) -> Any:
        return getattr(request.app.state, name)

    return Depends(part)


async def _client(request: Request) -> str:
    return client_of(request)


RunsService = Annotated[Runs, service("runs")]
SolverService = Annotated[Solver, service("solver")]
LinksService = Annotated[Links, service("links")]
Client = Annotated[str, Depends(_client)]


def html_answer(report: Report, name: str) -> Response:
    """A report under its own content security policy, shown by the browser or saved under that file name."""
    headers = {**report.headers, "Cache-Control": "no-cache", "Content-Disposition": f'inline; filename="{name}"'}
    return HTMLResponse(report.content, headers=headers)
