"""Types of settings beyond pydantic's own; each refuses a value with one sentence."""

import ipaddress
import re
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from backend.token_file import read_tokens

_HOST = re.compile(r"\*|(\*\.)?[a-z0-9_-]+(\.[a-z0-9_-]+)*|[0-9a-f:.]*:[0-9a-f:.]*:[0-9a-f:.]*")  # or an IPv6 address
_SCHEDULER = re.compile(r"(tcp|tls)://([\w.-]+|\[[0-9a-fA-F:.]+\]):(\d{1,5})")


def items(text: str) -> list[str]:
    """Return what stands between commas, in lower case."""
    return [item.strip().lower() for item in text.split(",") if item.strip()]


def _folder(path: Path) -> Path:
    """A folder, which may be missing."""
    if path.exists() and not path.is_dir():
        raise ValueError(f"{path} is no folder")
    return path


def _scheduler(address: str) -> str:
    parts = _SCHEDULER.fullmatch(address)
    if parts is None or not 0 < int(parts[3]) < 65536:
        raise ValueError(f"{address} is no address of a scheduler, such as tcp://HOST:8786 or tls://HOST:8786")
    return address


def _proxies(text: str) -> str:
    for item in items(text) if text.strip() != "*" else ():
        try:
            ipaddress.ip_network(item)
        except ValueError:
            raise ValueError(f"{item} is neither an address nor a network, such as 10.0.0.0/8, nor *") from None
    return text


def _tokens_file(path: Path) -> Path:
    """One that can be used now; the service reads it again when it changes."""
    try:
        read_tokens(path)
    except OSError:
        raise ValueError(f"{path} cannot be read") from None
    return path


def _hosts(text: str) -> str:
    """Host names as a browser sends them, without the port."""
    for name in items(text):
        if not _HOST.fullmatch(name):
            raise ValueError(f"{name} is no host's name: names and addresses without scheme and port, with commas")
    return text


TokensFile = Annotated[Path, AfterValidator(_tokens_file)]
NewFolder = Annotated[Path, AfterValidator(_folder)]
SchedulerAddress = Annotated[str, AfterValidator(_scheduler)]
Proxies = Annotated[str, AfterValidator(_proxies)]
Hosts = Annotated[str, AfterValidator(_hosts)]
