"""What cannot be used is refused with 422, at its place in the body or by its parameter, in words that help."""

from typing import Any

import httpx
import pytest

from tests import wording
from tests.api.refusals import check_refused
from tests.servers.batches import computed

ROAD = "distance [m],height [mm]\n" + "".join(f"{x / 10},{x % 7}\n" for x in range(1400))


@pytest.fixture(scope="module")
def ids(client: httpx.Client, run: dict[str, Any]) -> dict[str, str]:
    """What the cases name: a run, a measured road of 139.9 m, a batch that is done."""
    road = client.post("/api/v1/roads", content=ROAD, headers={"Content-Type": "text/csv"}).json()
    sweep = {"grid": {"road.bump.height": [0.01, 0.02]}}
    batch = computed(client, scenario={"road": {"length": 124}}, strategies=["passive"], sweep=sweep)
    return {"RUN": run["id"], "ROAD": road["id"], "BATCH": batch["id"]}


@pytest.mark.parametrize("asked", wording.asked_in("api_refusals"), ids=lambda asked: asked["path"])
def test_it_is_named_and_nothing_but_names_is_repeated(client: httpx.Client, ids: dict[str, str], asked: Any) -> None:
    answer = check_refused(client, "api_refusals", asked, **ids)
    for sent in ("my colour", "<script>", "HYPERLINK"):
        assert sent not in answer.text
