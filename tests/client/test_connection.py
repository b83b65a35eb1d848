"""The client's rules, against prepared answers: which requests it repeats, for how long, and its messages."""

import json
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from ridelab import (
    Batch,
    ErrorPlace,
    Event,
    JobEndedError,
    JobTimeoutError,
    Ridelab,
    RidelabAPIError,
    RidelabConnectionError,
)
from ridelab.cli import app
from ridelab.cli.service import Services
from ridelab.files import save
from ridelab.http import LONGEST_WAIT, Http
from ridelab.streams import json_rows, server_sent

FULL = {"type": "about:blank", "title": "Full", "status": 503, "detail": "Full.", "errors": []}


class Answering:
    """Answers one after the other; an exception among them is raised. Remembers what it was asked."""

    def __init__(self, *answers: httpx.Response | type[httpx.TransportError]) -> None:
        self.answers = list(answers)
        self.requests: list[httpx.Request] = []
        self.slept: list[float] = []

    def __call__(self, request: httpx.Request) -> httpx.Response:
        self.requests.append(request)
        answer = self.answers.pop(0)
        if isinstance(answer, type):
            raise answer("gone")
        return answer

    def http(self, retries: int = 5) -> Http:
        client = httpx.Client(base_url="http://ridelab.test", transport=httpx.MockTransport(self))
        return Http(client, retries=retries, sleep=self.slept.append)

    def ridelab(self) -> Ridelab:
        """A client that never really waits."""
        ridelab = Ridelab("http://ridelab.test", transport=httpx.MockTransport(self))
        ridelab._http.sleep = self.slept.append
        return ridelab


def full(after: str | None = None) -> httpx.Response:
    return httpx.Response(503, json=FULL, headers={} if after is None else {"Retry-After": after})


def test_a_full_service_is_asked_again_when_it_says() -> None:
    service = Answering(full("7"), httpx.Response(429, json={**FULL, "status": 429}, headers={"Retry-After": "2"}))
    service.answers.append(httpx.Response(200, json={"well": True}))
    assert service.http().json("POST", "/x", body={}, repeatable=False) == {"well": True}
    assert service.slept == [7, 2]


GIVEN_UP = {
    "it names no time": [full()],
    "later than anybody waits": [full(f"{LONGEST_WAIT + 1:.0f}")],
    "as often as allowed": [full("1"), full("1"), full("1")],
    "longer than allowed all together": [full(f"{LONGEST_WAIT - 1:.0f}"), full("2")],
}


@pytest.mark.parametrize("answers", GIVEN_UP.values(), ids=GIVEN_UP)
def test_it_gives_up(answers: list[httpx.Response]) -> None:
    service = Answering(*answers)
    with pytest.raises(RidelabAPIError) as caught:
        service.http(retries=2).json("GET", "/x")
    assert (caught.value.status, str(caught.value)) == (503, "Full.")
    assert not service.answers
    assert len(service.slept) == len(answers) - 1


@pytest.mark.parametrize(
    ("error", "repeatable", "asked"),
    [
        (httpx.ConnectError, True, 3),
        (httpx.ConnectError, False, 3),  # it never arrived
        (httpx.RemoteProtocolError, True, 3),
        (httpx.RemoteProtocolError, False, 1),  # it may have arrived
        (httpx.ReadTimeout, True, 1),  # it is being worked on: asking again makes it worse
    ],
)
def test_lost_connections(error: type[httpx.TransportError], repeatable: bool, asked: int) -> None:
    service = Answering(*[error] * 3)
    with pytest.raises(RidelabConnectionError, match=r"ridelab\.test"):
        service.http(retries=2).json("POST", "/x", body={}, repeatable=repeatable)
    assert len(service.requests) == asked
    assert service.slept == [0.2, 0.4][: asked - 1]


@pytest.mark.parametrize(
    ("pointer", "field"),
    [
        ("/scenario/mpc/stage_weights/cruise/0", "mpc.stage_weights.cruise[0]"),
        ("/sweep/grid/road.bump.height/3", "road.bump.height[3]"),
        ("/sweep/latin_hypercube/ranges/road.seed", "road.seed"),
        ("/sweep/list/2/road.seed", "[2].road.seed"),
        ("/a~1b~0c", "a/b~c"),
        ("", ""),
    ],
)
def test_errors_name_the_field_as_it_is_typed(pointer: str, field: str) -> None:
    assert ErrorPlace(message="m", pointer=pointer).field == field


def test_an_errors_text_names_its_fields() -> None:
    places = [
        {"pointer": "/scenario/road/length", "message": "too long"},
        {"pointer": "", "parameter": "strategy", "message": "unknown"},
        {"pointer": "", "message": "not like that"},
    ]
    error = RidelabAPIError.of(422, {"status": 422, "detail": "It cannot be used.", "errors": places})
    assert error.lines == ["road.length: too long", "strategy: unknown", "not like that"]
    assert RidelabAPIError.of(404, {"status": 404, "detail": "Nothing."}).lines == ["Nothing."]
    kinds = ["urn:problem-type:ridelab:not-found", "about:blank", "urn:problem-type:other:not-found", None]
    assert [RidelabAPIError.of(404, {"type": kind}).kind for kind in kinds] == ["not-found", None, None, None]
    broken = {"status": 500, "detail": "Something went wrong.", "errors": [], "request_id": "abc"}
    assert "abc" in str(RidelabAPIError.of(500, broken)), "an operator finds the request by it"


def test_events_as_the_standard_has_them() -> None:
    lines = ["retry: 3000", "", ": still here", "id: 4", "event: state", 'data: {"a":', "data:1}", "", "data: {}", ""]
    cut = ["id: 9", "event: state", "data: cut off"]
    assert [event for event in server_sent([*lines, *cut], "3") if event is not None] == [
        Event(id="4", kind="state", data={"a": 1}),
        Event(id="4", kind="message", data={}),
    ]


@pytest.mark.parametrize("size", [1, 7, 1000])
def test_rows_come_as_soon_as_they_are_there(size: int) -> None:
    expected = [{"run": 0, "reason": 'a "}],{ é\\'}, {"run": 1, "metrics": {"bump": [1.5e-3, None]}}, {}]
    text = json.dumps({"batch": "b", "units": {"run": "1"}, "rows": expected})
    sent = 0

    def pieces() -> Iterator[str]:
        nonlocal sent
        for start in range(0, len(text), size):
            sent = start + size
            yield text[start : start + size]

    stream = json_rows(pieces())
    assert next(stream) == expected[0]
    assert sent <= text.index(', {"run": 1') + size
    assert list(stream) == expected[1:]


@pytest.mark.parametrize("text", ["", '{"rows": [', '{"rows": [{"run": 0}'])
def test_rows_that_break_off_are_no_whole_table(text: str) -> None:
    with pytest.raises(RidelabConnectionError):
        list(json_rows([text]))


def test_a_file_is_whole_or_not_touched(tmp_path: Path) -> None:
    target = tmp_path / "a.csv"
    assert save([b"one", b"two"], target) == target
    assert target.read_bytes() == b"onetwo"

    def broken() -> Iterator[bytes]:
        yield b"half"
        raise RidelabConnectionError("gone")

    with pytest.raises(RidelabConnectionError):
        save(broken(), target)
    assert target.read_bytes() == b"onetwo"
    assert {path.name for path in tmp_path.iterdir()} == {"a.csv"}


def batch_answer(state: str, done: int = 0, **more: object) -> httpx.Response:
    answer = {"id": "b" * 22, "state": state, "reason": None, "total": 4, "done": done, "failed": 0}
    return httpx.Response(200, json={**answer, **more})


def submit(ridelab: Ridelab, key: str | None = None) -> Batch:
    return ridelab.submit({}, ["lv"], {"grid": {"road.seed": [1, 2, 3, 4]}}, idempotency_key=key)


def follow(service: Answering) -> list[tuple[str, int]]:
    """The events of a batch until its end."""
    heard = []
    with service.ridelab() as ridelab:
        batch = submit(ridelab)
        assert batch.follow(lambda batch: heard.append((batch.state, batch.done))) is batch
        assert batch.finished
    return heard


def events(number: int, state: str, done: int) -> httpx.Response:
    """A stream that breaks off after one event and a part of the next."""
    data = json.dumps({"state": state, "done": done, "failed": 0, "total": 4})
    return httpx.Response(200, text=f"id: {number}\nevent: state\ndata: {data}\n\nid: 99\ndata: cut")


def test_a_broken_stream_of_events_goes_on_where_it_was() -> None:
    service = Answering(batch_answer("queued"), events(11, "running", 1), batch_answer("running", 2))
    service.answers += [events(12, "done", 4), batch_answer("done", 4)]
    assert follow(service) == [("running", 1), ("running", 2), ("done", 4)]
    streams = [request for request in service.requests if request.url.path.endswith("/events")]
    assert [request.headers.get("Last-Event-ID") for request in streams] == [None, "11"]


def test_without_events_it_polls_and_outlives_a_restart() -> None:
    service = Answering(batch_answer("queued"), httpx.Response(404, json={**FULL, "status": 404}))
    service.answers += [batch_answer("running", 1), httpx.RemoteProtocolError, full(), batch_answer("running", 4)]
    service.answers += [batch_answer("done", 4), batch_answer("done", 4)]
    assert follow(service) == [("running", 1), ("running", 4), ("done", 4)]


def test_a_wait_ends_in_time_and_only_well_where_the_job_is_done() -> None:
    """It asks for no stream of events, which may outlast a short wait."""
    states = ("queued", "running", "running", "queued", "cancelled", "queued", "failed", "queued", "done")
    service = Answering(*(batch_answer(state, reason="a full disk") for state in states))
    with service.ridelab() as ridelab:
        with pytest.raises(JobTimeoutError):
            submit(ridelab).wait(timeout=0)
        for ending in ("cancelled", "a full disk"):
            with pytest.raises(JobEndedError, match=ending):
                submit(ridelab).wait(timeout=19)
        assert submit(ridelab).wait(timeout=19).state == "done"
    assert not any(request.url.path.endswith("/events") for request in service.requests)


def test_jobs_are_listed_over_pages(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    job = {**batch_answer("done", 4).json(), "created_at": "2026-01-02T03:04:05"}
    pages: tuple[dict[str, object], ...] = (
        {"batches": [job] * 2, "next": "c1"},
        {"batches": [job], "next": None},
        {"tunings": [], "next": None},
    )
    service = Answering(*(httpx.Response(200, json=page) for page in pages))
    with service.ridelab() as ridelab:
        monkeypatch.setattr(Services, "at", lambda *_: ridelab)
        assert app.run(["jobs", "list", "--state", "done", "--limit", "3", "--server", "http://ridelab.test"]) == 0
    assert capsys.readouterr().out.count(f"batch  {'b' * 22}  done") == 3
    assert [request.url.raw_path.decode().removeprefix("/api/v1") for request in service.requests] == [
        "/batches?limit=3&state=done",
        "/batches?limit=1&cursor=c1&state=done",
        "/tunings?limit=3&state=done",
    ]


def test_a_batch_is_handed_in_again_with_the_same_key() -> None:
    """Where an answer was lost on the way back; another batch has another one, or the caller's own."""
    service = Answering(httpx.ReadError, *(batch_answer("queued") for _ in range(3)))
    with service.ridelab() as ridelab:
        submit(ridelab)
        submit(ridelab)
        submit(ridelab, "mine")
    first, again, second, own = (request.headers["Idempotency-Key"] for request in service.requests)
    assert first == again != second
    assert own == "mine"
