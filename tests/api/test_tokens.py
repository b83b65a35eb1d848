"""With a file of tokens the API answers requests with a token, in a header or in the page's cookie."""

import re
import time
from functools import partial
from pathlib import Path

import httpx
import pytest
from cachetools import TTLCache
from fastapi import FastAPI, Request
from sqlalchemy import update
from sqlalchemy.exc import OperationalError

from backend.app import create_app
from backend.command_error import CommandError
from backend.db.tables import jobs
from backend.http import openapi
from backend.http.tokens import COOKIE, LIFETIME, MAX_CHECKED, RECHECK_AFTER, Logins, Tokens, cookie_key
from backend.settings import Settings
from backend.store import Store
from backend.token_file import read_tokens
from tests.api import tuning
from tests.api.conftest import TOKENS, Service
from tests.api.test_problems import check
from tests.servers import loops
from tests.servers.loops import ask
from tests.servers.process import HANG_TIMEOUT

ANN, BEN = TOKENS["ann"], TOKENS["ben"]
LINES = f"# who may\n\nann {ANN}\n  ben\t{BEN}  \n"
API = "/api/v1/strategies"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "tokens"
    path.write_text(LINES)
    return path


@pytest.fixture(scope="module")
def app(tmp_path_factory: pytest.TempPathFactory) -> FastAPI:
    """A service that was not started: what is asked here needs no workers, and of its database only ended logins."""
    folder = tmp_path_factory.mktemp("tokens")
    (folder / "tokens").write_text(LINES)
    app = create_app(Settings(data_dir=folder, tokens_file=folder / "tokens"))
    app.state.services.store.migrate()

    @app.get("/caller")
    async def caller(request: Request) -> str | None:
        """Return who asks."""
        name: str | None = request.state.caller
        return name

    return app


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


def test_the_api_is_for_those_with_a_token(app: FastAPI) -> None:
    for token, name in ((ANN, "ann"), (BEN, "ben")):
        assert ask(app, "GET", API, headers=bearer(token), timeout=HANG_TIMEOUT).status_code == 200
        assert ask(app, "GET", "/caller", headers=bearer(token), timeout=HANG_TIMEOUT).json() == name
    for headers in ({}, bearer(""), bearer(ANN[:-1]), bearer("ann"), {"Authorization": f"Basic {ANN}"}):
        for method, path in (("GET", API), ("POST", "/api/v1/runs"), ("GET", "/api/v1/nothing"), ("HEAD", API)):
            refused = ask(app, method, path, headers=headers)
            assert refused.headers["www-authenticate"].startswith("Bearer")
            if method != "HEAD":
                check(refused, 401, "token-required")


@pytest.mark.parametrize("path", ["/", "/b/some", "/healthz", "/metrics", "/docs", "/openapi.json", "/api/v1/login"])
def test_page_health_and_metrics_are_everybodys(app: FastAPI, monkeypatch: pytest.MonkeyPatch, path: str) -> None:
    monkeypatch.setattr(openapi, "_described", lambda *_: ({}, b"{}"))  # takes two seconds
    assert ask(app, "GET", path).status_code == 200


def test_a_link_shows_nothing_of_what_it_opens(tmp_path: Path, file: Path) -> None:
    app = create_app(Settings(data_dir=tmp_path, tokens_file=file))
    del app.state.services.links  # whoever asked it would fail
    answer = ask(app, "GET", "/s/AAAAAAAAAAAAAAAAAAAAAA")
    assert (answer.status_code, "og:title" in answer.text) == (200, False)


@pytest.mark.parametrize("scheme", ["http", "https"])
def test_the_page_logs_in_once_and_keeps_a_cookie(app: FastAPI, scheme: str) -> None:
    check(ask(app, "POST", "/api/v1/login", json={"token": "wrong"}), 401, "token-required")
    logged_in = ask(app, "POST", f"{scheme}://lab.example/api/v1/login", json={"token": ANN})
    assert logged_in.status_code == 204
    cookie = logged_in.headers["set-cookie"]
    assert cookie.startswith(f"{COOKIE}=")
    assert "; HttpOnly; Max-Age=7776000; Path=/; SameSite=strict" in cookie
    assert cookie.endswith("; Secure") is (scheme == "https")
    assert ANN not in cookie
    held = {"Cookie": cookie.partition(";")[0]}
    assert ask(app, "GET", API, headers=held).status_code == 200
    assert ask(app, "GET", "/api/v1/login", headers=held).json() == {"required": True, "name": "ann"}
    assert ask(app, "GET", API, headers=held | bearer("wrong")).status_code == 401, "the header is who asks"
    value = held["Cookie"].partition("=")[2]
    assert ask(app, "GET", API, headers=bearer(value)).status_code == 401, "the cookie is no token"
    wrong = [value[:-1] + "é", value.partition(".")[2], f".{value}", value.replace("-", "", 1), cookie_key(ANN), ""]
    for cookie in wrong:
        assert ask(app, "GET", API, headers={"Cookie": f"{COOKIE}={cookie}".encode()}).status_code == 401


def test_a_copied_cookie_is_worth_nothing_after_logging_out(app: FastAPI) -> None:
    mine, others = (
        {"Cookie": ask(app, "POST", "/api/v1/login", json={"token": ANN}).headers["set-cookie"].partition(";")[0]}
        for _ in range(2)
    )
    assert "Max-Age=0" in ask(app, "DELETE", "/api/v1/login", headers=mine).headers["set-cookie"]
    assert ask(app, "GET", API, headers=mine).status_code == 401
    assert ask(app, "GET", API, headers=others).status_code == 200, "another browser stays logged in"
    for nothing in (mine, {}, {"Cookie": f"{COOKIE}=x.y"}):
        assert ask(app, "DELETE", "/api/v1/login", headers=nothing).status_code == 204


def test_without_its_database_the_api_cannot_tell_and_the_page_is_there(
    app: FastAPI, monkeypatch: pytest.MonkeyPatch
) -> None:
    cookie = ask(app, "POST", "/api/v1/login", json={"token": ANN}).headers["set-cookie"].partition(";")[0]

    def fail(_: str) -> bool:
        raise OperationalError("secret statement", {}, Exception())

    monkeypatch.setattr(app.state.services.store.logins, "has_ended", fail)
    check(ask(app, "GET", API, headers={"Cookie": cookie}), 503, "store-unavailable")
    assert ask(app, "GET", "/docs", headers={"Cookie": cookie}).status_code == 200


def test_a_login_ends_by_itself_and_for_all_replicas_however_often_its_cookie_comes(
    file: Path, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, another = (
        Logins(
            Tokens(file),
            remember=lambda login: store.write(store.logins.end, login),
            has_ended=lambda login: store.read(store.logins.has_ended, login),
        )
        for _ in range(2)
    )
    clock = 0.0
    another._open = TTLCache(MAX_CHECKED, RECHECK_AFTER, lambda: clock)
    first, second = (str(one.begin(ANN)) for _ in range(2))

    def names(cookie: str) -> list[str | None]:
        return [loops.run(partial(each.name, cookie)) for each in (one, another)]

    assert [names(cookie) for cookie in (first, second)] == [["ann", "ann"]] * 2
    loops.run(partial(one.end, first))
    seen = []
    for _ in range(3):
        clock += 0.6 * RECHECK_AFTER
        seen.append(names(first))
    assert seen == [[None, "ann"], [None, None], [None, None]], "one that is in use is checked again"
    now = time.time()
    for ahead in (LIFETIME + 2, -LIFETIME - 2):  # of a clock that was ahead when it began
        monkeypatch.setattr(time, "time", lambda ahead=ahead: now + ahead)
        assert names(second) == [None, None]


def test_without_a_file_everybody_may_ask_and_nobody_has_a_name(client: httpx.Client) -> None:
    assert client.get("/api/v1/login", headers=bearer(ANN)).json() == {"required": False, "name": None}
    check(client.post("/api/v1/login", json={"token": ANN}), 401, "token-required")


def test_the_file_is_read_again_when_it_changes_and_stays_in_force_while_it_cannot(file: Path) -> None:
    tokens = Tokens(file)
    file.write_text(f"ann {ANN}x\n")
    assert (tokens.name_of_token(ANN), tokens.name_of_token(f"{ANN}x")) == (None, "ann")
    assert tokens.cookie_keys() == {cookie_key(f"{ANN}x"): "ann"}
    for broken in (lambda: file.write_text("half"), lambda: file.write_bytes(b"\xff"), file.unlink):
        broken()
        assert tokens.name_of_token(f"{ANN}x") == "ann"
    new = file.with_name("new")
    new.write_text(LINES)
    new.replace(file)  # as secrets are changed under a running service
    assert tokens.name_of_token(BEN) == "ben"


@pytest.mark.parametrize(
    "text",
    ["", "# nobody", "ann", "ann short", f"ann {ANN} more", f"a/b {ANN}", f"ann {ANN}\nann {BEN}", f"a {ANN}\nb {ANN}"],
)
def test_a_file_that_cannot_be_meant_ends_the_start_and_is_not_repeated(file: Path, text: str) -> None:
    file.write_text(text)
    with pytest.raises(ValueError, match=r"line \d|it has no token") as caught:
        read_tokens(file)
    assert ANN not in str(caught.value)
    with pytest.raises(CommandError, match="RIDELAB_TOKENS_FILE: "):
        Settings.from_environment({"RIDELAB_TOKENS_FILE": str(file)})
    with pytest.raises(CommandError, match="cannot be read"):
        Settings.from_environment({"RIDELAB_TOKENS_FILE": str(file.with_name("absent"))})


SUBMITTED = {
    "batches": {"scenario": {}, "strategies": ["passive"], "sweep": {"grid": {"road.seed": [1, 2]}}},
    "tunings": tuning.REQUEST,
}


@pytest.mark.parametrize("kind", SUBMITTED)
def test_a_job_is_read_by_all_and_changed_by_the_token_that_submitted_it(
    with_tokens: Service, guarded: tuple[httpx.Client, httpx.Client], kind: str
) -> None:
    ann, ben = guarded
    address = ann.post(f"/api/v1/{kind}", json=SUBMITTED[kind]).headers["location"]
    label = {"label": "mine"}
    for method, path in (("PATCH", ""), ("POST", "/cancel"), ("POST", "/resume"), ("DELETE", "")):
        refused = ben.request(method, address + path, json=label if method == "PATCH" else None)
        check(refused, 403, "other-token")
    assert ben.get(address).json()["label"] is None
    assert ann.patch(address, json=label).json()["label"] == ben.get(address).json()["label"] == "mine"
    ann.post(f"{address}/cancel").raise_for_status()
    with with_tokens.services.store.writing() as connection:  # as of before there was a file of tokens
        connection.execute(update(jobs).where(jobs.c.id == address.rpartition("/")[2]).values(owner=None))
    assert ben.delete(address).status_code == 204, "what came without a token is everybody's"
    assert ann.get(address).status_code == 404


def test_no_shared_cache_keeps_what_needs_a_token(guarded: tuple[httpx.Client, httpx.Client]) -> None:
    ann, _ = guarded
    run = ann.post("/api/v1/runs", json={"strategies": ["passive"]}).json()["id"]
    for path in (f"runs/{run}", f"runs/{run}/series?points=10"):
        answer = ann.get(f"/api/v1/{path}")
        assert answer.headers["cache-control"] == "private, no-cache"
        assert {"Authorization", "Cookie"} <= set(re.split(", ?", answer.headers["vary"]))
