"""Coefficients of the estimate, fitted to measured runs (`python -m benchmarks.cost_fit`)."""

import sys
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import least_squares, nnls

from backend.cost.binding_limits import LimitShares, bump_share, combine, limit_terms
from backend.cost.estimate import SECONDS, expected_time, work
from benchmarks.cost import Measured, drawn, measure
from sim_core import STRATEGIES, FloatArray

FITTED = 2  # seed of the draws: none is fitted that is judged
SHARE = 0.01  # added to shares before their logarithm: smaller differences do not count
PRIOR = 1.0  # weight of a coefficient's deviation from START (ridge regression)
START = {  # of each cause's first coefficient
    "force": -1.0,
    "travel": -3.0,
    "actuator": -2.0,
    "bump": 0.0,
    "unstable": -2.0,
    "lqr": -1.0,
    "lqr actuator": -2.0,
    "lqr unstable": -2.0,
}


def fit(runs: Sequence[Measured]) -> None:
    """Print both tables as they stand in backend/cost."""
    usable = [run for run in runs if not run.too_expensive]
    seconds = fit_seconds(usable)
    print("SECONDS = {")
    for unit, value in seconds.items():
        print(f'    "{unit}": {value:.2g},')
    print("}\nCOEFFICIENTS = {")
    for strategies in (("lv", "suspension_only"), ("lqr",)):
        for cause, row in fit_limits([run for run in usable if run.strategy in strategies], seconds).items():
            print(f'    "{cause}": ({", ".join(f"{value:.3g}" for value in row)}),')
    print("}")


def fit_seconds(runs: Sequence[Measured]) -> dict[str, float]:
    """Seconds of each unit of work, by least squares of relative errors."""
    units = list(SECONDS)
    rows, costs = [], []
    for run in runs:
        counts = _counts(run)
        rows.append([counts.get(unit, 0.0) for unit in units])
        costs.append(run.cost)
    matrix, cost = np.array(rows), np.array(costs)
    scale = matrix.max(axis=0) + 1e-300
    weight = 1 / (cost + 0.01)
    values, _ = nnls(matrix / scale * weight[:, None], cost * weight)
    return dict(zip(units, (values / scale).tolist(), strict=True))


def _counts(run: Measured) -> dict[str, float]:
    steps = run.time / run.scenario.mpc.sample_time
    measured = LimitShares(
        limited=run.limited / steps,
        solved=run.solved / steps,
        iterations=run.iterations / max(run.solved, 1),
    )
    return work(run.scenario, STRATEGIES[run.strategy], run.time, measured)


def fit_limits(runs: Sequence[Measured], seconds: Mapping[str, float]) -> dict[str, FloatArray]:
    """Coefficients by cause: costs count most, then the shares and iterations they come from; outliers little."""
    times = np.array([expected_time(run.scenario, STRATEGIES[run.strategy]) for run in runs])
    rows = [limit_terms(run.scenario, STRATEGIES[run.strategy], time) for run, time in zip(runs, times, strict=True)]
    inputs = _Standardised(rows)
    start = inputs.start()
    bump = np.array([bump_share(run.scenario, time) for run, time in zip(runs, times, strict=True)])
    free, each_limited, each_solved, each_iteration = _parts(runs, times, seconds)
    steps = np.array([run.time / run.scenario.mpc.sample_time for run in runs])
    limited, solved = np.array([run.limited for run in runs]) / steps, np.array([run.solved for run in runs]) / steps
    cost = np.array([run.cost for run in runs])
    by_osqp = np.array([run.scenario.mpc.solver == "osqp" for run in runs])
    counted = np.array([run.iterations / max(run.solved, 1) for run in runs])

    def residuals(values: FloatArray) -> FloatArray:
        sums = inputs.sums(values)
        at_limit, with_qp, iterations = combine(sums, bump)
        total = free + at_limit * each_limited + with_qp * (each_solved + iterations * each_iteration)
        residuals = [
            np.log(cost / total) * np.where(by_osqp, 2.5, 1.5),
            0.3 * np.log((limited + SHARE) / (at_limit + SHARE)),
            0.3 * np.log((solved + SHARE) / (with_qp + SHARE)),
            PRIOR * (values - start),
        ]
        if "iterations" in sums:
            residuals.append(np.where(counted > 0, 0.4 * np.log(np.maximum(counted, 1.0) / iterations), 0.0))
        return np.concatenate(residuals)

    return inputs.coefficients(least_squares(residuals, start, loss="cauchy", f_scale=1.5).x)


class _Standardised:
    """Terms of many runs, scaled to mean 0 and deviation 1 but for the first of a cause, a constant 1.

    Args:
        rows: `limit_terms` of each run.
    """

    def __init__(self, rows: Sequence[Mapping[str, tuple[float, ...]]]) -> None:
        terms = {cause: np.array([row[cause] for row in rows]) for cause in rows[0]}
        self._means = {cause: np.r_[0.0, matrix[:, 1:].mean(axis=0)] for cause, matrix in terms.items()}
        self._deviations = {cause: np.r_[1.0, matrix[:, 1:].std(axis=0)] for cause, matrix in terms.items()}
        self._terms = {
            cause: (matrix - self._means[cause]) / self._deviations[cause] for cause, matrix in terms.items()
        }
        ends = np.cumsum([0, *(matrix.shape[1] for matrix in terms.values())])
        self._slices = {
            cause: slice(first, last) for cause, first, last in zip(terms, ends[:-1], ends[1:], strict=True)
        }

    def start(self) -> FloatArray:
        """Coefficients to begin with, of all causes one after the other."""
        start = np.zeros(max(part.stop for part in self._slices.values()))
        for cause, part in self._slices.items():
            start[part.start] = START.get(cause, np.log(250.0))
        return start

    def sums(self, values: FloatArray) -> dict[str, FloatArray]:
        """By cause the sum of coefficients times terms of each run."""
        return {cause: self._terms[cause] @ values[part] for cause, part in self._slices.items()}

    def coefficients(self, values: FloatArray) -> dict[str, FloatArray]:
        """By cause the coefficients of the terms as they are."""
        coefficients = {}
        for cause, part in self._slices.items():
            row = values[part] / self._deviations[cause]
            row[0] -= row[1:] @ self._means[cause][1:]
            coefficients[cause] = row
        return coefficients


def _parts(runs: Sequence[Measured], times: FloatArray, seconds: Mapping[str, float]) -> tuple[FloatArray, ...]:
    """Cost [s] without any limit; and beside it of all steps at a limit, with a QP, with one iteration a QP."""

    def cost(**shares: float) -> FloatArray:
        return np.array(
            [
                sum(
                    seconds[unit] * count
                    for unit, count in work(run.scenario, STRATEGIES[run.strategy], time, LimitShares(**shares)).items()
                )
                for run, time in zip(runs, times, strict=True)
            ]
        )

    free, solved = cost(), cost(solved=1.0)
    return free, cost(limited=1.0) - free, solved - free, cost(solved=1.0, iterations=1.0) - solved


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    strategies = ("lv", "suspension_only", "lqr", "lv_hil", "skyhook", "passive")
    fit(measure(drawn(FITTED, each, strategies) for each in range(number)))
