"""A service's address, and the login that may stand in it: that is sent, and never shown."""

import re

import httpx

_LOGIN = re.compile(r"(?<=://)[^/?#\s]*@")


def without_login(text: str) -> str:
    """The text with its addresses as they may be shown: `http://user:password@host` is `http://host`."""
    return _LOGIN.sub("", text)


def split_login(address: str) -> tuple[httpx.URL, httpx.BasicAuth | None]:
    """The address without its login, and the login.

    Raises:
        ValueError: That is no HTTP address.
    """
    try:
        url = httpx.URL(address)
    except httpx.InvalidURL:
        url = httpx.URL("")
    if url.scheme not in ("http", "https") or not url.host:
        raise ValueError("A service's address begins with http:// or https:// and names a host")
    login = httpx.BasicAuth(url.username, url.password) if url.userinfo else None
    return httpx.URL(without_login(str(url))), login
