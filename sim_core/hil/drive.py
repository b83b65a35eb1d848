"""`lv_hil` over a track: designs into tables, sensors ahead, plant in short steps, and the loop around the ECU."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil

import numpy as np

from sim_core.half_car import DISTURBANCES, discrete
from sim_core.hil.calibration import Calibration, Checked, calibrate
from sim_core.hil.channels import STAGES
from sim_core.hil.ecu import Connect
from sim_core.hil.loop import HilLoop, Limits, Tally, Way, short_steps
from sim_core.longitudinal import Drive
from sim_core.mpc import MpcDesign
from sim_core.plant import plant
from sim_core.preview import preview_windows
from sim_core.result import FloatArray
from sim_core.scenario import Scenario
from sim_core.track import Track


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class HilRecord:
    """The record from x = 0 on (plant.RECORDED, short steps, fine steps of one + 1) and the loop's tally."""

    table: FloatArray
    tally: Tally


def calibration(scenario: Scenario, designs: Mapping[str, MpcDesign], checked: Checked = "all") -> Calibration:
    """The ECU's numbers for a scenario."""
    model = discrete(scenario.vehicle, scenario.mpc.sample_time)
    return calibrate(designs, model, scenario.hil, scenario.mpc.force_limit, checked)


def longest_fine_step(sample_time: float, longest: float) -> float:
    """A fine step [s] at most that long, of which whole ones make a short step."""
    short = short_steps(sample_time)
    return sample_time / short / ceil(sample_time / short / longest - 1e-9)


def drive_hil(
    scenario: Scenario,
    known: Calibration,
    motion: Drive,
    way: Track,
    segments: list[tuple[str, int, int]],
    connect: Connect,
) -> HilRecord:
    """Drive the ECU's controller over a track whose fine step is `longest_fine_step`'s."""
    n = short_steps(way.step)
    fine = way.fine // n
    car = plant(scenario.real_vehicle, scenario.actuator, way.step / n, fine)
    disturbance = way.disturbance.reshape(-1, DISTURBANCES * fine)
    stages = [STAGES.index(stage) for stage, first, last in segments for _ in range(first, last)]
    if known.predicts:  # a command is made for the stage in which it takes effect
        stages = [*stages[1:], stages[-1]]
    preview = preview_windows(
        scenario.mpc.preview,
        scenario.road,
        motion,
        way,
        known.preview_length,
        scenario.vehicle.wheelbase,
        scenario.mismatch,
    )
    rate, most = scenario.actuator.rate_limit, scenario.mpc.force_limit
    saturation = scenario.actuator.saturation
    loop = HilLoop(
        plant=car,
        way=Way(forcing=disturbance @ car.E, preview=preview, stages=stages, per_control=n, step=way.step / n),
        calibration=known,
        hil=scenario.hil,
        limits=Limits(
            rate=np.inf if rate is None else rate, force=most if saturation is None else min(most, saturation)
        ),
    )
    with connect(known) as ecu:
        course = loop.run(ecu)
    on_record = slice(way.drive.before * n, None)
    table = car.record(course.states[on_record], course.commands[on_record], disturbance[on_record])
    return HilRecord(table=table, tally=course.tally)
