"""Who asks: the layer that looks for a token, in a program's header or in the page's cookie."""

from sqlalchemy.exc import SQLAlchemyError
from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.http.logins import COOKIE, LOGIN, Logins
from backend.http.problems import problem
from backend.http.tokens import CALLER, Tokens


class TokenMiddleware:
    """Lets only requests with a token use the API; the page, its login, health and metrics are open.

    What the API answers no cache shared by several people may keep, and no cache may give to others than it was for.

    Args:
        app: ASGI.
        tokens: Who may.
        logins: Of the page.
    """

    def __init__(self, app: ASGIApp, tokens: Tokens, logins: Logins) -> None:
        self.app = app
        self._tokens = tokens
        self._logins = logins

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        of_api = scope["path"].startswith("/api/")
        try:
            caller = await self._caller(HTTPConnection(scope))
        except SQLAlchemyError:
            if of_api:
                await problem("store-unavailable", headers={"Retry-After": "5"})(scope, receive, send)
                return
            caller = None
        scope.setdefault("state", {})[CALLER] = caller

        async def private(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                if "cache-control" in headers:
                    headers["Cache-Control"] = headers["cache-control"].replace("public", "private")
                    headers.add_vary_header("Authorization")
                    headers.add_vary_header("Cookie")
            await send(message)

        if caller is None and of_api and scope["path"] != LOGIN:
            await problem("token-required")(scope, receive, send)
        else:
            await self.app(scope, receive, private if of_api else send)

    async def _caller(self, request: HTTPConnection) -> str | None:
        scheme, _, token = request.headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer":  # a program's: a cookie beside it counts for nothing
            return self._tokens.name_of_token(token.strip())
        cookie = request.cookies.get(COOKIE)
        return None if cookie is None else await self._logins.name(cookie)
