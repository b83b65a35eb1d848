"""`python -m sim_core.check_file FILE`: what is wrong with its controllers, in words, and pictures of their forces."""

import json
import os
import sys
from contextlib import redirect_stdout, suppress
from dataclasses import asdict, dataclass
from importlib.util import source_from_cache
from pathlib import Path
from typing import Any

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.check_controller import check_controller, failure
from sim_core.control.controller import Controller
from sim_core.controller_files import ControllerFileError, files_of, load_controllers, run_anew
from sim_core.scenario import Bump, Road, Scenario, Vehicle
from sim_core.simulate import simulate

FAULTS, UNUSABLE = 1, 2
MEMORY = 2**31  # a process that checks may have, so that a law that takes ever more is told so [bytes]
_HEAVY = Scenario(
    vehicle=Vehicle(body_mass=1800, pitch_inertia=2300, cg_to_front=1.2, front_spring=35_000, front_damping=4000),
    road=Road(length=60, bump=Bump(start=30)),
)
_WIDTH, _HEIGHT, _MARGIN = 800, 300, 40  # of the picture
_AXLES = (("front", "#1C5FDF"), ("rear", "#C0300C"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """What was found in one controller.

    Attributes:
        id: The controller's.
        label: The controller's.
        faults: A sentence each.
        picture: File with the drawing of its forces, where nothing is wrong.
    """

    id: str
    label: str
    faults: list[str]
    picture: Path | None

    def lines(self) -> list[str]:
        """It in words."""
        head = f"{self.id} ({self.label}): {'this is wrong' if self.faults else 'nothing wrong was found'}"
        where = [] if self.picture is None else [f"its forces on the paper's road: {self.picture}"]
        return [head, *(f"  {each}" for each in [*self.faults, *where])]


def main(file: Path, *, as_json: bool = False) -> int:
    """Print what was found in each controller; the exit code says whether anything is wrong."""
    _bound_memory()
    opened: set[Path] = set()
    sys.addaudithook(lambda event, args: _note_opened(opened, event, args))
    checks = []
    try:
        with redirect_stdout(sys.stderr):  # what the file itself prints is no part of the answer
            controllers = load_controllers(file).values()
            by_all = frozenset(opened)  # by loading: a module is read once, whichever of them uses it
            for each in controllers:
                opened &= by_all
                checks.append(_check(each, file, opened))
    except ControllerFileError as error:
        sys.stdout.write(f"{error.message}\n")
        return UNUSABLE
    except OSError as error:  # of the picture: whatever the law raises is a fault
        sys.stdout.write(f"{error.filename}: it cannot be written: {error.strerror}\n")
        return UNUSABLE
    text = "\n".join(line for each in checks for line in each.lines())
    if as_json:
        text = json.dumps([asdict(each) for each in checks], indent=1, default=str)
    sys.stdout.write(f"{text}\n")
    return FAULTS if any(each.faults for each in checks) else 0


def _note_opened(opened: set[Path], event: str, args: tuple[Any, ...]) -> None:
    """Add a file that is opened for reading: the source of a compiled module."""
    if event != "open" or not isinstance(args[0], str | bytes | os.PathLike):
        return
    if args[2] & (os.O_WRONLY | os.O_CREAT | os.O_TRUNC):
        return
    path = _absolute(os.fsdecode(args[0]))
    with suppress(ValueError):  # not compiled
        path = Path(source_from_cache(path))
    opened.add(path)


def _absolute(path: str | Path) -> Path:
    return Path(os.path.normpath(Path(path).absolute()))  # a link stays one


def _unnamed(opened: set[Path], file: Path, named: set[str]) -> list[str]:
    """Which of the files opened belong to the controllers, and are neither their own file nor named by them.

    They lie in its folder or below, but in no hidden folder and in no library.
    """
    folder = _absolute(file).parent
    own = {_absolute(folder / name) for name in (file.name, *named)}
    libraries = [Path(each) for each in (sys.prefix, sys.base_prefix, Path(__file__).parent)]
    libraries = [each for each in libraries if each.is_relative_to(folder)]
    unnamed = [
        path.relative_to(folder)
        for path in opened - own
        if path.is_relative_to(folder) and path.is_file() and not any(map(path.is_relative_to, libraries))
    ]
    return sorted(path.as_posix() for path in unnamed if not any(part.startswith(".") for part in path.parts))


def _bound_memory() -> None:
    with suppress(ImportError, ValueError, OSError):  # not on Windows, nor where less is allowed already
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))


def _check(controller: type[Controller], file: Path, opened: set[Path]) -> Check:
    """Check it with what is opened meanwhile, and draw its forces beside the file where nothing is wrong."""
    faults, picture = check_controller(controller), None
    if not faults:
        try:
            drawing = _picture(controller)
            anew = run_anew(file.absolute())  # have seen no other car
            if simulate(_HEAVY, controller).summary() != simulate(_HEAVY, anew[controller.id]).summary():
                faults = [
                    "A run depends on the car of an earlier one: numbers of it are kept outside the object, such as a "
                    "gain in the class; make them in start"
                ]
            elif unnamed := _unnamed(opened, file, files_of(anew)):
                faults = [
                    f"It reads {', '.join(unnamed)}, which its files do not name: where that changes, stored "
                    "results stay as they are"
                ]
        except (Exception, SystemExit) as error:  # noqa: BLE001 - the paper's road is longer than the check's
            faults = [failure(error, controller)]
        if not faults:
            picture = file.with_name(f"{controller.id}-forces.svg")
            picture.write_text(drawing, encoding="utf-8")
    return Check(id=controller.id, label=str(controller.label), faults=faults, picture=picture)


def _picture(controller: type[Controller]) -> str:
    """Both forces over the position on the paper's road, as SVG."""
    series = simulate(Scenario(), controller).series
    position = series["position"]
    forces = [series[f"{axle}_force"] for axle, _ in _AXLES]
    most = max(1.0, *(float(np.abs(force).max()) for force in forces))
    lines = [
        f'<polyline fill="none" stroke="{colour}" points="{_points(position, force, most)}"/>'
        f'<text x="{_MARGIN + 80 * index}" y="20" fill="{colour}">{axle}</text>'
        for index, ((axle, colour), force) in enumerate(zip(_AXLES, forces, strict=True))
    ]
    middle = _HEIGHT / 2
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" font-family="sans-serif">'
        f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="white"/>'
        f'<path d="M{_MARGIN} {middle}H{_WIDTH - _MARGIN}" stroke="#868E96"/>{"".join(lines)}'
        f'<text x="{_WIDTH / 2}" y="20">greatest force {most:.0f} N, up on the body</text>'
        f'<text x="{_WIDTH / 2}" y="{_HEIGHT - 10}">position, 0 to {position[-1]:.0f} m</text></svg>\n'
    )


def _points(position: FloatArray, force: FloatArray, most: float) -> str:
    x = _MARGIN + (_WIDTH - 2 * _MARGIN) * (position - position[0]) / (position[-1] - position[0])
    y = _HEIGHT / 2 - (_HEIGHT / 2 - _MARGIN) * force / most
    return " ".join(f"{across:.1f},{down:.1f}" for across, down in zip(x, y, strict=True))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), as_json="--json" in sys.argv[2:]))
