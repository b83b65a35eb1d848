"""An address has the parameters its route declares, each once: what is misspelt is said, not passed over."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest


@pytest.fixture(scope="module")
def operations(client: httpx.Client) -> list[tuple[str, str, list[str]]]:
    """Method, address and parameters of everything below /api/v1."""
    return list(listed(client.get("/openapi.json").json()["paths"]))


def listed(paths: dict[str, Any]) -> Iterator[tuple[str, str, list[str]]]:
    for path, methods in paths.items():
        for method, operation in methods.items():
            if path.startswith("/api/v1/"):
                names = [item["name"] for item in operation.get("parameters", []) if item["in"] == "query"]
                yield method, path.replace("{", "").replace("}", ""), names


def refused(client: httpx.Client, method: str, path: str, query: str) -> list[dict[str, Any]]:
    response = client.request(method, f"{path}?{query}", headers={"Content-Type": "application/json"})
    assert response.status_code == 422, (path, query, response.text)
    assert response.json()["type"] == "urn:problem-type:ridelab:invalid-request"
    errors: list[dict[str, Any]] = response.json()["errors"]
    return errors


def test_every_route_refuses_what_it_does_not_know(client: httpx.Client, operations: Any) -> None:
    assert len(operations) > 30
    for method, path, names in operations:
        (error,) = refused(client, method, path, "no_such=1")
        assert (error["parameter"], error["pointer"]) == ("no_such", "")
        assert error["message"] == f"Unknown parameter no_such; there are {', '.join(names) or 'none'}"


def test_every_parameter_may_be_there_once(client: httpx.Client, operations: Any) -> None:
    assert {name for _, _, names in operations for name in names} > {"format", "limit", "window", "seeds", "x"}
    for method, path, names in operations:
        for name in names:
            (error,) = refused(client, method, path, f"{name}=1&{name}=1")
            assert (error["parameter"], error["message"]) == (name, "This parameter is there twice")


def test_several_wrong_ones_are_told_at_once_with_what_they_may_mean(client: httpx.Client) -> None:
    errors = refused(client, "GET", "/api/v1/runs/x/series", "formt=csv&limit=3&%3Cb%3E=1")
    assert [error.get("parameter") for error in errors] == ["formt", "limit", None]
    assert errors[0]["message"].startswith("Unknown parameter formt, perhaps format; there are strategy, ")
    assert errors[2]["message"].startswith("Unknown parameter; there are ")
    assert len(refused(client, "GET", "/api/v1/schema", "&".join(f"k{i}=" for i in range(1000)))) == 50


def test_pages_and_files_take_any(client: httpx.Client) -> None:
    for path in ("/r/AAAAAAAAAAAAAAAAAAAAAA", "/docs", "/openapi.json", "/healthz", "/readyz", "/metrics"):
        assert client.get(path, params={"utm_source": "mail"}).status_code == client.get(path).status_code < 400
