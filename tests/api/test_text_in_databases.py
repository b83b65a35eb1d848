"""Text that a database could fail on: PostgreSQL takes no NUL and no value longer than its column."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from tests.api.conftest import TOKENS, Service
from tests.api.test_problems import check
from tests.servers.process import HANG_TIMEOUT

OWNER = max(TOKENS, key=len)
SWEEP: dict[str, Any] = {"strategies": ["passive"], "sweep": {"list": [{"road.seed": 1}]}}


@pytest.fixture(scope="module")
def client(with_tokens: Service) -> Iterator[httpx.Client]:
    """Of the token with the longest name, at a service on PostgreSQL."""
    headers = {"Authorization": f"Bearer {TOKENS[OWNER]}"}
    with httpx.Client(base_url=with_tokens.base_url, headers=headers, timeout=HANG_TIMEOUT) as client:
        yield client


def test_a_name_and_an_address_with_control_characters_are_refused(client: httpx.Client) -> None:
    """More of them, with their words, are among the refusals."""
    for text in ("a\0b", "a\x7f", "a\u2028b", "a\u202eb"):
        problem = check(client.post("/api/v1/batches", json={**SWEEP, "label": text}), 422, "invalid-request")
        assert [each.pointer for each in problem.errors] == ["/label"]
    for path in ("runs", "batches", "tunings", "links", "roads"):
        check(client.get(f"/api/v1/{path}/a%00b"), 404, "not-found")
    check(client.post("/api/v1/batches/%00/cancel"), 404, "not-found")
    for path, name in (("batches", "label"), (f"runs/{'A' * 22}/changes", "against"), ("batches", "cursor")):
        problem = check(client.get(f"/api/v1/{path}?{name}=a%00b"), 422, "invalid-request")
        assert problem.errors[0].parameter == name


def test_the_longest_key_of_the_longest_name_is_one(client: httpx.Client) -> None:
    keys = ["k" * 255, "k" * 254 + "l", "short"]
    first, again = (
        [client.post("/api/v1/batches", json=SWEEP, headers={"Idempotency-Key": key}) for key in keys] for _ in range(2)
    )
    assert [answer.status_code for answer in first + again] == [202] * 6
    ids = [answer.json()["id"] for answer in first]
    assert [answer.json()["id"] for answer in again] == ids
    assert len(set(ids)) == 3
