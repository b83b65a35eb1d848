"""A login in a service's address is sent with every request, and shown nowhere."""

import base64
import logging
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

from ridelab import Batch, Ridelab, RidelabAPIError, RidelabClientError, RidelabConnectionError
from ridelab.cli import app
from ridelab.cli.following import resume_command
from ridelab.cli.service import Services
from ridelab.cli.targets import find

SECRET = "s3cret"  # noqa: S105  # nobody's
ADDRESS = f"https://ann:{SECRET}%40home@ridelab.test:8443/lab/"
SHOWN = "https://ridelab.test:8443/lab"
BATCH = {"id": "b" * 22, "state": "queued", "reason": None, "total": 4, "done": 0, "failed": 0}
Answer = Callable[[httpx.Request], httpx.Response]


def at(answer: Answer, address: str = ADDRESS) -> Ridelab:
    return Ridelab(address, retries=0, transport=httpx.MockTransport(answer))


def test_it_is_sent_and_no_address_has_it(caplog: pytest.LogCaptureFixture) -> None:
    sent: list[httpx.Request] = []

    def answer(request: httpx.Request) -> httpx.Response:
        sent.append(request)
        return httpx.Response(201, json={"slug": "x", "url": "/s/x"} if request.url.path.endswith("links") else BATCH)

    with caplog.at_level(logging.DEBUG), at(answer) as ridelab:
        batch = ridelab.submit({}, ["lv"], {"grid": {"road.seed": [1]}})
        link = ridelab.link(batch)
        assert (ridelab.address, link.url) == (SHOWN, f"{SHOWN}/s/x")
        shown = repr([ridelab, batch, link, ridelab._client.base_url]) + str(ridelab._client.base_url) + caplog.text
    expected = base64.b64encode(f"ann:{SECRET}@home".encode()).decode()
    assert [request.headers["Authorization"] for request in sent] == [f"Basic {expected}"] * 2
    assert "ridelab.test" in caplog.text
    assert SECRET not in shown + "".join(str(request.url) for request in sent)


def gone(_: httpx.Request) -> httpx.Response:
    raise httpx.ConnectError("gone")


@pytest.mark.parametrize(
    "answer", [gone, *(lambda _, status=status: httpx.Response(status, text="<html>") for status in (200, 404, 502))]
)
def test_no_error_has_it(answer: Answer) -> None:
    with at(answer) as ridelab, pytest.raises(RidelabConnectionError, match=SHOWN) as caught:
        ridelab.get("/presets")
    assert SECRET not in repr([caught.value, caught.value.__cause__])


@pytest.mark.parametrize(
    ("address", "status", "said"),
    [
        (ADDRESS, 401, f"{SHOWN} refuses the login in its address (HTTP 401)"),
        (SHOWN, 401, f"{SHOWN} asks for a login, and neither a token nor its address has one (HTTP 401)"),
        (ADDRESS, 403, f"{SHOWN} does not let this request in (HTTP 403)"),
    ],
)
def test_a_refused_login_is_reported(address: str, status: int, said: str) -> None:
    with (
        at(lambda _: httpx.Response(status, text="<html>"), address) as ridelab,
        pytest.raises(RidelabAPIError) as caught,
    ):
        ridelab.get("/presets")
    assert (caught.value.status, str(caught.value)) == (status, said)


def test_printed_commands_and_refused_addresses_do_not_have_it(capsys: pytest.CaptureFixture[str]) -> None:
    with at(lambda _: httpx.Response(202, json=BATCH)) as ridelab:
        batch = ridelab.get_batch(str(BATCH["id"]))
        assert isinstance(batch, Batch)
        printed = resume_command(batch, Services(ADDRESS, Path("d")))
    assert f"--server {SHOWN}" in printed
    for words in (
        ["run", f"{ADDRESS}x"],
        ["run", f"http://ann:{SECRET}@[::1/r/x"],
        ["run", "--server", f"ftp://ann:{SECRET}@host"],
    ):
        assert app.run(words) == 2
        printed += capsys.readouterr().err
    assert "/lab/x: the address of a result ends with" in printed
    assert SECRET not in printed


def test_an_address_as_it_was_printed_is_asked_with_the_servers_login(monkeypatch: pytest.MonkeyPatch) -> None:
    addresses: list[str] = []

    def refuse(self: Ridelab, _: str) -> None:
        addresses.append(self.address if self._http.client.auth is not None else "without a login")
        raise RidelabClientError

    monkeypatch.setattr(Ridelab, "get_run", refuse)
    with Services(ADDRESS, None) as services:
        for address in (SHOWN, "https://ridelab.test:8443"):
            with pytest.raises(RidelabClientError):
                find(f"{address}/r/abc", services)
    assert addresses == [SHOWN, "without a login"]


def test_a_token_goes_to_the_server_that_is_named_and_to_no_other(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sent: list[tuple[str, str | None]] = []

    def refuse(self: Ridelab, _: str) -> None:
        sent.append((self.address, self._http.client.headers.get("Authorization")))
        raise RidelabClientError("no")

    monkeypatch.setattr(Ridelab, "get_run", refuse)
    monkeypatch.setenv("RIDELAB_TOKEN", "")  # and back to what it was
    file = tmp_path / "token"
    file.write_text(f"{SECRET}\n")
    for address in ("http://here.test", "http://elsewhere.test"):
        words = ["--token-file", str(file), "run", f"{address}/r/abc", "--server", "http://here.test"]
        assert app.run(words) == 3
    assert sent == [("http://here.test", f"Bearer {SECRET}"), ("http://elsewhere.test", None)]
    with (
        Ridelab(ADDRESS) as of_environment,
        Ridelab(SHOWN, token=SECRET[1:]) as with_token,
        Ridelab(ADDRESS, token="") as none,
    ):
        clients = [each._http.client for each in (of_environment, with_token, none)]
    assert [each.headers.get("Authorization") for each in clients] == [f"Bearer {SECRET}", f"Bearer {SECRET[1:]}", None]
    assert [each.auth is None for each in clients] == [True, True, False]
    with at(lambda _: httpx.Response(401), SHOWN) as refused, pytest.raises(RidelabAPIError, match="refuses the token"):
        refused.get("/presets")
    file.write_text("\n")
    assert app.run(["--token-file", str(file), "run"]) == 2
    assert SECRET not in "".join(capsys.readouterr())
