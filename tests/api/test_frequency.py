"""`POST /frequency` over HTTP: what is asked and answered. The numbers are tests/validation/test_frequency.py's."""

import httpx
import numpy as np
import pytest

from backend.runs.frequency import FrequencyAnswer
from sim_core.frequency.responses import frequency_response
from sim_core.scenario import Scenario
from tests.there import there


def test_responses_are_the_cores(client: httpx.Client) -> None:
    body = {"strategies": ["lqr", "passive"], "frequencies": [1.5, 10], "outputs": ["body_acceleration"]}
    answer = FrequencyAnswer.model_validate(client.post("/api/v1/frequency", json=body).json())
    ours = frequency_response(Scenario(), "lqr", [1.5, 10], ["body_acceleration"])
    lqr, passive = answer.strategies["lqr"], answer.strategies["passive"]
    assert lqr.responses is not None
    assert list(lqr.responses) == ["body_acceleration"]
    magnitude = np.abs(there(ours.responses)["body_acceleration"])
    assert lqr.responses["body_acceleration"].magnitude == pytest.approx(magnitude.tolist(), rel=1e-12)
    assert answer.frequency == [1.5, 10]
    assert passive.margins is None
    # the sampled car's modes are its own, to rounding of the logarithm
    assert there(passive.modes)[0].natural_frequency == pytest.approx(answer.modes[0].natural_frequency, rel=1e-9)


def test_what_is_not_linear_is_null_and_says_why(client: httpx.Client) -> None:
    body = {"scenario": {"hook": {"semi_active": True}}, "strategies": ["skyhook"]}
    skyhook = client.post("/api/v1/frequency", json=body).json()["strategies"]["skyhook"]
    assert skyhook["responses"] is None
    assert "semi-active" in skyhook["reason"]


def test_a_measured_road_has_responses_and_no_spectrum(client: httpx.Client) -> None:
    heights = "distance [m],height [mm]\n" + "".join(f"{x},{x % 3}\n" for x in range(0, 200))
    headers = {"Content-Type": "text/csv"}
    road = client.post("/api/v1/roads", content=heights, headers=headers).json()["id"]
    body = {"scenario": {"road": {"profile": road}}, "strategies": ["lqr"]}
    answer = client.post("/api/v1/frequency", json=body)
    assert answer.status_code == 200, answer.text
    lqr = answer.json()["strategies"]["lqr"]
    assert lqr["responses"] is not None
    assert lqr["psd"] is None
    assert "measured road" in lqr["reason"]
