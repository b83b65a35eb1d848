"""`python -m backend.hil`: build the ECU's program, say whether it fits its part, drive an exported one."""

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from statistics import fmean
from typing import Any

from pydantic import ValidationError

from backend.hil import build, drive, export
from backend.hil.build import EcuError
from backend.hil.link import connected
from backend.hil.realtime import changes
from backend.hil.report import report
from sim_core.catalogue import PAPER_SIGNALS, PAPER_VIEWS
from sim_core.ecu.drive import ecu_calibration
from sim_core.errors import RidelabError
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.study.margins import change


def main(arguments: Sequence[str] | None = None) -> int:
    """Run it; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m backend.hil", description=main.__doc__)
    parser.add_argument("scenario", nargs="?", type=Path, help="JSON file; without one the paper's")
    parser.add_argument("--build", action="store_true", help="only build the program for this machine, and say where")
    parser.add_argument("--export", type=Path, metavar="DIR", help="write the C sources there")
    parser.add_argument("--seeds", type=int, metavar="N", help="lv_hil against lv over roads 1 to N")
    parser.add_argument("--program", type=Path, metavar="FILE", help="drive this program, built from an export")
    chosen = parser.parse_args(arguments)
    try:
        if chosen.build:
            print(build.program())
            return 0
        scenario = Scenario() if chosen.scenario is None else Scenario.model_validate_json(chosen.scenario.read_bytes())
        if chosen.export is not None:
            text = json.dumps(scenario.model_dump(mode="json"), indent=1) + "\n"
            export.written(chosen.export, ecu_calibration(scenario), text)
            print(f"C sources in {chosen.export}; make builds them")
        if chosen.program is not None:
            _drive(scenario, chosen.program)
        elif chosen.seeds is not None:
            _compare(scenario, chosen.seeds)
        elif chosen.export is None:
            for line in lines(report(scenario)):
                print(line)
    except (EcuError, RidelabError) as error:
        print(error.message, file=sys.stderr)
        return 1
    except (OSError, ValidationError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


def _drive(scenario: Scenario, program: Path) -> None:
    result = simulate(scenario, "lv_hil", partial(connected, program=program.resolve()), ecu_calibration(scenario))
    own = drive.simulate(scenario, "lv_hil")
    same = result.summary() == own.summary()
    print(f"{program} drove the scenario; every figure {'is' if same else 'is NOT'} that of Ridelab's own program")
    for window, row in changes(result, drive.simulate(scenario, "lv")).items():
        cells = ", ".join(f"{key} {_percent(value)}" for key, value in row.items())
        print(f"against lv simulated, {window}: {cells}")


def _compare(scenario: Scenario, seeds: int) -> None:
    """Changes of the means over the roads and those of single roads; chance in the loop has the road's seed."""
    found: dict[tuple[str, str, str], list[tuple[float, float]]] = {}
    for seed in range(1, seeds + 1):
        road, hil = (part.model_copy(update={"seed": seed}) for part in (scenario.road, scenario.hil))
        seeded = scenario.model_copy(update={"road": road, "hil": hil})
        one, base = (drive.simulate(seeded, name).metrics for name in ("lv_hil", "lv"))
        for window, statistic in PAPER_VIEWS:
            for key in PAPER_SIGNALS:
                pair = (one[window][key][statistic], base[window][key][statistic])
                found.setdefault((window, statistic, key), []).append(pair)
    for (window, statistic, key), pairs in found.items():
        mean = change(fmean(pair[0] for pair in pairs), fmean(pair[1] for pair in pairs))
        single = [change(*pair) for pair in pairs]
        roads = f"single roads {min(single):+.1f} to {max(single):+.1f} %"
        print(f"{statistic:<5}{window:<11}{key:<20}{mean:>+7.1f} %   {roads}")


def lines(content: Mapping[str, Any]) -> list[str]:
    """A `ControllerReport` as text."""
    part = content["part"]
    head = [
        f"{part['name']}; {part['flash'] // 1024} KB flash, {part['ram'] // 1024} KB RAM",
        f"a step every {1000 * content['sample_time']:g} ms; {content['cycles_per_operation']:g} cycles an operation, "
        f"within {100 * content['spread']:.0f} %",
        "",
        "Np  Nc  limits    it.  ran out  flash KB  RAM KB  operations      ms on the part  fits   worst of Tables 9-10",
    ]
    rows = []
    for row in content["rows"]:
        flash, ram = (row["code"] + row["constants"]) / 1024, row["variables"] / 1024
        operations, time = row["operations"], row["time"]
        cells = [value for window in row["changes"].values() for value in window.values() if value is not None]
        rows.append(
            f"{row['prediction_horizon']:<4}{row['control_horizon']:<4}{row['checked']:<4}{row['checked_rows']:>4}"
            f"{row['iterations']:>7}{row['unfinished']:>9}{flash:>10.1f}{ram:>8.1f}  "
            f"{operations['least']:>6} to{operations['most']:>6}"
            f"  {1000 * time['least']:>5.1f} to {1000 * time['most']:>5.1f}  {'yes' if row['fits'] else 'no':<6}"
            f"{_percent(max(cells, default=None)):>7}"
        )
        rows += [f"    {reason}" for reason in row["reasons"]]
    return head + rows


def _percent(value: float | None) -> str:
    return "none" if value is None else f"{value:+.1f} %"


if __name__ == "__main__":
    raise SystemExit(main())
