"""Share links: make one, read what it opens."""

from typing import Annotated

from fastapi import Path, Request, Response

from backend.api import router
from backend.api.deps import Client, LinksService
from backend.http.answers import json_answer, revalidated
from backend.http.routing import ComputingRoute
from backend.links import models as models_links

links = router("links", 404, 410, 422, 429, 503)
sharing = router("links", 400, 410, 413, 415, 422, 429, 503, route_class=ComputingRoute)

Slug = Annotated[str, Path(description="22 characters; anything else is 404")]


@sharing.post("/links", operation_id="createLink", response_model=models_links.CreatedLink, status_code=201)
async def create_link(body: models_links.LinkRequest, service: LinksService, client: Client) -> Response:
    """Share a stored run or a batch; the answer comes after the commit."""
    if body.run_id is not None:
        link = await service.share_run(body.run_id, body.view, client, body.requirements)
    else:
        link = await service.share_batch(str(body.batch_id), body.view, client, body.requirements)
    return json_answer(link, {"Location": link.url}, status=201)


@links.get(
    "/links/{slug}",
    operation_id="getLink",
    response_model=models_links.Link,
    responses={304: {"description": "Not changed"}},
)
async def get_link(slug: Slug, request: Request, service: LinksService, client: Client) -> Response:
    """What a link opens: results as they were computed, the scenario as today's schema has it, the view."""
    return revalidated(request, await service.get(slug, client))
