"""`python -m sim_core.check_file FILE`: what is wrong with its controllers, in words, and pictures of their forces."""

import sys
from contextlib import redirect_stdout, suppress
from pathlib import Path

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.check_controller import check_controller
from sim_core.control.controller import Controller
from sim_core.controller_files import ControllerFileError, load_controllers
from sim_core.scenario import Scenario
from sim_core.simulate import simulate

FAULTS, UNUSABLE = 1, 2
MEMORY = 2**31  # a process that checks may have, so that a law that takes ever more is told so [bytes]
_WIDTH, _HEIGHT, _MARGIN = 800, 300, 40  # of the picture
_AXLES = (("front", "#1C5FDF"), ("rear", "#C0300C"))


def main(file: Path) -> int:
    """Print a line for each controller and each fault; the exit code says whether there are any."""
    _bound_memory()
    with redirect_stdout(sys.stderr):  # what the file itself prints is no part of the answer
        try:
            lines, faults = _checked(file)
        except ControllerFileError as error:
            lines, faults = [error.message], UNUSABLE
    sys.stdout.write("\n".join([*lines, ""]))
    return faults


def _bound_memory() -> None:
    with suppress(ImportError, ValueError, OSError):  # not on Windows, nor where less is allowed already
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))


def _checked(file: Path) -> tuple[list[str], int]:
    lines, faults = [], 0
    for name, controller in load_controllers(file).items():
        wrong = check_controller(controller)
        lines.append(f"{name} ({controller.label}): {'nothing wrong was found' if not wrong else 'this is wrong'}")
        lines += [f"  {each}" for each in wrong]
        if wrong:
            faults = FAULTS
            continue
        picture = file.with_name(f"{name}-forces.svg")
        picture.write_text(_picture(controller), encoding="utf-8")
        lines.append(f"  its forces on the paper's road: {picture}")
    return lines, faults


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
    sys.exit(main(Path(sys.argv[1])))
