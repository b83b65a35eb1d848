"""Requests that another site's page sends through somebody's browser, or that ask for another host."""

from typing import Any

import httpx
import pytest
from starlette.responses import Response

from backend.http.middleware import RequestMiddleware
from backend.settings import Settings
from tests.api.test_problems import check
from tests.servers.loops import ask


@pytest.mark.parametrize("path", ["batches/nobody/cancel", "tunings/nobody/resume", "runs", "live"])
def test_another_sites_page_changes_nothing(client: httpx.Client, path: str) -> None:
    def post(site: str) -> httpx.Response:
        return client.post(f"/api/v1/{path}", headers={"Sec-Fetch-Site": site})

    check(post("cross-site"), 403, "cross-site")
    for site in ("same-origin", "same-site", "none"):
        assert post(site).status_code in (404, 415)


@pytest.mark.parametrize("origin", ["http://evil.example", "https://127.0.0.1.evil.example", "http://[::", "null", ""])
def test_a_browser_that_says_no_more_than_its_origin_is_believed(client: httpx.Client, origin: str) -> None:
    """Over plain HTTP it sends nothing else, but to this machine."""
    for more in ({}, {"Sec-Fetch-Site": "same-site"}):
        refused = client.post("/api/v1/live", headers={"Origin": origin, **more})
        check(refused, 403, "cross-site")


def test_the_own_page_and_the_hosts_that_are_listed_are_no_other_site(client: httpx.Client) -> None:
    own = f"http://{client.base_url.netloc.decode()}"
    assert client.post("/api/v1/live", headers={"Origin": own}).status_code == 415
    # A proxy that changes the host, such as a development server's: the browser knows better.
    behind = {"Origin": "http://localhost:5173", "Sec-Fetch-Site": "same-origin"}
    assert client.post("/api/v1/live", headers=behind).status_code == 415
    guard = RequestMiddleware(Response("here"), Settings(allowed_hosts="lab.example.com,127.0.0.1").hosts)
    for origin, status in (("https://LAB.example.com", 200), ("http://lab.example.com:81", 200), ("http://x.com", 403)):
        headers = {"Host": "127.0.0.1:8000", "Origin": origin}
        assert ask(guard, "POST", "/", headers=headers).status_code == status


def browsers(mode: str, destination: str, **more: str) -> dict[str, str]:
    """What a browser says of a request that another site's page has it send."""
    return {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": mode, "Sec-Fetch-Dest": destination} | more


def test_another_sites_link_opens(client: httpx.Client) -> None:
    for path in ("/api/v1/schema", "/"):
        assert client.get(path, headers=browsers("navigate", "document")).status_code == 200


@pytest.mark.parametrize(
    "headers",
    [
        browsers("no-cors", "image"),
        browsers("no-cors", "script"),
        browsers("cors", "empty"),
        browsers("navigate", "iframe"),
        browsers("navigate", "document", **{"Sec-Purpose": "prefetch"}),
    ],
    ids=lambda headers: " ".join(list(headers.values())[1:]),
)
def test_another_sites_picture_has_nothing_computed(
    service: Any, headers: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(service.services.paper, "reproduction", asked.append)
    for method in ("GET", "HEAD"):
        refused = service.request(method, "/api/v1/paper", headers=headers)
        assert refused.status_code == 403
    assert not asked
    assert service.get("/", headers=headers).status_code == 200, "the page itself computes nothing"


def test_only_hosts_that_are_listed_are_served() -> None:
    guard = RequestMiddleware(Response("here"), Settings(allowed_hosts="Lab.example.com, *.example.org,::1").hosts)

    def get(path: str, host: str) -> httpx.Response:
        return ask(guard, "GET", path, headers={"Host": host})

    for host in ("lab.example.com", "LAB.example.com:8000", "a.example.org", "a.b.example.org:1", "[::1]:8000"):
        assert get("/", host).status_code == 200
    for host in ("example.com", "example.org", "xlab.example.com", "lab.example.com.evil.example", "[::1", "", "x y"):
        check(get("/", host), 421, "other-host")
        assert get("/healthz", host).status_code == 200, "whoever watches the service asks by address"
