"""Requests are read strictly: bodies and parameters on every route, and an error names the field."""

import contextlib
import gzip
import json
import socket
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.api import routing
from backend.http.problems import RequestError
from backend.http.strict_json import MAX_MEMBERS, parse
from tests.api.test_problems import check
from tests.servers.process import wait_until

JSON = {"Content-Type": "application/json"}
GOOD = b'{"strategies": ["passive"]}'


def post(client: httpx.Client, body: Any, path: str = "runs", **headers: str) -> httpx.Response:
    return client.post(f"/api/v1/{path}", content=body, headers={**JSON, **headers})


def scenario(text: str) -> str:
    return f'{{"strategies": ["passive"], "scenario": {text}}}'


def test_every_route_of_the_api_is_strict(service: Any) -> None:
    """The refusals below hold on every route."""
    routers = [router for each in service.app.routes if (router := getattr(each, "original_router", None)) is not None]
    routes = [route for router in routers for route in router.routes if route.path.startswith("/api/")]
    assert len(routes) > 30
    assert all(isinstance(route, routing.StrictRoute) for route in routes)


@pytest.mark.parametrize(
    ("status", "texts"),
    [
        (200, ['{"a": [1, -0.5, "\\ud83d\\ude00", {}, []]}', "9" * 19, f'"{"9" * 500}"', "[" * 32 + "]" * 32]),
        (400, ["", "{", "{} {}", "{'a': 1}", "\ufeff{}", "[" * 9_000, "[" * 33 + "]" * 33, '"\x01"']),
        (413, ["[" + ",".join([unit] * 300_000) + "]" for unit in ("1", "{}", '{"a":1}')]),
        (422, ['{"a": 1, "a": 2}', '{"a": {"b": 1, "b": 2}}', "NaN", "Infinity", "[-Infinity]", "1e999", "9" * 400]),
        (422, [r'{"a": 1, "\u0061": 2}', r'[{"a": 1, "a": "\u003a"}]', '[{"a": ":"}, {"b": 1, "b": 2}]']),
        (200, ['[2.0, -0.0, 1e2, 0.5, {"a.0,": 1.0}]', "[9007199254740993.0, 1e16]", '{"": {"b": 1}, "a": {"b": 1}}']),
        (422, ["9" * 5_000, "-" + "9" * 900_000, r'"\ud800"', r'{"\uDFFF": 1}', r'"\ude00\ud83d"']),
        (422, ["{" + ",".join(f'"{index}":1' for index in range(MAX_MEMBERS + 1)) + "}"]),
    ],
)
def test_json_is_read_in_one_way_or_not_at_all(status: int, texts: list[str]) -> None:
    for text in texts:
        try:
            value = parse(text.encode())
            assert value == json.loads(text)
            assert not any(
                isinstance(each, float) and each.is_integer() and each < 2**53
                for each in (value if isinstance(value, list) else [])
            )
            answered_status = 200
        except RequestError as error:
            answered_status = error.status or 0
        assert answered_status == status, text[:40]


@given(st.binary(max_size=200))
def test_any_bytes_are_a_value_or_an_error(body: bytes) -> None:
    with contextlib.suppress(RequestError):
        assert parse(body) == json.loads(body)


def test_errors_are_reported_together_but_not_thousands(client: httpx.Client) -> None:
    body = scenario('{"road": {"length": 1, "seed": -1}, "vehicle": {"body_mass": "heavy"}}')
    twice = check(post(client, scenario('{"road": {"seed": 1, "seed": 2}}')), 422, "strict-json")
    assert [error.pointer for error in twice.errors] == [""]
    pointers = {error["pointer"] for error in post(client, body).json()["errors"]}
    assert {"/scenario/road/length", "/scenario/road/seed", "/scenario/vehicle/body_mass"} <= pointers
    parts = {part: {f"k{index}": index for index in range(200)} for part in ("road", "mpc", "lqr", "vehicle", "speed")}
    response = post(client, scenario(json.dumps(parts)))
    assert len(response.json()["errors"]) == 50
    assert len(response.content) < 100_000


def test_a_body_has_only_so_many_bytes_and_a_scenario_so_many_values(client: httpx.Client) -> None:
    whole = GOOD[:-1] + b" " * 1_100_000 + b"}"
    for body in (whole, (whole[start : start + 65536] for start in range(0, len(whole), 65536))):
        check(post(client, body), 413, "too-long")
    many = check(post(client, scenario('{"lqr": {"weights": [' + "1," * 10_000 + "1]}}")), 413, "strict-json")
    assert str(routing.SCENARIO_VALUES) in many.detail


def test_long_bodies_of_one_client_take_only_so_much_memory(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    body = GOOD[:-1] + b" " * 100_000 + b"}"
    memory = service.services.gate.memory
    monkeypatch.setattr(memory, "total", 9.0 * len(body))
    head = "POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    begun = f"{head}Content-Length: {len(body)}\r\n\r\n{{".encode()
    with contextlib.ExitStack() as held:
        for _ in range(4):
            address = (service.base_url.host, service.base_url.port)
            held.enter_context(socket.create_connection(address)).sendall(begun)
        wait_until(lambda: memory.held == 4 * len(body), "all of them have begun")
        refused = post(service, body)
        assert (refused.status_code, int(refused.headers["retry-after"]) > 0) == (429, True)
        assert post(service, GOOD).status_code == 200, "a short one"
    wait_until(lambda: post(service, body).status_code == 200, "free memory")


@pytest.mark.parametrize("encoding", ["gzip", "deflate", "br", "GZIP", "identity, gzip", "x"])
def test_compressed_bodies_are_not_unpacked(client: httpx.Client, encoding: str) -> None:
    packed = gzip.compress(GOOD + b" " * 10_000_000)
    check(post(client, packed, **{"Content-Encoding": encoding}), 415, "unsupported-media-type")
    assert post(client, GOOD, **{"Content-Encoding": "identity"}).status_code == 200


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", ""])
def test_every_body_has_to_be_json(client: httpx.Client, kind: str) -> None:
    check(post(client, GOOD, **{"Content-Type": kind}), 415, "unsupported-media-type")
    assert post(client, GOOD, **{"Content-Type": "application/json; charset=utf-8"}).status_code == 200


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


def wrong_parameters(client: httpx.Client, method: str, path: str, query: str) -> list[tuple[str | None, str]]:
    problem = check(client.request(method, f"{path}?{query}", headers=JSON), 422, "invalid-request")
    return [(error.parameter, error.message) for error in problem.errors]


def test_every_route_takes_its_parameters_once_and_no_others(client: httpx.Client, operations: Any) -> None:
    assert {name for _, _, names in operations for name in names} > {"format", "limit", "window", "seeds", "x"}
    for method, path, names in operations:
        message = f"Unknown parameter no_such; there are {', '.join(names) or 'none'}"
        assert wrong_parameters(client, method, path, "no_such=1") == [("no_such", message)]
        for name in names:
            twice = wrong_parameters(client, method, path, f"{name}=1&{name}=1")
            assert twice == [(name, "This parameter is there twice")]
    assert len(wrong_parameters(client, "GET", "/api/v1/schema", "&".join(f"k{i}=" for i in range(1000)))) == 50
    assert wrong_parameters(client, "GET", "/api/v1/schema", "%3Cb%3E=1")[0][0] is None, "only a name is repeated"


def test_pages_and_files_take_any_parameter(client: httpx.Client) -> None:
    for path in ("/r/AAAAAAAAAAAAAAAAAAAAAA", "/docs", "/openapi.json", "/healthz", "/readyz", "/metrics"):
        assert client.get(path, params={"utm_source": "mail"}).status_code == client.get(path).status_code < 400


@pytest.mark.parametrize(
    ("scenario", "same"),
    [
        ({"road": {"seed": 3.0}}, {"road": {"seed": 3}}),
        ({"mpc": {"prediction_horizon": 2e1}}, {"mpc": {"prediction_horizon": 20}}),
        ({"road.bump.height": 0.1}, {"road": {"bump": {"height": 0.1}}}),
        ({"road.bump.height": 0.1, "road": {"bump": {"width": 0.5}}, "road.seed": 4.0}, None),
    ],
    ids=str,
)
def test_integers_may_be_written_as_other_programs_do_and_fields_nested_or_dotted(
    client: httpx.Client, scenario: dict[str, Any], same: dict[str, Any] | None
) -> None:
    same = same or {"road": {"seed": 4, "bump": {"height": 0.1, "width": 0.5}}}
    sent, nested = (
        client.post("/api/v1/runs", json={"scenario": each, "strategies": ["passive"]}) for each in (scenario, same)
    )
    assert sent.status_code == nested.status_code == 200, sent.text
    assert sent.json()["id"] == nested.json()["id"]
    assert client.post("/api/v1/live", json={"strategies": ["passive"], "points": 100.0}).status_code == 200


def test_a_trailing_slash_is_the_same_address(client: httpx.Client) -> None:
    assert client.get("/api/v1/presets/").json() == client.get("/api/v1/presets").json()
    assert client.post("/api/v1/runs/", json={"strategies": ["passive"]}).status_code == 200
    assert client.get("/api/v1/runs/").headers["allow"] == client.get("/api/v1/runs").headers["allow"]
    assert client.get("/api/v1//").status_code == 404
