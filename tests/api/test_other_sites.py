"""Requests that another site's page sends through somebody's browser, or that ask for another host."""

import httpx
import pytest
from starlette.responses import Response

from backend.http.guard import GuardMiddleware
from backend.settings import Settings
from tests.api.test_problems import check
from tests.servers import loops


@pytest.mark.parametrize("path", ["batches/nobody/cancel", "tunings/nobody/resume", "runs", "live"])
def test_another_sites_page_changes_nothing(client: httpx.Client, path: str) -> None:
    def post(site: str) -> httpx.Response:
        return client.post(f"/api/v1/{path}", headers={"Sec-Fetch-Site": site})

    check(post("cross-site"), 403, "cross-site")
    for site in ("same-origin", "same-site", "none"):
        assert post(site).status_code in (404, 415)


def test_another_sites_link_opens(client: httpx.Client) -> None:
    assert client.get("/api/v1/schema", headers={"Sec-Fetch-Site": "cross-site"}).status_code == 200


def test_only_hosts_that_are_listed_are_served() -> None:
    guard = GuardMiddleware(Response("here"), Settings(allowed_hosts="Lab.example.com, *.example.org,::1").hosts)

    def get(path: str, host: str) -> httpx.Response:
        async def answer() -> httpx.Response:
            async with httpx.AsyncClient(transport=httpx.ASGITransport(guard), base_url="http://x") as client:
                return await client.get(path, headers={"Host": host})

        return loops.run(answer)

    for host in ("lab.example.com", "LAB.example.com:8000", "a.example.org", "a.b.example.org:1", "[::1]:8000"):
        assert get("/", host).status_code == 200
    for host in ("example.com", "example.org", "xlab.example.com", "lab.example.com.evil.example", "[::1", "", "x y"):
        check(get("/", host), 421, "other-host")
        assert get("/healthz", host).status_code == 200, "whoever watches the service asks by address"
