"""Share links: make one, read what it opens, list them, take one back."""

from typing import Annotated

from fastapi import Path, Request, Response

from backend.api.lists import DEFAULT_LIMIT, Cursor, Limit, Owner
from backend.api.routing import API, ApiRequest, json_answer, router
from backend.http import problems
from backend.http.answers import revalidated
from backend.links import models as models_links

links = router("links", 404, 410, 422, 429, 503)
listing = router("links", 403, 422, 503)
sharing = router("links", 400, 410, 413, 415, 422, 429, 503, computes=True)

Slug = Annotated[str, Path(description="22 characters; anything else is 404")]


@sharing.post("/links", operation_id="createLink", response_model=models_links.CreatedLink, status_code=201)
async def create_link(body: models_links.LinkRequest, request: ApiRequest) -> Response:
    """Share a stored run or a batch; the answer comes after the commit."""
    slug, series_pinned = await request.services.links.create(body, request.client_id, request.token)
    answer = {"slug": slug, "url": _url(request, slug), "series_pinned": series_pinned}
    return json_answer(answer, {"Location": f"{API}/links/{slug}"}, status=201)


@listing.get("/links", operation_id="listLinks", response_model=models_links.LinkPage)
async def list_links(
    request: ApiRequest, owner: Owner, limit: Limit = DEFAULT_LIMIT, cursor: Cursor = None
) -> Response:
    """The newest first, page by page: with tokens one's own, without them for the service's one person."""
    found, following = await request.services.links.page(owner, limit, cursor)
    rows = [{**each, "url": _url(request, each["slug"])} for each in found]
    return json_answer(models_links.LinkPage(links=rows, next=following))


@links.get(
    "/links/{slug}",
    operation_id="getLink",
    response_model=models_links.Link,
    responses={304: {"description": "Not changed"}},
)
async def get_link(slug: Slug, request: ApiRequest) -> Response:
    """What a link opens: results as they were computed, the scenario as today's schema has it, the view."""
    return revalidated(
        request, {**await request.services.links.get(slug, request.client_id), "url": _url(request, slug)}
    )


@links.delete("/links/{slug}", operation_id="revokeLink", status_code=204, responses={403: problems.ANSWER})
async def revoke_link(request: ApiRequest, slug: Slug, owner: Owner) -> Response:
    """Take a link back: from then on it is 410 to everybody, and what it has pinned is gone."""
    await request.services.links.revoke(slug, owner)
    return Response(status_code=204)


def _url(request: Request, slug: str) -> str:
    """Return the address of a link's page, at the name and by the scheme of the request."""
    return f"{request.base_url}s/{slug}"
