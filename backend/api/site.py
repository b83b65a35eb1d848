"""The built frontend, the manual and the API's documentation page, from local files only."""

import asyncio
import base64
import contextlib
import hashlib
import mimetypes
import os
import re
from collections.abc import Awaitable, Callable
from functools import lru_cache
from http import HTTPStatus
from pathlib import Path

from fastapi import APIRouter, FastAPI, Request
from fastapi.responses import FileResponse, HTMLResponse, Response
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from backend.errors import NotFoundError, RevokedError
from backend.http.answers import IMMUTABLE
from backend.http.middleware import content_security_policy
from backend.http.problems import RequestError, problem
from backend.http.tokens import CALLER
from backend.links import preview
from backend.links.preview import Preview
from backend.services import Services

DOCS_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Ridelab API</title>
<link rel="stylesheet" href="/docs-assets/swagger-ui.css">
</head>
<body>
<div id="swagger-ui"><p>The OpenAPI description is at <a href="/openapi.json">/openapi.json</a>.</p></div>
<script src="/docs-assets/swagger-ui-bundle.js"></script>
<script src="/docs.js"></script>
</body>
</html>
"""

# A file of its own: the content security policy allows no inline script.
DOCS_SCRIPT = """SwaggerUIBundle({
  url: "/openapi.json",
  dom_id: "#swagger-ui",
  deepLinking: true,
  validatorUrl: null,
  presets: [SwaggerUIBundle.presets.apis, SwaggerUIBundle.SwaggerUIStandalonePreset],
});
"""

# As frontend/src/app/router.tsx has them.
PAGES = (
    "/",
    "/r/{id}",
    "/b/{id}",
    "/sweeps",
    "/paper",
    "/robustness",
    "/robustness/{id}",
    "/tuner",
    "/tuner/{id}",
    "/ecu",
)


NO_PAGES = ("/api/", "/assets/", "/docs-assets/")
_INLINE_SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)


class HashedFiles(StaticFiles):
    """Files whose names hold their content's hash: a browser may keep them for ever.

    Where the build left a file's brotli form beside it, browsers that take it get that.
    """

    async def get_response(self, path: str, scope: Scope) -> Response:
        """The framework's response, immutable."""
        if path.endswith(".br"):
            raise HTTPException(HTTPStatus.NOT_FOUND)  # a form of another file, without an address of its own
        response: Response | None = None
        if _takes_brotli(Headers(scope=scope).get("accept-encoding", "")):
            with contextlib.suppress(HTTPException):  # there is no such form: the file as it is
                response = await super().get_response(f"{path}.br", scope)
        if response is None:
            response = await super().get_response(path, scope)
        elif response.status_code == HTTPStatus.OK:
            response.headers["Content-Type"] = mimetypes.guess_type(path)[0] or "application/octet-stream"
            response.headers["Content-Encoding"] = "br"
        response.headers["Cache-Control"] = IMMUTABLE
        response.headers.add_vary_header("Accept-Encoding")
        return response


class ManualPages(StaticFiles):
    """The manual. Its pages run the scripts inside them, by their hashes."""

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        """The framework's response, looked for again each time."""
        response = super().file_response(full_path, stat_result, scope, status_code)
        response.headers["Cache-Control"] = "no-cache"
        if str(full_path).endswith(".html"):
            response.headers["Content-Security-Policy"] = content_security_policy(
                _inline_scripts(str(full_path), stat_result.st_mtime)
            )
        return response


@lru_cache(512)
def _inline_scripts(path: str, _: float) -> tuple[str, ...]:
    """Hashes of a page's scripts, as a content security policy names them."""
    scripts = _INLINE_SCRIPT.findall(Path(path).read_text(encoding="utf-8"))
    hashes = (base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts)
    return tuple(f"'sha256-{each}'" for each in hashes)


def _takes_brotli(accepted: str) -> bool:
    """Check whether `br` is in an Accept-Encoding, and not with a weight of 0."""
    refused = r"q=0(\.0*)?"
    codings = [[part.strip().lower() for part in coding.split(";")] for coding in accepted.split(",")]
    return any(name == "br" and not any(re.fullmatch(refused, each) for each in rest) for name, *rest in codings)


def add_site(app: FastAPI, dist: Path, manual: Path) -> None:
    """Serve the frontend in `dist` at its pages' addresses and `/s/{slug}`, the manual, the API's page at `/docs`."""
    site = APIRouter(include_in_schema=False)
    index = dist / "index.html"

    async def page() -> Response:
        _check_built(index)
        return FileResponse(index, headers={"Cache-Control": "no-cache"})

    for path in PAGES:
        site.add_api_route(path, page, methods=["GET"])

    @site.get("/s/{slug}")
    async def shared(slug: str, request: Request) -> Response:
        _check_built(index)
        services: Services = request.app.state.services
        if services.tokens is not None and getattr(request.state, CALLER, None) is None:
            return await page()  # which asks for a token; nothing of what is shared is in it
        try:
            of_link, status = await services.links.preview(slug), HTTPStatus.OK
        except NotFoundError:
            of_link, status = Preview(), HTTPStatus.NOT_FOUND
        except RevokedError:
            of_link, status = Preview(title="This link was taken back"), HTTPStatus.GONE
        text = preview.page(index.read_text(encoding="utf-8"), of_link, shared=status == HTTPStatus.OK)
        return HTMLResponse(text, status, {"Cache-Control": "no-cache", "X-Robots-Tag": "noindex"})

    @site.get("/docs")
    async def docs() -> Response:
        return HTMLResponse(DOCS_PAGE, headers={"Cache-Control": "no-cache"})

    @site.get("/docs.js")
    async def docs_script() -> Response:
        return Response(DOCS_SCRIPT, headers={"Cache-Control": "no-cache"}, media_type="text/javascript")

    for file in sorted(dist.glob("*.*")):
        if file.name != "index.html":
            site.add_api_route(f"/{file.name}", _file(file), methods=["GET"])
    app.include_router(site)
    _add_not_found(app, index)
    files = {
        "/assets": HashedFiles(directory=dist / "assets", check_dir=False),
        "/docs-assets": StaticFiles(directory=dist / "docs-assets", check_dir=False),
        "/manual": ManualPages(directory=manual, html=True, check_dir=False),
    }
    for address, each in files.items():
        each.config_checked = True  # a folder that is not built yet has no files: 404 instead of 500
        app.mount(address, each)


def _add_not_found(app: FastAPI, index: Path) -> None:
    """Answer a browser at an unknown address with the page, which says so; anything else gets a problem."""

    async def not_found(request: Request, _: Exception) -> Response:
        is_page = not request.url.path.startswith(NO_PAGES) and "text/html" in request.headers.get("accept", "")
        if request.method == "GET" and is_page and await asyncio.to_thread(index.is_file):
            return FileResponse(index, 404, headers={"Cache-Control": "no-cache", "Vary": "Accept"})
        return problem("not-found")

    app.add_exception_handler(404, not_found)


def _check_built(index: Path) -> None:
    if not index.is_file():
        raise RequestError("not-built", "The dashboard is not built: make setup builds it. The API answers.")


def _file(path: Path) -> Callable[[], Awaitable[Response]]:
    async def serve() -> Response:
        return FileResponse(path, headers={"Cache-Control": "no-cache"})

    return serve
