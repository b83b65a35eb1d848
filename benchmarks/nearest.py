"""Prints what docs/explanation/nearest.md says: what the paper's printed absolutes are compatible with.

`make nearest` prints all of it; `python -m benchmarks.nearest --roads 40 --many 300` is the same. Printed absolutes are
compared with the passive car's and with speed control's alone first: no controller takes part in those 16 values.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context

import numpy as np
from scipy.linalg import expm

from backend.compute.memory import keep_freed_memory
from backend.paper import claims
from backend.paper.absolutes import UNCONTROLLED, distance, printed
from backend.paper.claims import FIGURES, SIMULATED
from backend.paper.interpretations import NEAREST, TYRE_LOADS
from backend.paper.models import Distance
from benchmarks.least_peaks import least_share
from benchmarks.row_4 import drive_as_printed
from benchmarks.timing import table
from sim_core import FloatArray, StrategyResult, simulate
from sim_core.catalogue import BUMP, PAPER_SIGNALS, PEAK, WHOLE
from sim_core.loop.excitation import excite
from sim_core.loop.run import Run
from sim_core.metrics.evaluate import evaluate
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.road import RearAxle
from sim_core.scenario.vehicle import GRAVITY
from sim_core.simulate import prepare
from sim_core.speed.profile import SPEED_CONTROL_PERIOD, SpeedProfile
from sim_core.speed.stages import segments, spans
from sim_core.vehicle.half_car import OUTPUTS, STATES, half_car

DAMPINGS = np.geomspace(100, 200_000, 67)  # [N s/m]
SPEEDS = (20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0)  # [km/h]
BRAKING = 3.0  # [m/s^2]
HEIGHTS_IN_KMH = 3.6  # of the roughness, where a speed in km/h stands for v in Eq. 1: heights × √3.6 = 1.90

Changes = Mapping[str, object]  # dotted name -> value
Values = dict[str, FloatArray]  # strategy -> its eight metrics, in the order of FIGURES
Drive = Callable[[Scenario, str], FloatArray]  # the eight metrics of a run


def changed(changes: Changes) -> Scenario:
    """Return the paper's scenario with other fields."""
    return Scenario.model_validate(dotted.with_changes(Scenario().model_dump(mode="json"), changes))


def metrics_of(result: StrategyResult) -> FloatArray:
    """Return the eight metrics of a run (8,)."""
    return np.array(claims.figures_of(result))


def as_computed(scenario: Scenario, strategy: str) -> FloatArray:
    """Drive as Ridelab does."""
    return metrics_of(simulate(scenario, strategy))


def rear_late(scenario: Scenario, strategy: str) -> FloatArray:
    """Drive with the rear axle on the front one's road 10 ms later, at any speed; windows as with both together."""
    run = prepare(scenario, strategy)
    grid, excitation = run.excitation.grid, run.excitation
    time = grid.time[0] + grid.fine_step * np.arange(grid.axles.shape[1])
    axles = np.stack([run.speed_profile.at(time)[0], run.speed_profile.at(time - 0.01)[0]])
    return metrics_as_driven(replace(run, excitation=replace(excitation, height=excitation.surface.height(axles))))


def metrics_as_driven(run: Run) -> FloatArray:
    """Drive a prepared run."""
    return metrics_of(evaluate(run))


def braking_at_once(scenario: Scenario, strategy: str) -> FloatArray:
    """Brake with BRAKING from the detection on until the target speed, without the speed controller and its lag."""
    run, h = prepare(scenario, strategy), SPEED_CONTROL_PERIOD
    if run.plan == "constant":
        return metrics_as_driven(run)
    initial, detection = scenario.speed.initial, scenario.braking_start
    time = h * np.arange(-1, (scenario.road.length - detection) / scenario.speed.target // h)
    speed = np.clip(initial - BRAKING * time, scenario.speed.target, initial)
    distance = np.concatenate([[0.0], np.cumsum(h * (speed[1:] + speed[:-1]) / 2)])
    profile = SpeedProfile(
        initial_speed=initial,
        time=detection / initial + time,
        position=detection - h * initial + distance,
        speed=speed,
        pressure=np.zeros_like(time),
        braking=-np.diff(speed, append=speed[-1]) / h,
    )
    excitation = excite(scenario.road, scenario.rear_axle_offset, profile, run.steps.control, run.steps.fine)
    stages = spans(scenario, run.plan, profile)
    stretches = segments(stages, excitation.grid.position)
    run = replace(run, speed_profile=profile, excitation=excitation, stages=stages, segments=stretches)
    return metrics_as_driven(run)


def with_strut_force(scenario: Scenario, strategy: str) -> FloatArray:
    """Take for a tyre load the tyre's and the strut's force together, both pressing."""
    series, car = simulate(scenario, strategy).series, scenario.vehicle
    step = series["time"][1] - series["time"][0]
    signals = {name: series[name] for name in PAPER_SIGNALS}
    for axle in ("front", "rear"):
        travel = series[f"{axle}_deflection"]
        spring, damping = getattr(car, f"{axle}_spring"), getattr(car, f"{axle}_damping")
        pressing = -spring * travel - damping * np.gradient(travel, step)
        signals[f"{axle}_tyre_load"] = signals[f"{axle}_tyre_load"] + pressing
    return in_windows(scenario, series["position"], signals)


def dropped(scenario: Scenario, strategy: str) -> FloatArray:
    """Start at x = 0 with springs and tyres that carry nothing, so that the car settles under its weight."""
    series, car = simulate(scenario, strategy).series, scenario.vehicle
    model, static = half_car(car), np.array(car.static_loads)
    wheels = GRAVITY * np.array([car.front_wheel_mass, car.rear_wheel_mass])
    state = np.zeros(STATES)
    state[:2] = (static - wheels) / [car.front_spring, car.rear_spring]
    state[2:4] = static / [car.front_tyre_stiffness, car.rear_tyre_stiffness]
    step = series["time"][1] - series["time"][0]
    onward, settling = expm(model.A * step), np.empty((len(series["time"]), len(OUTPUTS)))
    for row in settling:
        row[:] = model.C @ state
        state = onward @ state
    rows = {name: OUTPUTS.index(name) for name in PAPER_SIGNALS}
    return in_windows(scenario, series["position"], {name: series[name] + settling[:, i] for name, i in rows.items()})


def in_windows(scenario: Scenario, position: FloatArray, signals: Mapping[str, FloatArray]) -> FloatArray:
    """Return the eight metrics of signals without jumps (n,) over positions (n,)."""
    start, left = scenario.road.bump.start, scenario.bump_left
    rough, bump = position <= start, (position >= start) & (position <= left)
    rms = [np.sqrt(np.mean(signals[name][rough] ** 2)) for name in PAPER_SIGNALS]
    return np.array([*rms, *(np.abs(signals[name][bump]).max() for name in PAPER_SIGNALS)])


@dataclass(frozen=True)
class Assumptions:
    """One way to read the paper: its assumptions, the fields that they change, and how tyre loads are taken."""

    title: str
    count: int
    changes: Changes
    loads: float = 1.0
    drive: Drive = as_computed

    def values(self, seed: int, strategies: Sequence[str]) -> Values:
        """Return the metrics of each strategy on one road, tyre loads times `loads`."""
        scenario, factor = changed({**self.changes, "road.seed": seed}), np.array([1, 1, self.loads, self.loads] * 2)
        return {name: factor * self.drive(scenario, name) for name in strategies}


KMH_25: Changes = {"speed.target_speed_kmh": 25}
TOGETHER: Changes = {**KMH_25, "road.rear_axle": "together"}
CLASS_C: Changes = {"road.roughness": 256e-6}
IN_KMH: Changes = {"road.roughness": 64e-6 * HEIGHTS_IN_KMH}
FREE: Changes = {"mpc.force_limit": 100_000, "mpc.deflection_limit": 1}
HALF: Changes = {"vehicle.body_mass": 635, "vehicle.pitch_inertia": 768.35}
NEAREST_SET = Assumptions("together, class C, loads ×2", 3, {**TOGETHER, **CLASS_C}, 2)
INTERPRETATIONS = (
    Assumptions("rear 10 ms late, km/h in Eq. 1, loads ×2", 3, {**TOGETHER, **IN_KMH}, 2, rear_late),
    NEAREST_SET,
    Assumptions("together, km/h in Eq. 1, loads ×2", 3, {**TOGETHER, **IN_KMH}, 2),
    Assumptions("together, class C, load = tyre and strut force", 3, {**TOGETHER, **CLASS_C}, drive=with_strut_force),
    Assumptions("delayed, class C, loads ×2", 2, {**KMH_25, **CLASS_C}, 2),
    Assumptions("delayed, an unsettled start, loads ×2", 2, KMH_25, 2, dropped),
    Assumptions("half the body's mass, together, loads ×2", 3, {**TOGETHER, **HALF}, 2),
    Assumptions("loads ×2 alone", 1, KMH_25, 2),
    Assumptions("class C alone", 1, {**KMH_25, **CLASS_C}),
    Assumptions("together alone", 1, TOGETHER),
    Assumptions("as Ridelab reads the paper, 25 km/h", 0, KMH_25),
    Assumptions("as Ridelab reads the paper", 0, {}),
)


def over_roads(pool: Executor, assumed: Assumptions, roads: range, strategies: Sequence[str]) -> Values:
    """Return the metrics of each strategy on each road (roads, 8)."""
    each = list(pool.map(partial(assumed.values, strategies=strategies), roads, chunksize=4))
    return {name: np.array([values[name] for values in each]) for name in strategies}


def factor_of(values: Values) -> Distance:
    """Return the median and mean factor between means over roads and what is printed."""
    return distance(
        {name: dict(zip(FIGURES, each.mean(axis=0).tolist(), strict=True)) for name, each in values.items()}
    )


def away(values: Values) -> list[str]:
    """Return both in words."""
    factor = factor_of(values)
    return [f"{factor.median:.2f}", f"{factor.mean:.2f}"]


def bare_bump(speed_kmh: float, rear_axle: RearAxle, damping: float | None = None, window: str = BUMP) -> FloatArray:
    """Return the passive car's peaks of the four signals, driven over the bump of a smooth road (4,)."""
    changes: dict[str, object] = {
        "road.roughness": 0,
        "road.rear_axle": rear_axle,
        "speed.initial_speed_kmh": speed_kmh,
    }
    if damping is not None:
        changes |= {"vehicle.front_damping": damping, "vehicle.rear_damping": damping}
    metrics = simulate(changed(changes), "passive").metrics[window]
    return np.array([metrics[signal][PEAK] for signal in PAPER_SIGNALS])


def load_bounds(pool: Executor) -> None:
    """Print the most that a tyre load's peak is over the body acceleration's, whatever the damping."""
    rows = []
    for axle in ("in_turn", "together"):
        for window in (BUMP, WHOLE):
            peaks = pool.map(partial(bare_bump, 50.0, axle, window=window), DAMPINGS.tolist(), chunksize=8)
            peak = np.array(list(peaks))
            rows.append([f"{axle}, {window}", *(f"{each:.0f}" for each in (peak[:, 2:] / peak[:, :1]).max(axis=0))])
    body, _, *loads = (printed("passive", each) for each in FIGURES[4:])
    rows.append(["printed", *(f"{load / body:.0f}" for load in loads)])
    title = "Peak tyre load over peak body acceleration, at most, of damping 100 to 200,000 N s/m [kg]"
    table(title, ["", "front", "rear"], rows)


def free_fit(pool: Executor, roads: range) -> None:
    """Print which heights of the road and which factor of tyre loads come nearest with both axles together."""
    best = None
    for heights in np.arange(1.0, 2.65, 0.1).tolist():
        assumed = Assumptions("", 0, {**TOGETHER, "road.roughness": 64e-6 * heights**2})
        values = over_roads(pool, assumed, roads, UNCONTROLLED)
        for loads in np.arange(1.0, 3.05, 0.1).tolist():
            factor = np.array([1, 1, loads, loads] * 2)
            mean = factor_of({name: factor * each for name, each in values.items()}).mean
            best = min(best or (mean, heights, loads), (mean, heights, loads))
    assert best is not None  # noqa: S101 - there are heights
    mean, heights, loads = best
    print(f"\nA free fit, axles together: heights ×{heights:.1f}, loads ×{loads:.1f}; mean factor {mean:.2f}")


def without_a_fit(pool: Executor, roads: range) -> None:
    """Print the argument that fits nothing: pitch over body acceleration, the bare bump, loads over acceleration."""
    delayed, together = (
        over_roads(pool, Assumptions("", 0, changes), roads, UNCONTROLLED) for changes in (KMH_25, TOGETHER)
    )
    rows = []
    for name in UNCONTROLLED:
        for view, (body, pitch) in (("RMS", (0, 1)), ("peak", (4, 5))):
            means = [values[name].mean(axis=0) for values in (delayed, together)]
            shares = [mean[pitch] / mean[body] for mean in means]
            claimed = printed(name, FIGURES[pitch]) / printed(name, FIGURES[body])
            rows.append([f"{name}, {view}", *(f"{each:.2f}" for each in (claimed, *shares))])
    table("Pitch over body acceleration [rad/m]", ["", "printed", "delayed", "together"], rows)
    peaks = [
        [f"{speed:g} km/h", *(f"{bare_bump(speed, axle)[0]:.2f}" for axle in ("in_turn", "together")), claimed]
        for speed, claimed in ((50.0, "12.6"), (25.0, "6.76"))
    ]
    table("Peak body acceleration on the bare bump [m/s²]", ["", "delayed", "together", "printed"], peaks)
    load_bounds(pool)
    step = printed("lv", FIGURES[6]) / Scenario().vehicle.front_tyre_stiffness
    print(f"\nA step in the road loads a tyre at once: LV's front peak allows {1000 * step:.0f} mm at the bump's ends")


def interpretations(pool: Executor, roads: range) -> None:
    """Print by which factor each interpretation is from the 16 printed values without control."""
    rows = [[each.title, each.count, *away(over_roads(pool, each, roads, UNCONTROLLED))] for each in INTERPRETATIONS]
    table(f"Factor from the 16 values, {len(roads)} roads", ["", "assumptions", "median", "mean"], rows)


def nearest(pool: Executor, roads: range) -> None:
    """Print the nearest interpretation's values over many roads, with the spread of one, beside the printed ones."""
    values = over_roads(pool, NEAREST_SET, roads, UNCONTROLLED)
    rows, shares = [], []
    for name in UNCONTROLLED:
        mean, spread = values[name].mean(axis=0), values[name].std(axis=0, ddof=1)
        for index, (window, statistic, signal) in enumerate(FIGURES):
            claimed = printed(name, FIGURES[index])
            numbers = f"{mean[index]:.4g}", f"{100 * spread[index] / mean[index]:.0f} %", f"{claimed:g}"
            share, deviations = mean[index] / claimed, (claimed - mean[index]) / spread[index]
            rows.append([f"{name} {window}.{signal}.{statistic}", *numbers, f"{share:.2f}", f"{deviations:+z.1f}"])
            shares.append(share)
    head = ["", "ours", "one road", "printed", "ours/printed", "printed off, in one road's σ"]
    table(f"{NEAREST_SET.title}, {len(roads)} roads", head, rows)
    for most in (1.15, 1.25):
        near = sum(1 / most <= each <= most for each in shares)
        print(f"  within a factor of {most}: {near} of {len(shares)}")
    at_once = over_roads(pool, replace(NEAREST_SET, drive=braking_at_once), roads, ("speed_only",))
    means = " ".join(f"{each:.4g}" for each in at_once["speed_only"].mean(axis=0))
    print(f"\nSpeed control that brakes with {BRAKING:g} m/s² at once, in the same order: {means}")


def changes_reached(values: Values) -> list[str]:
    """Return how many printed changes are reached, and how many are met, in words."""
    judged = claims.judge({name: dict(zip(FIGURES, each.T.tolist(), strict=True)) for name, each in values.items()})
    near = sum(abs(item.change.value - item.cell.claim) <= claims.AGREEMENT for item in judged)
    return [f"{claims.count(judged)['reached']} of {len(judged)}", str(near)]


def controls(pool: Executor) -> None:
    """Print how the controls come out under it, none of them fitted: factors of all 40 values, changes reached."""
    rows = []
    for title, changes, loads, sets in (
        ("nearest, full preview", {**TOGETHER, **CLASS_C}, 2.0, (range(1, 21), range(21, 61))),
        ("nearest, seeing the bump alone", {**TOGETHER, **CLASS_C, "mpc.preview": "obstacle"}, 2.0, (range(1, 21),)),
        ("nearest, without preview", {**TOGETHER, **CLASS_C, "mpc.preview": "none"}, 2.0, (range(1, 21),)),
        ("as Ridelab reads the paper, without limits", {}, 1.0, (range(1, 21),)),
    ):
        assumed = Assumptions(title, 0, {**FREE, **changes}, loads=loads)
        for roads in sets:
            values = over_roads(pool, assumed, roads, SIMULATED)
            rows.append([f"{title}, roads {roads[0]}-{roads[-1]}", *away(values), *changes_reached(values)])
    table("All 40 simulated values", ["", "median", "mean", "changes reached", "within ±10 points"], rows)


def falling_pitch(pool: Executor) -> None:
    """Print for which damping the pitch peak on the bare bump falls with speed, as section 2.2.3 has it."""
    rows = []
    for axle in ("in_turn", "together"):
        for damping in (600.0, 1500.0, 6000.0):
            peaks = np.array(list(pool.map(partial(bare_bump, rear_axle=axle, damping=damping), SPEEDS)))
            pitch = " ".join(f"{each:.2f}" for each in peaks[:, 1])
            at_50 = peaks[SPEEDS.index(50.0)]
            rows.append([f"{axle}, {damping:g} N s/m", pitch, f"{at_50[0]:.1f}", f"{at_50[1]:.2f}"])
    head = ["", f"pitch peak at {', '.join(f'{each:g}' for each in SPEEDS)} km/h", "body at 50", "pitch at 50"]
    table("Peaks on the bare bump (Table 5 prints 12.6 m/s² and 6.39 rad/s² at 50 km/h)", head, rows)


def other_bumps() -> None:
    """Print what a faster or higher bump does to the passive car, and what any forces at all could make of it."""
    claimed = [printed("suspension_only", each) for each in FIGURES[4:]]
    passive = [f"{printed('passive', each):g}" for each in FIGURES[4:6]]
    rows = [["printed", *passive, "1", "1"]]
    for title, changes in (("50 m/s", {"speed.initial_speed_kmh": 180}), ("0.2 m high", {"road.bump.height": 0.2})):
        for axle in ("in_turn", "together"):
            scenario = changed({**changes, "road.roughness": 0, "road.rear_axle": axle})
            metrics = simulate(scenario, "passive").metrics[BUMP]
            peaks = [f"{metrics[signal][PEAK]:.1f}" for signal in PAPER_SIGNALS[:2]]
            shares = [f"{least_share(scenario, claimed, travel):.2f}" for travel in (np.inf, 0.08)]
            rows.append([f"{title}, {axle}", *peaks, *shares])
    head = ["", "passive body", "passive pitch", "any forces", "any forces, 80 mm travel"]
    table("Peaks of other bumps, bare [m/s², rad/s²], and the least share of Table 5's suspension control", head, rows)


def row_4(roads: range) -> None:
    """Print what row 4 of Eq. 7 as printed does under the nearest interpretation."""
    assumed, rows = replace(NEAREST_SET, changes={**NEAREST_SET.changes, **FREE}), []
    for title, start in (("corrected", keep_freed_memory), ("as printed", drive_as_printed)):
        # A process that is spawned, not forked, has kept nothing of the other car.
        with ProcessPoolExecutor(mp_context=get_context("spawn"), initializer=start) as pool:
            values = over_roads(pool, assumed, roads, SIMULATED)
        parts = [{name: values[name] for name in names} for names in (UNCONTROLLED, values.keys() - UNCONTROLLED)]
        rows.append([title, *(f"{factor_of(each).median:.3f}" for each in parts), *changes_reached(values)])
    head = ["", "without control", "with it", "changes reached", "within ±10 points"]
    table(f"Row 4 of Eq. 7: median factor from the printed values, {len(roads)} roads", head, rows)


def main() -> None:
    """Print every part."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.nearest", description=__doc__.partition("\n")[0])
    parser.add_argument("--roads", type=int, default=40, help="for the table of interpretations")
    parser.add_argument("--many", type=int, default=300, help="for the nearest one")
    options = parser.parse_args()
    assert NEAREST.otherwise[TYRE_LOADS] == "doubled"  # noqa: S101 - what is printed is the paper page's
    with ProcessPoolExecutor(initializer=keep_freed_memory) as pool:
        without_a_fit(pool, range(1, options.roads + 1))
        interpretations(pool, range(1, options.roads + 1))
        free_fit(pool, range(1, 11))
        nearest(pool, range(1, options.many + 1))
        controls(pool)
        falling_pitch(pool)
    other_bumps()
    row_4(range(1, 21))


if __name__ == "__main__":
    main()
