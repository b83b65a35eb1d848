"""Line charts as SVG: the figures of the manual."""

from collections.abc import Iterator, Mapping
from html import escape
from math import ceil, floor, log10

import numpy as np
from numpy.typing import ArrayLike, NDArray

WIDTH, HEIGHT = 720, 300
LEFT, RIGHT, TOP, BOTTOM = 64, 704, 36, 254
COLOURS = ("#1C5FDF", "#FF5F00", "#5B6670", "#16A87C", "#C93AA0", "#8B5E3C", "#0090A8")
MOST_POINTS = 400  # of a curve, more than a screen shows apart
DOTTED = 60  # a curve of no more points than these has each of them marked
_HEAD = (
    f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
    'role="img" font-family="system-ui, sans-serif" font-size="13" fill="#1f2933">'
)


def chart(curves: Mapping[str, tuple[ArrayLike, ArrayLike]], axes: tuple[str, str], title: str) -> str:
    """A chart of curves over a common axis.

    Args:
        curves: By their names in the legend, x and y of equal length.
        axes: What x and y are, with units.
        title: For whoever does not see it.
    """
    thinned = {name: [np.asarray(each, float)[:: _stride(each)] for each in pair] for name, pair in curves.items()}
    scales = [_ticks(np.concatenate([pair[axis] for pair in thinned.values()])) for axis in (0, 1)]
    lines = [_HEAD, f"<title>{escape(title)}</title>", f'<rect width="{WIDTH}" height="{HEIGHT}" rx="6" fill="#fff"/>']
    for x in scales[0]:
        at = f"{_place(x, scales[0], LEFT, RIGHT):.1f}"
        lines.append(f'<path d="M{at} {TOP}V{BOTTOM}" stroke="#e4e7eb"/>')
        lines.append(f'<text x="{at}" y="{BOTTOM + 18}" text-anchor="middle">{_number(x)}</text>')
    for y in scales[1]:
        at = f"{_place(y, scales[1], BOTTOM, TOP):.1f}"
        lines.append(f'<path d="M{LEFT} {at}H{RIGHT}" stroke="#e4e7eb"/>')
        lines.append(f'<text x="{LEFT - 8}" y="{at}" dy="4" text-anchor="end">{_number(y)}</text>')
    middle = (TOP + BOTTOM) / 2
    lines.append(f'<text x="{(LEFT + RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">{escape(axes[0])}</text>')
    turned = f'transform="rotate(-90 16 {middle})"'
    lines.append(f'<text x="16" y="{middle}" text-anchor="middle" {turned}>{escape(axes[1])}</text>')
    for index, (name, (xs, ys)) in enumerate(thinned.items()):
        places = zip(_place(xs, scales[0], LEFT, RIGHT), _place(ys, scales[1], BOTTOM, TOP), strict=True)
        lines += _curve(name, [f"{x:.1f} {y:.1f}" for x, y in places], index)
    return "\n".join([*lines, "</svg>", ""])


def _curve(name: str, points: list[str], index: int) -> Iterator[str]:
    """The curve, its points where they are few, and its entry in the legend."""
    colour, at = COLOURS[index], LEFT + 128 * index
    yield f'<path d="M{" ".join(points)}" fill="none" stroke="{colour}" stroke-width="1.8"/>'
    if len(points) <= DOTTED:
        yield "".join(f'<circle cx="{x}" cy="{y}" r="2.6" fill="{colour}"/>' for x, y in map(str.split, points))
    yield f'<path d="M{at} 18h18" stroke="{colour}" stroke-width="3"/><text x="{at + 24}" y="22">{escape(name)}</text>'


def _stride(values: ArrayLike) -> int:
    return ceil(np.size(values) / MOST_POINTS)


def _ticks(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Round numbers around the values, four to ten of them."""
    low, high = float(values.min()), float(values.max())
    rough = max(high - low, 1e-9) / 6
    power = 10.0 ** floor(log10(rough))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)
    return np.asarray(np.arange(floor(low / step + 1e-9), ceil(high / step - 1e-9) + 1) * step, np.float64)


def _place(value: ArrayLike, ticks: NDArray[np.float64], first: float, last: float) -> NDArray[np.float64]:
    return np.asarray(first + (np.asarray(value) - ticks[0]) / (ticks[-1] - ticks[0]) * (last - first))


def _number(value: float) -> str:
    return f"{value + 0:.6g}".replace("-", "−")
