"""A controller of one's own that looks ahead is known so by its key, however its class says that it does."""

import pytest

from backend.cost.estimate import work
from backend.custom_controllers.description import described, proxy_class
from sim_core import Controller, check_controller, load_controllers, simulate
from sim_core.scenario import Bump, Estimation, Lqr, Mpc, Road, Scenario, dotted
from sim_core.scenario.dotted import is_within
from sim_core.strategies import reads, values_read
from sim_core.strategies.effects import conditional_reads
from tests.validation.conditions import may_affect

BASE = Scenario(
    road=Road(length=34, bump=Bump(start=20, width=3)),
    mpc=Mpc(preview="none"),
    lqr=Lqr(preview="lookahead", preview_horizon=12),
    estimation=Estimation(kind="kalman"),
)
OWN_WAYS = """
from sim_core import Controller, PredictiveController, option, scenario_field

class Looks(Controller):
    "Follows the road ahead."
    def force(self, seen):
        heights = seen.preview
        return 2000.0 * (heights[0] - heights[-1]) - 1000.0 * seen.state[4]

class Plain(Looks):
    "Sets plain attributes."
    id, label = "plain", "Plain"
    preview = "lookahead"
    prediction_horizon = 20

class Computed(Looks):
    "Has a property."
    id, label = "computed", "Computed"
    preview = property(lambda self: "lookahead" if self.far else "obstacle")
    prediction_horizon = 20
    far: bool = option(True)

class Optional(Looks):
    "Has an option."
    id, label = "optional", "Optional"
    preview: str = option("lookahead")
    prediction_horizon: int = option(20, ge=1, le=40)

class Scenarios(Looks):
    "Has the scenario's."
    id, label = "scenarios", "Scenarios"
    preview = scenario_field("lqr.preview")
    prediction_horizon = scenario_field("lqr.preview_horizon")

class Overruled(Looks):
    "Declares the scenario's, and its objects overrule it."
    id, label = "overruled", "Overruled"
    preview = scenario_field("mpc.preview")
    prediction_horizon = 20
    def __init__(self, **values):
        super().__init__(**values)
        self.preview = "lookahead"

class Overridden(Looks):
    "Declares the scenario's, and each run overrules it."
    id, label = "overridden", "Overridden"
    preview = scenario_field("mpc.preview")
    prediction_horizon = 20
    def for_scenario(self, scenario):
        ready = super().for_scenario(scenario)
        ready.preview = "lookahead"
        return ready

class Horizon(PredictiveController):
    "Is an MPC that always looks ahead."
    id, label = "horizon", "Horizon"
    preview, prediction_horizon = "lookahead", 25
    def weights(self, stage):
        return (1, 1, 1)
"""
ERRORS_AHEAD = {
    "mismatch.preview_gain": 0.0,
    "mismatch.preview_offset": 0.3,
    "mismatch.preview_noise": 0.01,
    "mismatch.preview_resolution": 0.5,
    "mismatch.preview_delay": 0.05,
    "mpc.expected_offset": 0.3,
    "mpc.expected_noise": 0.01,
    "estimation.knows_preview": False,
}


@pytest.fixture(scope="module")
def own_ways(tmp_path_factory: pytest.TempPathFactory) -> dict[str, type[Controller]]:
    file = tmp_path_factory.mktemp("ways") / "ways.py"
    file.write_text(OWN_WAYS)
    return load_controllers(file)


@pytest.mark.parametrize(
    "way",
    ["plain", "computed", "optional", "scenarios", "overruled", "overridden", "horizon"],
)
def test_who_looks_ahead_has_the_sensors_errors_in_its_key_however_it_says_so(
    own_ways: dict[str, type[Controller]], way: str
) -> None:
    """Also where the service knows the class by its description alone; in a scenario whose MPC looks nowhere."""
    kind = own_ways[way]
    assert check_controller(kind, BASE) == []
    known = [kind, proxy_class(described(kind))]
    keys, results = [values_read(BASE, each) for each in known], [simulate(BASE, kind).comfort["weighted_rms"]]
    plain = BASE.model_dump(mode="json")
    for name, value in ERRORS_AHEAD.items():
        changed = Scenario.model_validate(dotted.with_changes(plain, {name: value}))
        results.append(simulate(changed, kind).comfort["weighted_rms"])
        assert results[-1] not in results[:-1], name
        assert all(values_read(changed, each) != key for each, key in zip(known, keys, strict=True)), name
        assert all(any(is_within(name, part) for part in reads(each)) for each in known)
        assert way == "optional" or all(may_affect(conditional_reads(each), name, BASE) for each in known), name


def test_whether_a_run_is_too_expensive_follows_from_what_its_key_has(own_ways: dict[str, type[Controller]]) -> None:
    """Its horizon is its own: the scenario's is not in the key, and a failure would be stored for all of them."""
    kind, shares = proxy_class(described(own_ways["horizon"])), 1.0
    longer = BASE.model_copy(update={"mpc": Mpc(preview="none", prediction_horizon=200)})
    assert values_read(longer, kind) == values_read(BASE, kind)
    assert work(longer, kind, 5.0, shares) == work(BASE, kind, 5.0, shares)
