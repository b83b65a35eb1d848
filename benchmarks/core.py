"""The core: against the plain loop and by strategy."""

from collections.abc import Callable
from statistics import median

import numpy as np

from backend.compute.memory import keep_freed_memory
from benchmarks import plain_osqp_loop
from benchmarks.timing import median_ms, table
from sim_core import Scenario
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.frequency.responses import frequency_response
from sim_core.scenario.presets import preset
from sim_core.simulate import simulate

TOGETHER = ("lv", "lqr", "passive")
PAPER = preset("paper")


def changed(scenario: Scenario, part: str, **fields: object) -> Scenario:
    """Return the scenario with fields of one part replaced."""
    return scenario.model_copy(update={part: getattr(scenario, part).model_copy(update=fields)})


def new_roads(scenario: Scenario, count: int, first_seed: int) -> list[Scenario]:
    """Return the scenario on roads nothing else here drives."""
    return [changed(scenario, "road", seed=first_seed + i) for i in range(count)]


def runs(*names: str) -> Callable[[Scenario], None]:
    """Return work for `median_ms`: those strategies, one after another."""

    def work(scenario: Scenario) -> None:
        for name in names:
            simulate(scenario, name)

    return work


def against_plain_loop() -> None:
    """Print LV, and three strategies together, by sim_core on new roads; LV by the plain loop on its stored road."""
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
    print(f"  outputs differ by at most {max(gaps):.2%} of their peak; steps OSQP left unsolved: {loop.unsolved}")


def by_strategy() -> None:
    """Print each strategy and three together: on a new road, the same again."""
    rows, seed = [], 2000
    for names in (("passive",), ("speed_only",), ("lqr",), ("suspension_only",), ("lv",), TOGETHER):
        new, again = median_ms(runs(*names), new_roads(PAPER, 7, seed)), median_ms(runs(*names), [PAPER] * 7)
        rows.append([" + ".join(names), new, again])
        seed += 100
    table("Milliseconds a run (imports apart)", ["", "new road", "same again"], rows)


def questions() -> None:
    """Print frequency responses with weights that nothing is kept for."""
    cases = [changed(PAPER, "mpc", force_weight=PAPER.mpc.force_weight * (1 + i / 1000)) for i in range(1, 22)]
    time = median_ms(lambda scenario: [frequency_response(scenario, name) for name in TOGETHER], cases)
    print(f"\nFrequency responses, modes and margins of {', '.join(TOGETHER)}: {time:.0f} ms (goal: under 30)")


def run() -> None:
    """Print all of it."""
    keep_freed_memory()  # as a worker does
    against_plain_loop()
    by_strategy()
    questions()
