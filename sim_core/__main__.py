"""`python -m sim_core`: the strategies' table of a scenario, and the paper's margins, in a terminal."""

import argparse
import sys
from pathlib import Path
from time import perf_counter

from pydantic import ValidationError

from sim_core import __version__
from sim_core.catalogue import PAPER_SIGNALS, SIGNALS
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario, reference
from sim_core.scenario.presets import PRESETS, preset
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from sim_core.study import causes, errata
from sim_core.study.margins import change, margins, mean_metrics
from sim_core.study.paper import SEEDS

_COLUMNS = (("rough_road", "rms", "RMS on the rough road"), ("bump", "peak", "peak on the bump"))


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; exit code 0, or 2 for bad input."""
    parser = argparse.ArgumentParser(prog="python -m sim_core", description="Ridelab's simulation core in a terminal.")
    commands = parser.add_subparsers(dest="command")
    run = commands.add_parser("run", help="every strategy over one scenario (the default)")
    # The subcommand's defaults are suppressed: they would overwrite what stood before it.
    for command, default in ((parser, None), (run, argparse.SUPPRESS)):
        command.add_argument("--preset", default=default or "paper", help=f"one of {', '.join(PRESETS)}")
        command.add_argument(
            "--scenario", type=Path, default=default, help="a scenario's JSON file instead of a preset"
        )
        command.add_argument("--baseline", default=default or "passive", help="strategy the changes refer to")
    check = commands.add_parser("margins", help="LQR against LV, as in Tables 9-10, on the paper's scenario")
    check.add_argument("--seeds", type=int, default=10, help="roads 1 to this (10)")
    check.add_argument("--preview", default="lookahead", choices=("lookahead", "wheelbase", "none"))
    commands.add_parser("fields", help="the scenario's reference page, docs/scenario.md")
    commands.add_parser("errata", help="the paper's errata, docs/errata.md")
    why = commands.add_parser("causes", help="why printed changes do not come out, cell by cell")
    why.add_argument("--seeds", type=int, default=SEEDS, help=f"roads 1 to this ({SEEDS})")
    chosen = parser.parse_args(arguments)
    try:
        if chosen.command == "margins":
            _print_margins(chosen.seeds, chosen.preview)
        elif chosen.command == "fields":
            print(reference.page(), end="")
        elif chosen.command == "causes":
            for line in causes.page(range(1, chosen.seeds + 1)):
                print(line)
        elif chosen.command == "errata":
            print(errata.page(), end="")
        else:
            scenario = preset(chosen.preset) if chosen.scenario is None else _load(chosen.scenario)
            _print_run(
                scenario,
                f"preset {chosen.preset}" if chosen.scenario is None else str(chosen.scenario),
                chosen.baseline,
            )
    except ValidationError as error:
        for item in error.errors():
            field = item.get("ctx", {}).get("field") or ".".join(map(str, item["loc"]))
            print(f"{field}: {item['msg']}", file=sys.stderr)
        return 2
    except (RidelabError, OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


def _load(path: Path) -> Scenario:
    return Scenario.model_validate_json(path.read_text(encoding="utf-8"))


def _print_run(scenario: Scenario, name: str, baseline: str) -> None:
    results, times = {}, {}
    for strategy in STRATEGIES:
        start = perf_counter()
        results[strategy] = simulate(scenario, strategy)
        times[strategy] = (perf_counter() - start) * 1000
    if baseline not in results:
        raise ValueError(f"Unknown baseline; there are {', '.join(STRATEGIES)}")
    print(f"Ridelab core {__version__}, {name}; changes against {STRATEGIES[baseline].label}")
    for window, statistic, title in _COLUMNS:
        print(f"\n{title}")
        header = "".join(f"{f'{SIGNALS[s].label} [{SIGNALS[s].unit}]':>36}" for s in PAPER_SIGNALS)
        print(f"{'':26}{header}")
        for strategy, result in results.items():
            cells = "".join(_cell(result, results[baseline], window, s, statistic) for s in PAPER_SIGNALS)
            print(f"{STRATEGIES[strategy].label:26}{cells}")
    print(f"\n{'':26}{'travel time':>14}{'at the bump':>14}{'airborne':>12}{'over travel':>14}{'QPs':>8}{'run':>12}")
    for strategy, result in results.items():
        events = result.events
        print(
            f"{STRATEGIES[strategy].label:26}{result.travel_time:>12.2f} s{result.arrival_speed_kmh:>9.1f} km/h"
            f"{events['airborne_ms']:>9.0f} ms{events['travel_exceeded_mm']:>11.1f} mm"
            f"{events['qp_solves']:>8}{times[strategy]:>9.1f} ms"
        )


def _cell(result: StrategyResult, base: StrategyResult, window: str, signal: str, statistic: str) -> str:
    value, reference = result.metrics[window][signal][statistic], base.metrics[window][signal][statistic]
    against = "" if result is base or not reference else f" ({change(value, reference):+.1f} %)"
    return f"{f'{value:.4g}{against}':>36}"


def _print_margins(seeds: int, preview: str) -> None:
    if seeds < 1:
        raise ValueError("--seeds must be at least 1")
    paper = Scenario()
    scenario = paper.model_copy(update={"mpc": paper.mpc.model_copy(update={"preview": preview})})
    means = mean_metrics(scenario, range(1, seeds + 1))
    cells = margins(means)
    print(f"Ridelab core {__version__}, preset paper, preview {preview}, mean over seeds 1-{seeds}\n")
    print("How much worse LQR is than LV (Tables 9-10)")
    print(f"{'window':12}{'statistic':11}{'signal':22}{'paper':>9}{'ours':>9}  reached")
    for cell in cells:
        verdict = "yes" if cell.reached else f"no, by {cell.paper - cell.ours:.1f} points"
        print(
            f"{cell.window:12}{cell.statistic:11}{cell.signal:22}{cell.paper:>+7.1f} %{cell.ours:>+7.1f} %  {verdict}"
        )
    print(f"{sum(cell.reached for cell in cells)} of {len(cells)} cells reached")
    print("\nPeak on the bump against the passive car")
    print(f"{'':26}" + "".join(f"{SIGNALS[s].symbol:>11}" for s in PAPER_SIGNALS))
    for name in STRATEGIES:
        if name != "passive":
            changes = [
                change(means[name]["bump", "peak", s], means["passive"]["bump", "peak", s]) for s in PAPER_SIGNALS
            ]
            better = "all better" if max(changes) < 0 else "NOT all better"
            print(f"{STRATEGIES[name].label:26}" + "".join(f"{value:>+9.1f} %" for value in changes) + f"  {better}")


if __name__ == "__main__":
    sys.exit(main())
