"""What the ECU of a scenario knows, as its exported program has it."""

from sim_core.ecu.calibration import Calibration, Checked
from sim_core.loop.excitation import step_sizes
from sim_core.loop.run import make_setup
from sim_core.scenario import Scenario
from sim_core.speed.profile import make_speed_profile
from sim_core.strategies import resolve_speed_plan
from sim_core.strategies.lv_hil import LvHil


def ecu_calibration(scenario: Scenario, checked: Checked = "all") -> Calibration:
    """The tables of `lv_hil`'s program: the scenario's own MPC.

    Args:
        scenario: Whose.
        checked: Which limits of the horizon its program checks.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    controller = LvHil(checked=checked).for_scenario(scenario)
    plan = resolve_speed_plan(LvHil, scenario.speed.policy)
    steps = step_sizes(scenario, controller, plan)
    return controller.calibration(make_setup(scenario, controller, make_speed_profile(scenario, plan), steps))
