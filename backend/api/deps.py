"""What routes need from the application, and how they answer."""

from collections.abc import Callable
from typing import Annotated, Any

from fastapi import Depends, Request, Response
from fastapi.responses import HTMLResponse

from backend.http.routing import client_of
from backend.links.service import Links
from backend.runs.reports.page import Report
from backend.services import Services, services_of


def service(pick: Callable[[Services], object]) -> Any:
    """The dependency that gives a route one of the services."""

    async def picked(request: Request) -> object:
        return pick(services_of(request))

    return Depends(picked)


async def _client(request: Request) -> str:
    return client_of(request)


LinksService = Annotated[Links, service(lambda services: services.links)]
Client = Annotated[str, Depends(_client)]


def html_answer(report: Report, name: str) -> Response:
    """A report under its own content security policy, shown by the browser or saved under that file name."""
    headers = {**report.headers, "Cache-Control": "no-cache", "Content-Disposition": f'inline; filename="{name}"'}
    return HTMLResponse(report.content, headers=headers)
