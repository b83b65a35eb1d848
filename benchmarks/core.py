"""The core: against the plain loop, by strategy, over roads, and linear against nonlinear cars."""

from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import process_time

import numpy as np

from backend.compute.memory import keep_freed_memory
from benchmarks import plain_osqp_loop
from benchmarks.timing import fresh_process, median_ms, peak_memory_mb, table
from sim_core import Controller, Scenario, load_controllers
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.frequency.responses import frequency_response
from sim_core.instant import instant
from sim_core.metrics.recorder import make_recorder
from sim_core.metrics.windows import windows_of
from sim_core.road.profile import grid_samples
from sim_core.scenario.presets import preset
from sim_core.simulate import prepare, simulate

TOGETHER = ("lv", "lqr", "passive")
PAPER = preset("paper")
EXAMPLES = Path(__file__).parents[1] / "examples" / "controllers"
_COLD = """
from time import process_time
t0 = process_time()
from sim_core.scenario.presets import preset
from sim_core.simulate import simulate
t1 = process_time()
for name in {names!r}:
    simulate(preset("paper"), name)
print((t1 - t0) * 1000, (process_time() - t1) * 1000)
"""
# What importing the core of commit c274e47 and its first LV run took, of the plain loop's time: median of five measured
# in turn with that loop and with the core of today, which took 0.42.
_COLD_BEFORE = 0.86


def changed(scenario: Scenario, part: str, **fields: object) -> Scenario:
    """The scenario with fields of one part replaced."""
    return scenario.model_copy(update={part: getattr(scenario, part).model_copy(update=fields)})


NONLINEAR = changed(PAPER, "vehicle", rebound_ratio=2.5, bump_stop_clearance=0.06, tyre_lift_off=True)


def new_roads(scenario: Scenario, count: int, first_seed: int) -> list[Scenario]:
    """The scenario on roads nothing else here drives."""
    return [changed(scenario, "road", seed=first_seed + i) for i in range(count)]


def runs(*names: str) -> Callable[[Scenario], None]:
    """Work for `median_ms`: those strategies, one after another."""

    def work(scenario: Scenario) -> None:
        for name in names:
            simulate(scenario, name)

    return work


def against_plain_loop() -> None:
    """LV, and three strategies together, by sim_core on new roads; LV by the plain loop on its stored road."""
    runs(*TOGETHER)(PAPER)  # imports and matrices, which the plain loop has too before its time begins
    stored = plain_osqp_loop.load()
    loops = [plain_osqp_loop.run(stored) for _ in range(3)]
    loop = loops[0]
    same_road = simulate(changed(PAPER, "road", seed=plain_osqp_loop.SEED), "lv")
    gaps = (
        float(np.abs(loop.output[:, column] - same_road.series[name][: len(loop.output)]).max())
        / float(np.abs(same_road.series[name]).max())
        for column, name in enumerate(PAPER_SIGNALS)
    )
    theirs, duration, steps = 1000 * median(each.seconds for each in loops), same_road.travel_time, loop.steps
    ours = median_ms(runs("lv"), new_roads(PAPER, 31, 1100))
    together = median_ms(runs(*TOGETHER), new_roads(PAPER, 31, 1200))
    table(
        "LV over the paper's scenario, a new road each time",
        ["", "ms a run", "simulated s per s", "µs a control step"],
        [
            ["sim_core", ours, duration / ours * 1000, ours / steps * 1000],
            ["plain OSQP loop", theirs, duration / theirs * 1000, theirs / steps * 1000],
        ],
    )
    print(f"  sim_core is {theirs / ours:.0f} times faster (goal: 300)")
    print(f"  lv + lqr + passive together are {theirs / together:.0f} times faster (goal: 160)")
    cold = median(sum(fresh_process(_COLD.format(names=("lv",)))) for _ in range(5)) / theirs
    print(f"  imports and one LV run take {cold:.2f} of it, {cold / _COLD_BEFORE:.2f} of what c274e47 took (goal: 0.5)")
    print(f"  outputs differ by at most {max(gaps):.2%} of their peak; steps OSQP left unsolved: {loop.unsolved}")


def by_part() -> None:
    """Where an LV run on a new road spends its time: all but the rest is arithmetic that each new road needs."""
    rows: list[list[str | float]] = []
    for seed, (label, car) in enumerate((("linear", PAPER), ("nonlinear", NONLINEAR))):
        times = []
        for scenario, other in zip(*(new_roads(car, 31, first) for first in (6000 + seed, 6500 + seed)), strict=True):
            run = prepare(other, "lv")
            samples, grid, surface = grid_samples(other.road.length), run.excitation.grid, run.excitation.surface
            recorder = make_recorder(run, windows_of(run))
            begins = [process_time()]
            simulate(scenario, "lv")
            begins.append(process_time())
            np.random.default_rng(other.road.seed).standard_normal(samples)
            begins.append(process_time())
            surface.height(grid.axles)
            begins.append(process_time())
            run.drive(recorder)
            begins.append(process_time())
            times.append(np.diff(begins) * 1000)
        whole, *parts = np.median(times, axis=0).tolist()
        rows.append([label, whole, *parts, whole - sum(parts)])
    head = ["", "all", "random numbers", "heights under the axles", "driving", "the rest"]
    table("Milliseconds of an LV run on a new road", head, rows)


def by_strategy() -> None:
    """Each strategy alone and three together: first in a process, all of it new, on a new road, the same again."""
    rows, imports, seed = [], [], 2000
    for names in (("passive",), ("speed_only",), ("lqr",), ("suspension_only",), ("lv",), TOGETHER):
        cold = [fresh_process(_COLD.format(names=names)) for _ in range(3)]
        imports += [importing for importing, _ in cold]
        others = [
            changed(changed(scenario, "vehicle", body_mass=1300.0 + i), "speed", target_speed_kmh=24 + i / 100)
            for i, scenario in enumerate(new_roads(PAPER, 7, seed + 50))
        ]
        all_new = median_ms(runs(*names), others)
        new, again = median_ms(runs(*names), new_roads(PAPER, 7, seed)), median_ms(runs(*names), [PAPER] * 7)
        rows.append([" + ".join(names), median(first for _, first in cold), all_new, new, again])
        seed += 100
    table(
        "Milliseconds a run (imports apart)",
        ["", "first in a process", "car, speed and road new", "new road", "same again"],
        rows,
    )
    print(f"  importing the core takes {median(imports):.0f} ms")


def by_linearity() -> None:
    """The paper's car against one with unequal dampers, stops and tyres that lift off, in turn on new roads."""
    cars = PAPER, NONLINEAR
    rows: list[list[str | float]] = []
    for seed, name in enumerate(("passive", "lqr", "lv")):
        times: list[list[float]] = [[], []]
        qps: list[list[float]] = [[], []]
        for roads in zip(*(new_roads(car, 31, 4000 + 100 * seed + 50 * i) for i, car in enumerate(cars)), strict=True):
            for i, scenario in enumerate(roads):
                begin = process_time()
                result = simulate(scenario, name)
                times[i].append(1000 * (process_time() - begin))
                qps[i].append(float(result.events["qp_solves"] or 0))
        linear, nonlinear = map(median, times)
        rows.append([name, linear, nonlinear, nonlinear / linear, " and ".join(f"{median(each):g}" for each in qps)])
    table("Linear and nonlinear car", ["", "linear, ms", "nonlinear, ms", "ratio", "QPs a run"], rows)
    print(f"  LV takes {rows[-1][3]:.1f} times as long on the nonlinear car (goal: at most 1.5)")


def over_roads() -> None:
    """Ten roads against one, controllers designed before: with a speed plan of its own each time, or all but the road.

    One road and ten take turns, as their times depend on what else the machine does.
    """

    def drive(first: Scenario, roads: int) -> None:
        for scenario in new_roads(first, roads, first.road.seed):
            runs(*TOGETHER)(scenario)

    drive(PAPER, 2)
    rows, ratios = [], []
    for label, planned in (("new roads, new speed plan", True), ("new roads, everything else known", False)):
        times: dict[int, list[float]] = {1: [], 10: []}
        for i, count in enumerate([1, 10] * 15):
            scenario = changed(PAPER, "road", seed=7000 + 20 * i + 1000 * planned)
            if planned:
                scenario = changed(scenario, "speed", target_speed_kmh=22.5 + (i + 1) / 100)
            begin = process_time()
            drive(scenario, count)
            times[count].append(1000 * (process_time() - begin))
        one, ten = median(times[1]), median(times[10])
        rows.append([label, one, ten, ten / one])
        ratios.append(ten / one)
    table("lv + lqr + passive over several roads", ["", "one, ms", "ten, ms", "ten to one"], rows)
    print(f"  ten roads take {ratios[0]:.1f} times one (goal: at most 5)")


def own_lqr() -> None:
    """LQR as a visitor writes it against ours, in turn on new roads."""
    laws: tuple[str | type[Controller], ...] = "lqr", load_controllers(EXAMPLES / "my_lqr.py")["my_lqr"]
    times: list[list[float]] = [[], []]
    for roads in zip(new_roads(PAPER, 31, 5000), new_roads(PAPER, 31, 5100), strict=True):
        for scenario, law, spent in zip(roads, laws, times, strict=True):
            begin = process_time()
            simulate(scenario, law)
            spent.append(1000 * (process_time() - begin))
    ours, theirs = map(median, times)
    print(f"  LQR of examples/controllers takes {theirs / ours:.2f} times ours (goal: at most 2)")


def _frequencies() -> None:
    """Responses of three strategies, each time with weights that nothing is kept for."""
    cases = [changed(PAPER, "mpc", force_weight=PAPER.mpc.force_weight * (1 + i / 1000)) for i in range(1, 22)]
    time = median_ms(lambda scenario: [frequency_response(scenario, name) for name in TOGETHER], cases)
    print(f"\nFrequency responses, modes and margins of {', '.join(TOGETHER)}: {time:.0f} ms (goal: under 30)")


def _instants() -> None:
    """Instants of a driven run under a moving cursor, in processor time: what ten of them a second take of a core."""
    bump = PAPER.road.bump.start
    rows: list[list[str | float]] = []
    for name in TOGETHER:
        instant(PAPER, name, position=bump)
        spent = []
        for place in range(101):
            begin = process_time()
            instant(PAPER, name, position=bump - 5 + place / 10)
            spent.append(1000 * (process_time() - begin))
        rows.append([name, median(spent), max(spent), median(spent)])
    table("Instants under a moving cursor", ["", "ms an instant", "slowest", "% of a core at ten a second"], rows)


def run() -> None:
    """All of it."""
    print(f"The core's imports take {peak_memory_mb():.0f} MB")
    keep_freed_memory()  # as a worker does
    against_plain_loop()
    by_part()
    by_strategy()
    over_roads()
    by_linearity()
    _frequencies()
    _instants()
    print(f"\nPeak memory: {peak_memory_mb():.0f} MB")
    own_lqr()
