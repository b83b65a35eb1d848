"""`GET /runs/{id}/instant` over HTTP. The numbers are tests/validation/test_instants.py's."""

from typing import Any

import httpx
import pytest

from backend.runs.instants import InstantAnswer
from sim_core.instant import instant
from sim_core.scenario import Scenario

AT_BUMP = 90.3


def test_an_instant_is_the_cores(client: httpx.Client, run: dict[str, Any]) -> None:
    parameters: dict[str, Any] = {"strategy": "lv", "position": AT_BUMP}
    response = client.get(f"/api/v1/runs/{run['id']}/instant", params=parameters)
    answer = InstantAnswer.model_validate(response.json())
    ours = instant(Scenario.model_validate(run["scenario"]), "lv", position=AT_BUMP)
    assert ours.plan is not None
    assert answer.stage == "bump"
    assert answer.forces.command == pytest.approx(ours.command.tolist(), rel=1e-9)
    assert answer.predicted_states is not None
    assert answer.predicted_states[-1] == pytest.approx(ours.plan.states[-1].tolist(), rel=1e-9, abs=1e-12)
    assert answer.predicted_time is not None
    assert len(answer.predicted_time) == len(answer.predicted_states) == len(answer.predicted_forces or []) + 1
    assert answer.cost == pytest.approx(ours.plan.cost, rel=1e-9)
    assert [limit.name for limit in answer.limits] == [limit.name for limit in ours.limits]
    at_time = client.get(f"/api/v1/runs/{run['id']}/instant", params={"strategy": "lv", "time": answer.time})
    assert at_time.json() == response.json()


def test_what_a_law_has_not_is_null(client: httpx.Client, run: dict[str, Any]) -> None:
    def at(strategy: str) -> dict[str, Any]:
        query = {"strategy": strategy, "position": "90.3"}
        answer: dict[str, Any] = client.get(f"/api/v1/runs/{run['id']}/instant", params=query).json()
        return answer

    lqr, passive = at("lqr"), at("passive")
    for answer in (lqr, passive):
        assert answer["predicted_states"] is answer["predicted_forces"] is answer["cost"] is None
        assert answer["estimated_state"] is None
    assert [limit["multiplier"] for limit in lqr["limits"]] == [None, None]
    assert passive["limits"] == []
    assert passive["why"] == "There are no actuators, so there is no force."
