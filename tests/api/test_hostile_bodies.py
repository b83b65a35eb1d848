"""Bodies made to be expensive or ambiguous: what they cost is bounded before anything is built from them."""

import contextlib
import gzip
import json
import socket
import threading
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.http import routing, strict_json
from backend.http.strict_json import MAX_DEPTH, MAX_MEMBERS, StrictJSONError, parse
from tests.servers.process import wait_until

JSON = {"Content-Type": "application/json"}


def refused(body: str | bytes, **limits: Any) -> int:
    with pytest.raises(StrictJSONError) as error:
        parse(body if isinstance(body, bytes) else body.encode(), **limits)
    return error.value.status


@pytest.mark.parametrize(
    ("text", "value"),
    [
        (r'"\ud83d\ude00"', "😀"),
        (r'"\\ud800"', r"\ud800"),
        (r'"\\\\ud800\ud83d\ude00"', r"\\ud800" + "😀"),
        (r'"\uD83D\uDE00\u0041\n\"\\"', '😀A\n"\\'),
        (r'"\ud7ff\ue000"', "\ud7ff\ue000"),
    ],
)
def test_whole_surrogate_pairs_are_characters(text: str, value: str) -> None:
    assert parse(text.encode()) == value


@pytest.mark.parametrize(
    "text",
    [
        r'"\ud800"',
        r'"\udc00"',
        r'"\ude00\ud83d"',
        r'"\ud83d\ud83d\ude00"',
        r'"\ud83d\\ude00"',
        r'"\\\ud800"',
        r'{"\uDFFF": 1}',
        r'[{"a": ["x\uD800x"]}]',
    ],
)
def test_halves_of_surrogate_pairs_are_not(text: str) -> None:
    assert refused(text) == 422


@given(st.text(st.characters(categories=["L", "N", "P", "S", "Cs", "Cc"]), max_size=20))
def test_a_text_is_read_exactly_where_utf8_can_hold_it(text: str) -> None:
    body = json.dumps(text).encode()
    whole = text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    try:
        whole = text.encode("utf-16", "surrogatepass").decode("utf-16")
    except UnicodeDecodeError:
        assert refused(body) == 422
    else:
        assert parse(body) == whole


@pytest.mark.parametrize("pair", ["[]", "{}"])
def test_depth_is_counted_outside_texts(pair: str) -> None:
    def nested(depth: int, inside: str = "") -> str:
        return ("[" if pair == "[]" else '{"a":') * depth + (inside or "1") + pair[1] * depth

    assert parse(nested(MAX_DEPTH).encode()) is not None
    assert parse(nested(3, json.dumps("[{" * 500 + '\\"]}')).encode()) is not None
    assert parse(("[" + ",".join(["[[]]"] * 200) + "]").encode()) is not None
    for depth in (MAX_DEPTH + 1, 1000, 100_000):
        assert refused(nested(depth)) == 400
    assert refused("[" * 1_000_000) == 400


def test_values_are_counted_before_they_are_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strict_json.json, "loads", lambda *_, **__: pytest.fail("it was parsed"))
    for unit in ("1", "1.5", "{}", "[]", '""', '{"a":1}'):
        assert refused("[" + ",".join([unit] * 300_000) + "]") == 413
    assert refused("[" + ",".join("1" * 30) + "]", max_values=20) == 413


def test_an_object_has_only_so_many_members() -> None:
    members = {f"k{index}": index for index in range(MAX_MEMBERS)}
    assert parse(json.dumps(members).encode()) == members
    assert refused(json.dumps({**members, "more": 1})) == 422


@pytest.mark.parametrize(("digits", "read"), [(308, True), (309, False), (4301, False), (1_000_000, False)])
def test_integers_have_only_so_many_digits(digits: int, read: bool) -> None:
    for text in ("9" * digits, "-" + "9" * digits, "[0, " + "1" * digits + "]"):
        if read:
            assert parse(text.encode()) is not None
        else:
            assert refused(text) == 422
    assert parse(('"' + "9" * digits + '"').encode()) == "9" * digits, "digits of a text are no number"
    assert parse(("0." + "9" * digits).encode()) == 1


@pytest.mark.parametrize("path", ["runs", "live"])
def test_a_scenario_has_only_so_many_values(client: httpx.Client, path: str) -> None:
    body = '{"strategies": ["passive"], "scenario": {"lqr": {"weights": [' + "1," * 10_000 + "1]}}}"
    response = client.post(f"/api/v1/{path}", content=body, headers=JSON)
    assert response.status_code == 413
    assert str(routing.SCENARIO_VALUES) in response.json()["detail"]


@pytest.mark.parametrize("length", [200, 300_000])
def test_long_bodies_are_parsed_beside_the_event_loop(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch, length: int
) -> None:
    threads = []
    original = strict_json.parse

    def spy(*args: Any, **limits: Any) -> Any:
        threads.append(threading.current_thread().name)
        return original(*args, **limits)

    monkeypatch.setattr(strict_json, "parse", spy)
    body = '{"strategies": ["passive"]' + " " * length + "}"
    assert client.post("/api/v1/runs", content=body, headers=JSON).status_code == 200
    assert [name.startswith("strict-json") for name in threads] == [length > routing.BULKY]


def test_one_client_sends_only_so_many_long_bodies_at_once(service: Any, client: httpx.Client) -> None:
    body = b'{"strategies": ["passive"]' + b" " * 100_000 + b"}"
    head = "POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    begun = f"{head}Content-Length: {len(body)}\r\n\r\n{{".encode()
    address = (client.base_url.host, client.base_url.port)
    with contextlib.ExitStack() as held:
        for _ in range(4):
            held.enter_context(socket.create_connection(address)).sendall(begun)
        wait_until(lambda: service.app.state.admission.load["bodies"] == 4, "all of them have begun", 10)
        response = client.post("/api/v1/runs", content=body, headers=JSON)
        assert response.status_code == 429
        assert int(response.headers["retry-after"]) > 0
        assert client.post("/api/v1/runs", json={"strategies": ["passive"]}).status_code == 200, "a short one"
    wait_until(lambda: client.post("/api/v1/runs", content=body, headers=JSON).status_code == 200, "a free place", 10)


PATHS = ["runs", "live", "batches", "tunings", "links"]
PACKED = gzip.compress(b'{"strategies": ["passive"]}' + b" " * 10_000_000)


@pytest.mark.parametrize(
    ("path", "encoding"),
    [(path, "gzip") for path in PATHS] + [("runs", name) for name in ("deflate", "br", "GZIP", "identity, gzip", "x")],
)
def test_compressed_bodies_are_not_unpacked(client: httpx.Client, path: str, encoding: str) -> None:
    response = client.post(f"/api/v1/{path}", content=PACKED, headers={**JSON, "Content-Encoding": encoding})
    assert response.status_code == 415
    assert response.headers["content-type"] == "application/problem+json"


def test_a_body_that_says_it_is_as_it_is_is_read(client: httpx.Client) -> None:
    response = client.post(
        "/api/v1/runs", content='{"strategies": ["passive"]}', headers={**JSON, "Content-Encoding": "identity"}
    )
    assert response.status_code == 200


KINDS = ["application/xml", "application/jsonp", "application/x-www-form-urlencoded", "multipart/form-data", ""]


@pytest.mark.parametrize(
    ("path", "kind"), [(path, "text/plain") for path in PATHS] + [("runs", kind) for kind in KINDS]
)
def test_every_body_has_to_be_json(client: httpx.Client, path: str, kind: str) -> None:
    response = client.post(f"/api/v1/{path}", content="{}", headers={"Content-Type": kind})
    assert response.status_code == 415
    assert response.headers["content-type"] == "application/problem+json"


UNREADABLE = [
    (b"", 400),
    (b"{", 400),
    (b"{} {}", 400),
    (b"{'a': 1}", 400),
    (b"\xef\xbb\xbf{}", 400),
    (b"\xff\xfe{\x00}\x00", 400),
    (b'{"a": "\xff"}', 400),
    (b'{"a": "\xed\xa0\x80"}', 400),
    (b'{"a": 1, "a": 2}', 422),
    (b'{"a": {"b": 1, "b": 2}}', 422),
    (b'{"a": NaN}', 422),
    (b'{"a": Infinity}', 422),
    (b'{"a": -Infinity}', 422),
    (b'{"a": "\\ud800"}', 422),
    (b'{"a": ' + b"9" * 400 + b"}", 422),
    (b"{" + b",".join(b'"k%d":1' % index for index in range(1000)) + b"}", 422),
    (b"[" + b"1," * 300_000 + b"1]", 413),
]


@pytest.mark.parametrize(("body", "status"), UNREADABLE, ids=[str(body[:30]) for body, _ in UNREADABLE])
def test_what_cannot_be_read_in_one_way_is_refused(body: bytes, status: int) -> None:
    assert refused(body) == status


@pytest.mark.parametrize(
    ("body", "status"),
    [
        (b"[" * 40 + b"]" * 40, 400),
        (b'{"a": 1}' + b" " * 1_100_000, 413),
        (b'{"a": NaN}', 422),
        (b"0", 422),
        (b"[]", 422),
        (b'""', 422),
        (b"null", 422),
    ],
    ids=lambda value: str(value[:30]) if isinstance(value, bytes) else "",
)
@pytest.mark.parametrize("path", PATHS)
def test_every_route_reads_its_body_as_strictly(client: httpx.Client, path: str, body: bytes, status: int) -> None:
    response = client.post(f"/api/v1/{path}", content=body, headers=JSON)
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"


HUGE = ["1e999", "-1e999", "1e400", "9" * 308, "-" + "9" * 308, "1e-999", "0." + "9" * 5000, "1" + "0" * 300 + ".5"]


@pytest.mark.parametrize("number", HUGE, ids=[number[:20] for number in HUGE])
def test_numbers_beyond_every_limit_are_refused_wherever_a_number_is(client: httpx.Client, number: str) -> None:
    places = [
        ("runs", f'{{"strategies": ["passive"], "scenario": {{"road": {{"length": {number}}}}}}}'),
        ("runs", f'{{"strategies": ["passive"], "scenario": {{"road": {{"seed": {number}}}}}}}'),
        ("runs", f'{{"strategies": ["passive"], "scenario": {{"vehicle": {{"body_mass": {number}}}}}}}'),
        ("live", f'{{"strategies": ["passive"], "points": {number}}}'),
        ("batches", f'{{"strategies": ["passive"], "sweep": {{"grid": {{"road.length": [{number}]}}}}}}'),
        ("batches", f'{{"strategies": ["passive"], "sweep": {{"list": [{{"vehicle.body_mass": {number}}}]}}}}'),
        (
            "batches",
            '{"strategies": ["passive"], "sweep": {"latin_hypercube": {"ranges": {"road.length": '
            f'[100, {number}]}}, "samples": 2}}}}}}',
        ),
        (
            "batches",
            '{"strategies": ["passive"], "sweep": {"latin_hypercube": {"ranges": {"road.length": [100, 120]}, '
            f'"samples": {number}}}}}}}',
        ),
    ]
    for path, body in places:
        response = client.post(f"/api/v1/{path}", content=body, headers=JSON)
        assert response.status_code == 422, (path, body[:200], response.text)
        assert response.json()["errors"]


def test_many_errors_are_told_in_part(client: httpx.Client) -> None:
    scenario = {
        part: {f"k{index}": index for index in range(200)} for part in ("road", "mpc", "lqr", "vehicle", "speed")
    }
    response = client.post("/api/v1/runs", json={"strategies": ["passive"], "scenario": scenario})
    assert response.status_code == 422
    assert len(response.json()["errors"]) == 50
    assert len(response.content) < 100_000


def test_a_flood_of_hostile_bodies_leaves_the_others_served(service: Any, client: httpx.Client) -> None:
    """Three senders go on until each was answered; meanwhile others ask again and again, and are all answered."""
    bodies = [
        (("[" + ",".join(["[1]"] * 120_000) + "]").encode(), 422),
        (("{" + ",".join(f'"{index:x}":1' for index in range(90_000)) + "}").encode(), 422),
        (b"[" * 1_000_000, 400),
    ]
    stop = threading.Event()
    answers: list[set[int]] = [set() for _ in bodies]

    def send(body: bytes, statuses: set[int]) -> None:
        with httpx.Client(base_url=client.base_url, timeout=60) as sender:
            while not stop.is_set():
                statuses.add(sender.post("/api/v1/batches", content=body, headers=JSON).status_code)

    senders = [
        threading.Thread(target=send, args=[body, statuses])
        for (body, _), statuses in zip(bodies, answers, strict=True)
    ]
    for sender in senders:
        sender.start()

    def others_are_served_until_all_were_answered() -> bool:
        assert client.get("/healthz").status_code == 200
        assert service.run(["passive"]).status_code == 200
        return all(expected in statuses for (_, expected), statuses in zip(bodies, answers, strict=True))

    try:
        wait_until(others_are_served_until_all_were_answered, "each hostile body is answered")
    finally:
        stop.set()
        for sender in senders:
            sender.join()
    assert set().union(*answers) <= {400, 422, 429, 503}
