"""`python -m sim_core.check_file FILE`: what is wrong with its controllers, in words."""

import json
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout, suppress
from pathlib import Path

from sim_core.check_controller import check_controller, failure
from sim_core.control.controller import Controller
from sim_core.controller_files import ControllerFileError, load_controllers, run_anew
from sim_core.scenario import Bump, Road, Scenario, Vehicle
from sim_core.simulate import simulate

FAULTS, UNUSABLE = 1, 2
MEMORY = 2**31  # a process that checks may have, so that a controller that takes ever more is told so [bytes]
_HEAVY = Scenario(
    vehicle=Vehicle(body_mass=1800, pitch_inertia=2300, cg_to_front=1.2, front_spring=35_000, front_damping=4000),
    road=Road(length=60, bump=Bump(start=30)),
)


def main(file: Path, *, as_json: bool = False) -> int:
    """Print what was found in each controller; the exit code says whether anything is wrong."""
    _bound_memory()
    try:
        with redirect_stdout(sys.stderr):  # what the file itself prints is no part of the answer
            faults = {each: _faults(each, file) for each in load_controllers(file).values()}
    except ControllerFileError as error:
        sys.stdout.write(f"{error.message}\n")
        return UNUSABLE
    if as_json:
        checks = [{"id": each.id, "label": str(each.label), "faults": wrong} for each, wrong in faults.items()]
        text = json.dumps(checks, indent=1)
    else:
        text = "\n".join(line for each, wrong in faults.items() for line in _lines(each, wrong))
    sys.stdout.write(f"{text}\n")
    return FAULTS if any(faults.values()) else 0


def _lines(controller: type[Controller], faults: Sequence[str]) -> list[str]:
    head = f"{controller.id} ({controller.label}): {'this is wrong' if faults else 'nothing wrong was found'}"
    return [head, *(f"  {each}" for each in faults)]


def _bound_memory() -> None:
    with suppress(ImportError, ValueError, OSError):  # not on Windows, nor where less is allowed already
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))


def _faults(controller: type[Controller], file: Path) -> list[str]:
    """Check a controller, then drive it over the paper's road and another car, which may change nothing of it."""
    faults = check_controller(controller)
    if not faults:
        try:
            simulate(Scenario(), controller)
            anew = run_anew(file.absolute())[controller.id]  # has seen no other car
            if simulate(_HEAVY, controller).summary() != simulate(_HEAVY, anew).summary():
                faults = [
                    "A run depends on the car of an earlier one: numbers of it are kept outside the object, such as a "
                    "gain in the class; make them in start"
                ]
        except (Exception, SystemExit) as error:  # noqa: BLE001 - the paper's road is longer than the check's
            faults = [failure(error, controller)]
    return faults


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), as_json="--json" in sys.argv[2:]))
