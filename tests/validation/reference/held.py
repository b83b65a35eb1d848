"""A run a second time in steps of 0.02 ms, and its metrics by definition: what the core's must be.

The car is the reference's (absolute coordinates), stepped by its own matrices; metrics are trapezoids over samples
0.02 ms apart, with the value before and the value after each jump of the forces. Taken from the core: the road's
heights, the speed plan and the controllers' commands, each of which is checked elsewhere.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from sim_core import Actuator, Scenario, Seen, StrategyResult
from sim_core.loop.closed_loop import DelayedLoop
from sim_core.road.profile import road_profile
from sim_core.simulate import prepare, simulate
from sim_core.speed.profile import SpeedProfile
from tests.results import metrics
from tests.validation.caught import returned
from tests.validation.reference.sampled import interval, to_deflections
from tests.validation.reference.vehicle import OUTPUTS, behind, state_space
from tests.validation.reference.weighting import weighted

Array = NDArray[np.float64]
STEP = 2e-5  # [s]


@dataclass(frozen=True)
class Held:
    """A run from x = 0 on, one row a held force: values at its start, each 0.02 ms, and at its end (rows, n + 1)."""

    time: Array
    signals: dict[str, Array]
    speed: tuple[Array, Array]  # of both deflections [m/s]

    def metrics(self, scenario: Scenario, speed_profile: SpeedProfile) -> dict[str, float]:
        """`window.signal.statistic` and `comfort.…` as the core names them."""
        bump = scenario.road.bump
        arrival = speed_profile.time_at(bump.start)
        leaving = speed_profile.time_at(bump.start + (bump.count - 1) * bump.spacing + bump.width + behind(scenario))
        end = speed_profile.time_at(scenario.road.length)
        metrics: dict[str, float] = {}
        for window, first, last in (
            ("rough_road", 0.0, arrival),
            ("bump", arrival, min(leaving, end)),
            ("whole", 0.0, end),
        ):
            seen = (self.time >= first - 1e-9) & (self.time <= last + 1e-9)
            seen[:, 0] &= self.time[:, 0] < last - 1e-9  # what follows a jump at a window's end is the next one's
            seen[:, -1] &= self.time[:, -1] > first + 1e-9
            share = seen[:, :-1] & seen[:, 1:]
            for name, values in self.signals.items():
                square = values**2
                mean = ((square[:, :-1] + square[:, 1:]) / 2)[share].mean()
                metrics[f"{window}.{name}.rms"] = float(np.sqrt(mean))
                metrics[f"{window}.{name}.peak"] = float(np.abs(values[seen]).max())
        return metrics | self._comfort(scenario, end)

    def _comfort(self, scenario: Scenario, end: float) -> dict[str, float]:
        rows = self.time[:, 0] <= end + 1e-9
        inside = self.time[rows] <= end + 1e-9
        front, rear = (
            self.signals[f"{axle}_force"] * speed for axle, speed in zip(("front", "rear"), self.speed, strict=True)
        )
        power = (np.abs(front) + np.abs(rear))[rows]
        both = inside[:, :-1] & inside[:, 1:]
        flat = self.signals["body_acceleration"][rows].copy()
        flat[1:, 0] = (flat[1:, 0] + flat[:-1, -1]) / 2  # the area on both sides of a jump is its trapezoids'
        filtered = weighted(flat[:, :-1][inside[:, :-1]], float(self.time[0, 1] - self.time[0, 0]))
        return {
            "comfort.weighted_rms": float(np.sqrt(np.mean(filtered**2))),
            "comfort.vibration_dose": float((np.sum(filtered**4) * (self.time[0, 1] - self.time[0, 0])) ** 0.25),
            "comfort.actuator_mean_power": float(((power[:, :-1] + power[:, 1:]) / 2)[both].mean()),
            "comfort.actuator_peak_power": float(power[inside].max()),
        }


def run(scenario: Scenario, name: str, step: float = STEP) -> tuple[dict[str, float], Held]:
    """One strategy's metrics by the reference, and the samples they come from."""
    core = prepare(scenario, name)
    speed_profile, controller, Ts = core.speed_profile, core.controller, core.steps.control
    if controller.delayed:
        commands, Ts = _ecu_commands(scenario)
        held = _drive(scenario, speed_profile, Ts, len(commands), lambda k, state: commands[k], step)
        return held.metrics(scenario, speed_profile), held

    controller.start(core.setup())
    forecast = core.forecast(core.preview, core.preview_steps)
    inputs, car, limit = core.inputs(forecast), core.car(), scenario.mpc.force_limit
    actuator = scenario.actuator if controller.actuated else Actuator()
    most = np.inf if actuator.rate_limit is None else actuator.rate_limit * Ts
    strongest = np.inf if actuator.saturation is None else actuator.saturation
    previous = np.zeros(2)

    def command(k: int, state: Array) -> Array:
        nonlocal previous
        seen = Seen(inputs, car, k, k, state, previous)
        law = controller.linear_law(seen.stage)
        assert law is not None
        disturbances = inputs.disturbances[:, k]
        z = np.concatenate([state, previous, disturbances.ravel()])
        wanted = law.force(state, previous, disturbances)
        if law.limits is not None and np.abs(law.limits @ z).max() > 1:
            wanted = np.asarray(controller.force(seen))
        wanted = np.clip(wanted, -limit, limit)
        previous = np.asarray(np.clip(previous + np.clip(wanted - previous, -most, most), -strongest, strongest))
        return previous

    held = _drive(scenario, speed_profile, Ts, len(core.excitation.grid.position), command, step)
    return held.metrics(scenario, speed_profile), held


def errors(scenario: Scenario, name: str, result: StrategyResult) -> dict[str, float]:
    """How far each of a result's metrics is from the reference's, relative; 0 where both are nothing."""
    ours, theirs = metrics(result), run(scenario, name)[0]
    return {key: (ours[key] / value - 1 if abs(value) > 1e-9 else ours[key]) for key, value in theirs.items()}


def _ecu_commands(scenario: Scenario) -> tuple[Array, float]:
    """The commands in each short step of a run of `lv_hil`, and the short step [s]."""
    with returned(DelayedLoop, "run") as runs:
        simulate(scenario, "lv_hil")  # its ECU by the model in NumPy
    loop, trajectory = runs[0]
    return trajectory.loop[1:, -2:], loop.setup.short_step


def _drive(
    scenario: Scenario,
    speed_profile: SpeedProfile,
    Ts: float,
    steps: int,
    command: Callable[[int, Array], Array],
    step: float,
) -> Held:
    """From rest behind x = 0: first from control instant to control instant, then all that lies between at once."""
    car, n = scenario.real_vehicle, max(1, round(Ts / step))
    h = Ts / n
    corner = 2 * np.pi * scenario.actuator.bandwidth if scenario.actuator.bandwidth else 0.0
    maps = interval(state_space(car), h, h, corner)
    read = interval(state_space(car), h, 0.0, corner).output
    lag = 2 if corner else 0
    # p = [absolute state; with a lag the forces]; forced by [z_start (2), z_end (2), a], driven by the command.
    # w = (x 8, u 2, z_start 2, z_end 2, a 1, command 2)
    inner = [*range(8 + lag)]
    driven = [15, 16] if corner else [8, 9]
    rows = np.vstack([maps.state, maps.force]) if corner else maps.state
    A, B, E = rows[:, inner], rows[:, driven], rows[:, 10:15]

    offset = run_in(scenario, speed_profile, Ts)
    time = Ts * (np.arange(steps)[:, None] - offset) + h * np.arange(n + 1)
    surface = road_profile(scenario.road)
    position = speed_profile.at(time)[0]
    z = np.stack([surface.height(position), surface.height(position - behind(scenario))], axis=-1)
    a = speed_profile.sample(speed_profile.braking, time[:, :-1] + h / 2)
    forced = np.concatenate([z[:, :-1], z[:, 1:], a[..., None]], axis=-1)  # (steps, n, 5)

    whole_A, whole_B = np.eye(len(A)), np.zeros_like(B)
    gathered = np.zeros((steps, len(A)))
    for i in range(n):
        gathered = gathered @ A.T + forced[:, i] @ E.T
        whole_A, whole_B = A @ whole_A, A @ whole_B + B

    lever = np.array([[1, -car.cg_to_front], [1, car.cg_to_rear]])
    to_state = to_deflections(car)
    p = np.zeros(len(A))
    p[:4] = [*np.linalg.solve(lever, z[0, 0]), *z[0, 0]]  # in equilibrium on the road where it starts
    starts, commands = np.empty((steps, len(A))), np.empty((steps, 2))
    for k in range(steps):
        state = to_state @ p[:8]
        state[2:4] -= z[k, 0]
        starts[k], commands[k] = p, command(k, state)
        p = whole_A @ p + whole_B @ commands[k] + gathered[k]

    outputs, forces, speeds = np.empty((6, steps, n + 1)), np.empty((2, steps, n + 1)), np.empty((2, steps, n + 1))
    now = starts
    deflection_of = np.hstack([np.zeros((2, 4)), lever, -np.eye(2)])
    for i in range(n + 1):
        u = now[:, 8:] if corner else commands
        road, braking = z[:, i], a[:, min(i, n - 1)]
        w = np.hstack([now[:, :8], u, road, road, braking[:, None]])
        outputs[:, :, i] = (w @ read[:, :15].T).T
        forces[:, :, i], speeds[:, :, i] = u.T, (now[:, :8] @ deflection_of.T).T
        if i < n:
            now = now @ A.T + commands @ B.T + forced[:, i] @ E.T
    recorded = time[:, 0] >= -1e-9
    signals = dict(zip((*OUTPUTS, "front_force", "rear_force"), [*outputs, *forces], strict=True))
    return Held(
        time=time[recorded],
        signals={key: values[recorded] for key, values in signals.items()},
        speed=(speeds[0][recorded], speeds[1][recorded]),
    )


def run_in(scenario: Scenario, speed_profile: SpeedProfile, Ts: float) -> int:
    """Steps before x = 0; an ECU's short steps begin with a whole control step."""
    whole = scenario.mpc.sample_time if Ts < scenario.mpc.sample_time - 1e-12 else Ts
    return round(whole / Ts) * ceil(20.0 / (speed_profile.initial_speed * whole))
