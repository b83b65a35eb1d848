"""The state of a batch, read over HTTP."""

from typing import Any

import httpx

from tests.servers.process import HANG_TIMEOUT


def computed(client: httpx.Client, **body: Any) -> Any:
    """The batch of that request once it has ended."""
    answer = client.post("/api/v1/batches", json=body)
    assert answer.status_code == 202, answer.text
    return wait_for(client, answer.json()["id"])


def wait_for(client: httpx.Client, batch_id: str) -> Any:
    """The batch once it has ended."""
    client.get(
        f"/api/v1/batches/{batch_id}/events", timeout=HANG_TIMEOUT
    ).raise_for_status()  # a stream that ends with it
    batch = client.get(f"/api/v1/batches/{batch_id}").json()
    assert batch["state"] not in ("planning", "queued", "running")
    return batch


def rows(client: httpx.Client, batch_id: str) -> Any:
    """Its runs, in order."""
    return client.get(f"/api/v1/batches/{batch_id}/results").raise_for_status().json()["rows"]
