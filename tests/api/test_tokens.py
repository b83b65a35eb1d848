"""With a file of tokens the API answers requests with a token, in a header or in the page's cookie."""

from collections.abc import Awaitable, Callable
from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI
from prometheus_client import CollectorRegistry

from backend.app import create_app
from backend.http.tokens import COOKIE, Caller, Tokens, cookie_of, read_tokens
from backend.settings import Settings, SettingsError
from tests.api.conftest import serve
from tests.api.test_problems import check
from tests.servers import loops

ANN, BEN = "ann-0123456789abcdef", "ben/+~.0123456789=="
LINES = f"# who may\n\nann {ANN}\n  ben\t{BEN}  \n"
API = "/api/v1/strategies"
Ask = Callable[[httpx.AsyncClient], Awaitable[httpx.Response]]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "tokens"
    path.write_text(LINES)
    return path


@pytest.fixture
def app(tmp_path: Path, file: Path) -> FastAPI:
    """A service that was not started: what is asked here needs neither its database nor its workers."""
    app = create_app(Settings(data_dir=tmp_path, tokens_file=file))

    @app.get("/caller")
    async def caller(caller: Caller) -> str | None:
        """Who asks."""
        return caller

    return app


def ask(app: FastAPI, method: str, path: str, *, scheme: str = "http", **more: object) -> httpx.Response:
    async def answer() -> httpx.Response:
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url=f"{scheme}://lab.example") as client:
            return await client.request(method, path, **more)  # type: ignore[arg-type]  # passed on as they came

    return loops.run(answer)


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


def test_the_api_is_for_those_with_a_token(app: FastAPI) -> None:
    for token, name in ((ANN, "ann"), (BEN, "ben")):
        assert ask(app, "GET", API, headers=bearer(token)).status_code == 200
        assert ask(app, "GET", "/caller", headers=bearer(token)).json() == name
    for headers in ({}, bearer(""), bearer(ANN[:-1]), bearer("ann"), {"Authorization": f"Basic {ANN}"}):
        for method, path in (("GET", API), ("POST", "/api/v1/runs"), ("GET", "/api/v1/nothing"), ("HEAD", API)):
            refused = ask(app, method, path, headers=headers)
            assert refused.headers["www-authenticate"].startswith("Bearer")
            if method != "HEAD":
                check(refused, 401, "token-required")


@pytest.mark.parametrize("path", ["/", "/b/some", "/healthz", "/metrics", "/docs", "/openapi.json", "/api/v1/login"])
def test_page_health_and_metrics_are_everybodys(app: FastAPI, path: str) -> None:
    app.state.metrics = CollectorRegistry()  # as the start would put it there
    assert ask(app, "GET", path).status_code == 200


def test_a_link_shows_nothing_of_what_it_opens(app: FastAPI) -> None:
    app.state.links = None  # whoever asked it would fail
    answer = ask(app, "GET", "/s/AAAAAAAAAAAAAAAAAAAAAA")
    assert (answer.status_code, "og:title" in answer.text) == (200, False)


@pytest.mark.parametrize("scheme", ["http", "https"])
def test_the_page_logs_in_once_and_keeps_a_cookie(app: FastAPI, scheme: str) -> None:
    check(ask(app, "POST", "/api/v1/login", json={"token": "wrong"}), 401, "token-required")
    logged_in = ask(app, "POST", "/api/v1/login", scheme=scheme, json={"token": ANN})
    assert logged_in.status_code == 204
    cookie = logged_in.headers["set-cookie"]
    assert cookie.startswith(f"{COOKIE}={cookie_of(ANN)}; HttpOnly; Max-Age=7776000; Path=/; SameSite=strict")
    assert cookie.endswith("; Secure") is (scheme == "https")
    assert ANN not in cookie
    held = {"Cookie": f"{COOKIE}={cookie_of(ANN)}"}
    assert ask(app, "GET", API, headers=held).status_code == 200
    assert ask(app, "GET", "/api/v1/login", headers=held).json() == {"required": True, "name": "ann"}
    assert ask(app, "GET", API, headers=held | bearer("wrong")).status_code == 401, "the header is who asks"
    assert ask(app, "GET", API, headers=bearer(cookie_of(ANN))).status_code == 401, "the cookie is no token"
    assert "Max-Age=0" in ask(app, "DELETE", "/api/v1/login", headers=held).headers["set-cookie"]


def test_without_a_file_everybody_may_ask_and_nobody_has_a_name(client: httpx.Client) -> None:
    assert client.get("/api/v1/login", headers=bearer(ANN)).json() == {"required": False, "name": None}
    check(client.post("/api/v1/login", json={"token": ANN}), 401, "token-required")


def test_the_file_is_read_again_when_it_changes_and_stays_in_force_while_it_cannot(file: Path) -> None:
    tokens = Tokens(file)
    file.write_text(f"ann {ANN}x\n")
    assert (tokens.name_of_token(ANN), tokens.name_of_token(f"{ANN}x")) == (None, "ann")
    assert (tokens.name_of_cookie(cookie_of(ANN)), tokens.name_of_cookie(cookie_of(f"{ANN}x"))) == (None, "ann")
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
    with pytest.raises(SettingsError, match="RIDELAB_TOKENS_FILE: "):
        Settings.from_environment({"RIDELAB_TOKENS_FILE": str(file)})
    with pytest.raises(SettingsError, match="cannot be read"):
        Settings.from_environment({"RIDELAB_TOKENS_FILE": str(file.with_name("absent"))})


def test_a_job_belongs_to_a_token_and_only_that_one_deletes_it(tmp_path: Path, file: Path) -> None:
    limits = {"workers": 1, "batch_workers": 1, "tokens_file": file}
    for service in serve(Settings.model_validate({"data_dir": tmp_path, **limits})):
        ann, ben = (httpx.Client(base_url=service.client.base_url, headers=bearer(token)) for token in (ANN, BEN))
        with ann, ben:
            body = {"scenario": {}, "strategies": ["passive"], "sweep": {"grid": {"road.seed": [1, 2]}}}
            address = ann.post("/api/v1/batches", json=body).headers["location"]
            check(service.client.get(address), 401, "token-required")
            assert ben.post(f"{address}/cancel").status_code == 200, "whoever has a token may see and end it"
            check(ben.delete(address), 403, "other-token")
            assert ann.delete(address).status_code == 204
            assert ben.get(address).status_code == 404
