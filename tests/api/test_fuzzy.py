"""`POST /fuzzy` over HTTP. The inference itself is tests/validation/test_fuzzy.py's."""

import httpx
import numpy as np
import pytest

from sim_core.scenario import Fuzzy, Scenario
from sim_core.speed.fuzzy import torque_rules

RULES = [{"if": {"distance": "O"}, "then": "V"}, {"if": {"speed_error": "V"}, "then": "M"}]


@pytest.mark.parametrize("fuzzy", [{}, {"rules": RULES}])
def test_the_surface_is_what_a_drive_computes(client: httpx.Client, fuzzy: dict[str, object]) -> None:
    """Within 0.1 % of full scale: the grid of the torque is coarser than a drive's."""
    answer = client.post("/api/v1/fuzzy", json={"scenario": {"fuzzy": fuzzy}}).json()
    surface, rules = answer["surface"], torque_rules(Fuzzy.model_validate(fuzzy))
    drive = [[rules.share(error, at) for error in surface["speed_error"]] for at in surface["distance"]]
    assert np.abs(np.array(surface["torque"]) - drive).max() < 1e-3
    assert len(answer["rules"]) == (len(RULES) if fuzzy else 25)


def test_what_is_answered_can_be_sent_and_a_narrow_sets_peak_is_drawn(client: httpx.Client) -> None:
    """The paper's sets and rules written out are a scenario's, at whose corners the curves are sampled."""
    answer = client.post("/api/v1/fuzzy", json={}).json()
    inputs = {name: answer[name]["sets"] for name in ("speed_error", "distance")}
    inputs["distance"] = [*inputs["distance"], {"name": "here", "function": "trimf", "corners": [7.01, 7.02, 7.03]}]
    fuzzy = {"inputs": inputs, "output": answer["torque"]["sets"], "rules": answer["rules"]}
    Scenario.model_validate({"fuzzy": fuzzy})
    again = client.post("/api/v1/fuzzy", json={"scenario": {"fuzzy": fuzzy}}).json()
    assert max(again["distance"]["memberships"][-1]) == 1
    assert again["distance"]["sets"] == inputs["distance"]
