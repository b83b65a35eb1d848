"""What the ECU of a scenario knows, as its exported program has it."""

from sim_core.ecu.calibration import Calibration, Checked
from sim_core.scenario import Scenario
from sim_core.simulate import on_dummy_road, prepare
from sim_core.strategies.lv_hil import LvHil


def ecu_calibration(scenario: Scenario, checked: Checked = "all") -> Calibration:
    """Return the tables of `lv_hil`'s program: the scenario's own MPC.

    Args:
        scenario: Whose.
        checked: Which limits of the horizon its program checks.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    controller = LvHil(checked=checked).for_scenario(scenario)
    return controller.calibration(prepare(on_dummy_road(scenario), controller).setup())
