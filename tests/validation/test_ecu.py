"""The ECU's algorithm against a QP solver, its C program against the algorithm, `lv_hil` against `lv` and the paper."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

from sim_core import Hil, Mpc, Scenario, Seen
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import STAGES, highest_code
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.ecu.program import in_process
from sim_core.loop.preview import sliding_forecast
from sim_core.simulate import prepare, simulate
from sim_core.speed.stages import Segment
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES
from tests.validation.ecu_drives import DRIVES, HARD, SHORT, SLOWER
from tests.validation.reference.ecu import ModelEcu


def test_a_program_that_checks_few_limits_has_the_commands_and_every_third_deflection() -> None:
    every, few = ecu_calibration(Scenario(), "all"), ecu_calibration(Scenario(), "few")
    moves, horizon = 40, 30
    rows = [0, 1, *range(moves + 2, moves + horizon, 3), *range(moves + horizon + 2, moves + 2 * horizon, 3)]
    assert few.axles == (-1, -1, *[0] * 10, *[1] * 10)
    np.testing.assert_array_equal(few.bounds, every.bounds[rows])
    for ours, all_of_them in zip(few.stages, every.stages, strict=True):
        np.testing.assert_array_equal(ours.rows, all_of_them.rows[rows])
        np.testing.assert_array_equal(ours.gram, all_of_them.gram[np.ix_(rows, rows)])


def test_the_ecus_optimum_is_the_qps() -> None:
    """Random states, roads and previous forces in every stage; the QP's answers are exact to about 1e-9 N here."""
    scenario = Scenario(mpc=HARD, hil=Hil(compensation="none", iterations=200))
    rng, run = np.random.default_rng(1), prepare(scenario, "lv")
    calibration, car = ecu_calibration(scenario), run.car()
    horizon = scenario.mpc.prediction_horizon
    iterations = []
    for i in range(150):
        state = rng.standard_normal(STATES) * np.array([0.03, 0.03, 0.005, 0.005, 0.3, 0.3, 0.5, 0.5])
        scale = np.array([[0.06], [0.06], [0.1]])
        preview = np.cumsum(rng.standard_normal((DISTURBANCES, horizon)), axis=1) * scale
        previous = rng.uniform(-1.5, 1.5, FORCES)
        ecu = ModelEcu(calibration, previous=previous)
        rows, count, finished, slack = ecu.optimum(i % 3, state, preview)
        lv = run.controller.for_scenario(scenario)
        lv.start(run.setup())
        forecast = sliding_forecast(preview, horizon, np.zeros((2, 1)))
        inputs = replace(run.inputs(forecast), segments=[Segment(STAGES[i % 3], 0, 1)])
        force = lv.force(Seen(inputs, car, 0, 0, state, previous * 1000))
        assert force is not None
        lv.end()
        if finished:
            np.testing.assert_allclose(rows[:FORCES] * 1000, force, atol=1e-6)
            assert max(slack, 0) / 100 == pytest.approx(lv.report.max_slack, abs=1e-9)
            iterations.append(count)
    assert len(iterations) > 120, "few need more limits at once than the program has room for"
    assert np.mean(iterations) > 5


class Both(Ecu):
    """Asks the program and, with the same memory, the model; the drive follows the program."""

    def __init__(self, program: Ecu, calibration: Calibration) -> None:
        self._program, self._calibration = program, calibration
        self._previous = np.zeros(FORCES)
        self.pairs: list[tuple[Reply, Reply]] = []

    def exchange(self, frame: Frame) -> Reply:
        modelled = ModelEcu(self._calibration, previous=self._previous).exchange(frame)
        reply = self._program.exchange(frame)
        assert reply is not None
        self._previous = np.array(reply.commands) * self._calibration.command_step
        self.pairs.append((reply, modelled))
        return reply


@pytest.mark.parametrize(("mpc", "hil"), DRIVES.values(), ids=DRIVES)
def test_the_c_program_does_what_the_model_does_over_a_whole_run(mpc: Mpc, hil: Hil) -> None:
    """Float32 against double: the same limits in the same order, forces within 0.3 N (2e-4 of the limit).

    Seven digits over sums of a hundred products of kilonewtons; measured 0.06 N.
    """
    both: list[Both] = []

    @contextmanager
    def connect(calibration: Calibration) -> Iterator[Ecu]:
        with in_process(calibration) as program:
            both.append(Both(program, calibration))
            yield both[0]

    scenario = Scenario(road=SHORT, speed=SLOWER, mpc=mpc, hil=hil)
    simulate(scenario, LvHil(connect=connect))
    step = mpc.force_limit / highest_code(hil.bits)
    pairs = both[0].pairs
    assert len(pairs) > 500
    for reply, modelled in pairs:
        assert (reply.limited, reply.iterations, reply.unfinished) == (
            modelled.limited,
            modelled.iterations,
            modelled.unfinished,
        )
        assert np.abs(np.subtract(reply.commands, modelled.commands)).max() * step <= 0.3 + step
        assert reply.slack == pytest.approx(modelled.slack, abs=1e-4)
    if mpc is HARD:
        assert sum(reply.limited for reply, _ in pairs) > 20
    assert any(reply.unfinished for reply, _ in pairs) == (hil.iterations == 3)


def test_with_the_paper_every_hil_figure_is_within_8_percent_and_without_compensation_it_is_not() -> None:
    """The bound is issue 4's; docs/how-to/hil.md has seeds 1 to 20."""

    def changes(scenario: Scenario) -> list[float]:
        hil, lv = simulate(scenario, "lv_hil"), simulate(scenario, "lv")
        cells = (("rough_road", "rms"), ("bump", "peak"))
        return [
            100 * (hil.metrics[window][key][statistic] / lv.metrics[window][key][statistic] - 1)
            for window, statistic in cells
            for key in PAPER_SIGNALS
        ]

    assert np.abs(changes(Scenario())).max() <= 8
    uncompensated = changes(Scenario(hil=Hil(compensation="none")))
    assert min(uncompensated) > 8, "answering the past costs more than that in every figure"
