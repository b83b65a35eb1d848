"""What is refused, how, and where the error says it belongs."""

import json
from typing import Any

import httpx
import pytest

from backend.models import Problem

MARK = "Zz9 <Plaintext> Mark"  # no name: those that look like one are told


def post(client: httpx.Client, body: str | bytes, path: str = "runs", kind: str = "application/json") -> httpx.Response:
    return client.post(f"/api/v1/{path}", content=body, headers={"Content-Type": kind})


def scenario(text: str) -> str:
    return f'{{"strategies": ["passive"], "scenario": {text}}}'


@pytest.mark.parametrize(
    ("body", "status", "pointer"),
    [
        (scenario('{"road": {"seed": 1, "seed": 2}}'), 422, ""),
        (scenario('{"road": {"length": 1e999}}'), 422, "/scenario/road/length"),
        (scenario('{"road": {"length": "150"}}'), 422, "/scenario/road/length"),
        (scenario('{"road": {"length": true}}'), 422, "/scenario/road/length"),
        (scenario('{"road": {"length": null}}'), 422, "/scenario/road/length"),
        (scenario('{"road": {"seed": 1.5}}'), 422, "/scenario/road/seed"),
        (scenario('{"road": {"seed": ' + "9" * 300 + "}}"), 422, "/scenario/road/seed"),
        (scenario('{"road": {"length": ' + "9" * 308 + "}}"), 422, "/scenario/road/length"),
        (scenario('{"road": {"bump": {"height": 3}}}'), 422, "/scenario/road/bump/height"),
        (scenario('{"road": {"bump": {"shape": "cube"}}}'), 422, "/scenario/road/bump/shape"),
        (scenario('{"road": {"bump": {"colour": 1}}}'), 422, "/scenario/road/bump/colour"),
        (scenario('{"road": {"bump": {"my colour": 1}}}'), 422, "/scenario/road/bump"),
        (scenario('{"road": {"bump": {"start": 149}}}'), 422, "/scenario/road/bump/start"),
        (scenario('{"mpc": {"control_horizon": 31}}'), 422, "/scenario/mpc/control_horizon"),
        (scenario('{"lqr": {"weights": [0, 0, 0]}}'), 422, "/scenario/lqr/weights"),
        (scenario('{"lqr": {"weights": [1, 1]}}'), 422, "/scenario/lqr/weights/2"),
        (scenario('{"lqr": {"weights": [1, -1, 1]}}'), 422, "/scenario/lqr/weights/1"),
        (scenario('{"lqr": {"weights": {"0": 1}}}'), 422, "/scenario/lqr/weights"),
        (scenario("[]"), 422, "/scenario"),
        (scenario("null"), 422, "/scenario"),
        (scenario('{"vehicle": 5}'), 422, "/scenario/vehicle"),
        ('{"strategies": []}', 422, "/strategies"),
        ('{"strategies": ["teleport"]}', 422, "/strategies/0"),
        ('{"strategies": "lv"}', 422, "/strategies"),
        ('{"strategies": [1]}', 422, "/strategies/0"),
        ("{}", 422, "/strategies"),
        ("[]", 422, ""),
        ("5", 422, ""),
        ("null", 422, ""),
        ('"' + MARK + '"', 422, ""),
        ("", 422, ""),
        ('{"strategies": ["\\ud800"]}', 422, ""),
        ("{", 400, ""),
        ('{"a": ' * 33 + "1" + "}" * 33, 400, ""),
    ],
    ids=lambda value: str(value)[:60] if isinstance(value, str | bytes) else str(value),
)
def test_a_bad_body_is_refused_at_its_place(client: httpx.Client, body: str | bytes, status: int, pointer: str) -> None:
    for path in ("runs", "live"):
        response = post(client, body, path)
        assert response.status_code == status, response.text
        assert response.headers["content-type"] == "application/problem+json"
        problem = Problem.model_validate(response.json())
        assert problem.status == status
        assert [error.pointer for error in problem.errors] == [pointer]
        assert problem.errors[0].message


def test_nesting_up_to_the_limit_is_read(client: httpx.Client) -> None:
    response = post(client, '{"a": ' * 32 + "1" + "}" * 32)
    assert response.status_code == 422, "read, and refused for its unknown field only"


def test_every_error_is_told_at_once(client: httpx.Client) -> None:
    body = scenario('{"road": {"length": 1, "seed": -1}, "vehicle": {"body_mass": "heavy"}}')
    pointers = {error["pointer"] for error in post(client, body).json()["errors"]}
    assert {"/scenario/road/length", "/scenario/road/seed", "/scenario/vehicle/body_mass"} <= pointers


def test_messages_name_the_limit_and_the_valid_names(client: httpx.Client) -> None:
    def message(body: str) -> str:
        return str(post(client, body).json()["errors"][0]["message"])

    assert "3000" in message(scenario('{"road": {"length": 5000}}'))
    assert "cosine" in message(scenario('{"road": {"bump": {"shape": "cube"}}}'))
    assert "height" in message(scenario('{"road": {"bump": {"colour": 1}}}'))
    assert "vehicle" in message(scenario('{"wheels": 1}'))
    assert "suspension_only" in message('{"strategies": ["teleport"]}')
    assert "scenario" in message('{"strategies": ["lv"], "more": 1}')
    assert "points" not in message('{"strategies": ["lv"], "more": 1}'), "that is a field of live alone"


@pytest.mark.parametrize(
    "body",
    [
        f'{{"strategies": ["{MARK}"]}}',
        f'{{"{MARK}": 1, "strategies": ["lv"]}}',
        scenario(f'{{"{MARK}": {{"{MARK}": "{MARK}"}}}}'),
        scenario(f'{{"road": {{"bump": {{"shape": "{MARK}", "{MARK}": "<script>{MARK}"}}}}}}'),
        scenario(f'{{"road": {{"length": "{MARK}", "seed": ["{MARK}"]}}}}'),
        scenario(f'{{"lqr": {{"weights": ["{MARK}", {{"{MARK}": 1}}, 1]}}}}'),
        f'{{"{MARK}": 1, "{MARK}": 2}}',
        f"{MARK}",
        f'"{MARK}',
    ],
)
def test_no_error_echoes_what_was_sent(client: httpx.Client, body: str) -> None:
    for path in ("runs", "live"):
        response = post(client, body, path)
        assert 400 <= response.status_code < 500
        assert MARK not in response.text
        assert all(MARK not in value for value in response.headers.values())


@pytest.mark.parametrize(
    ("path", "body", "pointer", "message"),
    [
        ("runs", {"strategies": ["lv"], "road": 2}, "/road", "road, perhaps roads; there are scenario, strategies"),
        (
            "live",
            {"strategies": ["lv"], "scenario": {"road": {"bump": {"hight": 1}}}},
            "/scenario/road/bump/hight",
            "hight, perhaps height; there are shape, height, width, start",
        ),
        ("batches", {"sweep": {"points": []}}, "/sweep/points", "points; there are grid, latin_hypercube, list"),
        (
            "batches",
            {"sweep": {"latin_hypercube": {"ranges": {"road.seed": [1, 9]}, "samples": 2, "sed": 1}}},
            "/sweep/latin_hypercube/sed",
            "sed, perhaps seed; there are ranges, samples, seed",
        ),
        (
            "batches",
            {"sweep": {"grid": {"road.bump.hight": [0.1, 0.2]}}},
            "/sweep/grid/road.bump.hight",
            "road.bump.hight, perhaps road.bump.height or road.bump.",
        ),
        (
            "batches",
            {"sweep": {"list": [{"road.seed": 1}, {"rode.seed": 1}]}},
            "/sweep/list/1/rode.seed",
            "rode.seed, perhaps road.seed; there are vehicle.body_mass, ",
        ),
        (
            "tunings",
            {"objectives": [{"kind": "paper"}, {"kind": "peaks", "windows": "bump"}]},
            "/objectives/1/windows",
            "windows, perhaps window; there are kind, q, window, figure",
        ),
        ("tunings", {"search": {"lqr.weight.0": [1, 2]}}, "/search/lqr.weight.0", "lqr.weight.0, perhaps lqr.weights"),
        ("links", {"run_id": "A" * 22, "view": {"zom": [1, 2]}}, "/view/zom", "zom, perhaps zoom; there are"),
        ("controller/report", {"scene": {}}, "/scene", "scene, perhaps scenario; there are scenario"),
    ],
)
def test_an_unknown_name_is_told_with_those_there_are(
    client: httpx.Client, path: str, body: dict[str, Any], pointer: str, message: str
) -> None:
    if path == "batches":
        body = {"strategies": ["lv"], **body}
    answer = post(client, json.dumps(body), path)
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["pointer"] == pointer
    assert message in error["message"]


def test_what_no_name_may_have_is_not_repeated_in_a_pointer(client: httpx.Client) -> None:
    """A sweep's keys are anything until they are looked up."""
    for grid in ({MARK: []}, {MARK: [1], f"{MARK}.more": [1]}):
        answer = post(client, json.dumps({"strategies": ["lv"], "sweep": {"grid": grid}}), "batches")
        assert {error["pointer"] for error in answer.json()["errors"]} == {"/sweep/grid"}
        assert MARK not in answer.text


def test_json_with_a_charset_is_json(client: httpx.Client) -> None:
    assert post(client, '{"strategies": ["passive"]}', kind="application/json; charset=utf-8").status_code == 200


def test_a_body_over_the_limit_is_413_also_when_it_comes_in_pieces(client: httpx.Client) -> None:
    text = json.dumps({"strategies": ["passive"], "scenario": {}, "more": "x" * 1_100_000}).encode()

    def pieces() -> Any:
        for start in range(0, len(text), 65536):
            yield text[start : start + 65536]

    for body in (text, pieces()):
        response = client.post("/api/v1/runs", content=body, headers={"Content-Type": "application/json"})
        assert response.status_code == 413
        assert response.headers["content-type"] == "application/problem+json"
        assert "content-security-policy" in response.headers


def test_a_body_just_under_the_limit_is_read(client: httpx.Client) -> None:
    body = '{"strategies": ["passive"]' + " " * (1024 * 1024 - 100) + "}"
    assert post(client, body).status_code == 200
