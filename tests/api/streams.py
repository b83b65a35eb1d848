"""Reads a stream of server-sent events to its end."""

import json
from typing import Any

import httpx

from tests.servers.process import HANG_TIMEOUT


def read_events(client: httpx.Client, path: str, **options: Any) -> list[dict[str, Any]]:
    """Each event: `id`, `event` and what its data holds."""
    return events_of(client.get(path, timeout=HANG_TIMEOUT, **options).text)


def events_of(text: str) -> list[dict[str, Any]]:
    """The events of a whole stream."""
    events = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if "data" in fields:
            events.append({"id": int(fields["id"]), "event": fields["event"], **json.loads(fields["data"])})
    return events
