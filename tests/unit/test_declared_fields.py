"""Which value a controller's declared field has in a run: the object's own, or the scenario's."""

from copy import copy
from typing import Any

import pytest

from sim_core import Controller, Seen, option, scenario_field
from sim_core.scenario import Mpc, Scenario
from sim_core.scenario.own import Own


class Assigned(Controller):
    """Has a field of each kind."""

    id, label = "assigned", "Assigned"
    flag: bool = option(default=True)
    front = rear = option(2000.0, ge=0)
    preview = scenario_field("mpc.preview")

    def force(self, seen: Seen) -> Any:
        return 0.0, 0.0


CHANGED = Scenario().model_copy(
    update={
        "mpc": Mpc(preview="none"),
        "own": Own.model_validate({"assigned": {"flag": False, "front": 100.0, "rear": 300.0}}),
    }
)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("flag", True),
        ("front", Assigned.options()["front"].default),
        ("front", float("2000")),
        ("rear", 500.0),
        ("preview", Scenario().mpc.preview),
    ],
)
def test_what_is_assigned_counts_also_where_it_is_the_default(name: str, value: Any) -> None:
    scenarios = {"flag": False, "front": 100.0, "rear": 300.0, "preview": "none"}
    controller = Assigned()
    before = copy(controller)
    setattr(controller, name, value)
    for object_, own in ((controller, {name: value}), (copy(controller), {name: value}), (before, {})):
        ready = object_.for_scenario(CHANGED)
        assert {each: getattr(ready, each) for each in scenarios} == scenarios | own


def test_what_one_scenario_says_is_gone_in_the_next() -> None:
    """What a run's copy took from its scenario is no value of its own; what was assigned to it is."""
    ready = Assigned().for_scenario(CHANGED)
    ready.rear = 500.0
    again = ready.for_scenario(Scenario())
    assert (again.flag, again.front, again.rear, again.preview) == (True, 2000.0, 500.0, "lookahead")
