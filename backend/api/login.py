"""The page's login: a token once, then a cookie, which event streams and downloads send too."""

from typing import Annotated

from fastapi import Response
from pydantic import BaseModel, ConfigDict, Field

from backend.api.routing import API, ApiRequest, json_answer, router
from backend.http.problems import RequestError
from backend.http.tokens import COOKIE, LIFETIME, LOGIN

login = router("login", 400, 401, 413, 415, 422, 503)


class LoginState(BaseModel):
    """Whether the service wants a token, and whose this request showed."""

    required: bool
    name: str | None = Field(description="Of the token; null without one")


class LoginRequest(BaseModel):
    """A token, as the service's file has it."""

    model_config = ConfigDict(extra="forbid")

    token: Annotated[str, Field(min_length=1, max_length=300)]


@login.get(LOGIN.removeprefix(API), operation_id="getLogin", response_model=LoginState)
async def get_login(request: ApiRequest) -> Response:
    """Whether the service wants a token."""
    return json_answer({"required": request.services.tokens is not None, "name": request.token})


@login.post(LOGIN.removeprefix(API), operation_id="logIn", status_code=204)
async def log_in(body: LoginRequest, request: ApiRequest) -> Response:
    """Keep the token in a cookie that no script can read; 401 where it is none of the service's."""
    logins = request.services.logins
    value = None if logins is None else logins.begin(body.token)
    if value is None:
        raise RequestError("token-required", "This is none of the service's tokens.")
    answer = Response(status_code=204)
    _set(answer, request, value, LIFETIME)
    return answer


@login.delete(LOGIN.removeprefix(API), operation_id="logOut", status_code=204)
async def log_out(request: ApiRequest) -> Response:
    """End the login: its cookie, and every copy of it, is worth nothing from now on."""
    logins = request.services.logins
    if logins is not None:
        await logins.end(request.cookies.get(COOKIE, ""))
    answer = Response(status_code=204)
    _set(answer, request, "", 0)
    return answer


def _set(answer: Response, request: ApiRequest, value: str, max_age: int) -> None:
    secure = request.url.scheme == "https"
    answer.set_cookie(COOKIE, value, max_age=max_age, httponly=True, samesite="strict", secure=secure)
