"""Pages of links and batches."""

import httpx
import pytest

from tests.faults.conftest import PAGE, Process


@pytest.fixture(scope="module")
def client(service: Process) -> httpx.Client:
    return service.client


@pytest.mark.parametrize("slug", ["AAAAAAAAAAAAAAAAAAAAAA", "short", "%00", "%3Cscript%3E", "a" * 500, "..%2f..%2fetc"])
def test_a_slug_that_opens_nothing_is_a_page_too(client: httpx.Client, slug: str) -> None:
    page = client.get(f"/s/{slug}")
    assert page.status_code == 404
    if "%2f" not in slug:
        assert page.headers["content-type"] == "text/html; charset=utf-8"
        assert "<title>There is no such link · Ridelab</title>" in page.text
    assert "script>" not in page.text


def test_batches_have_a_page(client: httpx.Client) -> None:
    page = client.get("/b/AAAAAAAAAAAAAAAAAAAAAA")
    assert (page.status_code, page.text) == (200, PAGE)
    assert client.get("/b").status_code == 404
