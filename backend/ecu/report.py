"""Whether the controller fits the part: memory by its tables' sizes, time by the operations counted in the drive."""

from contextlib import nullcontext
from dataclasses import dataclass

from backend.cost import affordable
from backend.cost.estimate import check_affordable
from backend.ecu import effort
from backend.ecu.effort import CODE, STM32F103
from backend.ecu.models import ChangesByWindow, ControllerPart, ControllerReport, ControllerRow, Operations, StepTime
from sim_core import Scenario, StrategyResult, simulate
from sim_core.catalogue import PAPER_SIGNALS, PAPER_VIEWS
from sim_core.ecu.calibration import Calibration, Checked
from sim_core.ecu.program import CompiledEcu, Ecu, Frame, Reply
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerVariant:
    """A controller that may fit where the scenario's own does not; None takes the scenario's value."""

    prediction: int | None = None
    control: int | None = None
    iterations: int | None = None
    checked: Checked = "all"

    def of(self, scenario: Scenario) -> Scenario:
        """The scenario with this controller, never longer than its own."""
        mpc, hil = scenario.mpc, scenario.hil
        prediction = min(self.prediction or mpc.prediction_horizon, mpc.prediction_horizon)
        control = min(self.control or mpc.control_horizon, mpc.control_horizon, prediction)
        iterations = hil.iterations if self.iterations is None else min(self.iterations, hil.iterations)
        return scenario.model_copy(
            update={
                "mpc": mpc.model_copy(update={"prediction_horizon": prediction, "control_horizon": control}),
                "hil": hil.model_copy(update={"iterations": iterations}),
            }
        )


VARIANTS = (
    ControllerVariant(),
    ControllerVariant(checked="few"),
    ControllerVariant(checked="few", iterations=4),
    ControllerVariant(prediction=20, control=10, checked="few", iterations=4),
    ControllerVariant(prediction=15, control=5, iterations=4),
    ControllerVariant(prediction=10, control=5, iterations=4),
    ControllerVariant(prediction=5, control=3, iterations=4),
)


def report(scenario: Scenario) -> ControllerReport:
    """Report on the scenario's own controller and on smaller ones.

    Raises:
        RidelabError: As `simulate` raises.
    """
    part, rows, seen = STM32F103, [], set()
    simulated = affordable.simulate(scenario, "lv")
    for variant in VARIANTS:
        changed = variant.of(scenario)
        key = (changed.mpc.prediction_horizon, changed.mpc.control_horizon, changed.hil.iterations, variant.checked)
        if key not in seen:
            seen.add(key)
            rows.append(_row(changed, variant.checked, part, simulated))
    return ControllerReport(
        part=part,
        sample_time=scenario.mpc.sample_time,
        cycles_per_operation=effort.CYCLES_PER_OPERATION,
        spread=effort.SPREAD,
        rows=rows,
    )


class CountingEcu(Ecu):
    """The program in this process; `operations` has how many each answer took."""

    def __init__(self, calibration: Calibration) -> None:
        self._program = CompiledEcu(calibration)
        self.operations: list[int] = []

    def exchange(self, frame: Frame) -> Reply:
        """Answer a frame."""
        reply = self._program.exchange(frame)
        self.operations.append(reply.operations)
        return reply


def _row(scenario: Scenario, checked: Checked, part: ControllerPart, simulated: StrategyResult) -> ControllerRow:
    calibration = ecu_calibration(scenario, checked)
    constants, variables = effort.constants(calibration), effort.variables(calibration)
    ecu = CountingEcu(calibration)
    check_affordable(scenario, "lv_hil")
    result = simulate(scenario, LvHil(connect=lambda _: nullcontext(ecu), checked=checked))
    least, most = (effort.seconds(count) for count in (min(ecu.operations), max(ecu.operations)))
    reasons = _reasons(CODE + constants, variables, most, scenario.mpc.sample_time, part)
    return ControllerRow(
        prediction_horizon=calibration.intervals,
        control_horizon=calibration.moves,
        checked=checked,
        checked_rows=calibration.row_count,
        iterations=calibration.iterations,
        code=CODE,
        constants=constants,
        variables=variables,
        operations=Operations(least=min(ecu.operations), most=max(ecu.operations)),
        time=StepTime(least=least, most=most),
        most_iterations=result.events["ecu_most_iterations"],
        unfinished=result.events["qp_failures"],
        fits=not reasons,
        reasons=reasons,
        changes=changes(result, simulated),
    )


def _reasons(flash: int, variables: int, most: float, sample_time: float, part: ControllerPart) -> list[str]:
    """Return why it does not fit; empty where it does."""
    reasons, ram = [], variables + part.stack
    if flash > part.flash:
        reasons.append(f"code and constants take {flash / 1024:.0f} KB of {part.flash / 1024:.0f} KB flash")
    if ram > part.ram:
        reasons.append(f"variables and stack take {ram / 1024:.0f} KB of {part.ram / 1024:.0f} KB RAM")
    if most > sample_time:
        reasons.append(f"the longest step takes about {1000 * most:.3g} ms of {1000 * sample_time:.3g} ms")
    return reasons


def changes(result: StrategyResult, base: StrategyResult) -> ChangesByWindow:
    """Return the changes of Tables 9 and 10's metrics against a base, by window and signal [%]; None against zero."""

    def change(window: str, signal: str, statistic: str) -> float | None:
        new, old = (each.metrics[window][signal][statistic] for each in (result, base))
        return (new / old - 1) * 100 if old else None

    return {
        window: {signal: change(window, signal, statistic) for signal in PAPER_SIGNALS}
        for window, statistic in PAPER_VIEWS
    }
