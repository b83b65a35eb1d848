"""The file of tokens."""

import re
from pathlib import Path

_LINE = re.compile(r"(?P<name>[A-Za-z0-9_.-]{1,64})\s+(?P<token>[A-Za-z0-9._~+/-]{16,256}={0,2})")  # RFC 6750, 2.1


def read_tokens(path: Path) -> dict[str, str]:
    """Return each token's name and text.

    Args:
        path: A line for each, name and token with white space between; empty lines and those that begin with # count
            for nothing.

    Raises:
        OSError: It cannot be read.
        ValueError: A line is no such pair, a name or a token is there twice, or there is none; no token is repeated.
    """
    tokens: dict[str, str] = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        pair = _LINE.fullmatch(line.strip())
        if pair is None:
            raise ValueError(f"line {number} is not a name and a token of at least 16 characters")
        if pair["name"] in tokens or pair["token"] in tokens.values():
            raise ValueError(f"line {number} has a name or a token that was there before")
        tokens[pair["name"]] = pair["token"]
    if not tokens:
        raise ValueError("it has no token")
    return tokens
