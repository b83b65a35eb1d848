"""Writes the plain loop's problem, benchmarks/plain_osqp_loop.npz, from the core: `python -m benchmarks.freeze_baseline`."""

from pathlib import Path

import numpy as np

from sim_core.control.cost import CostTerms
from sim_core.control.mpc_design import Horizon, design
from sim_core.loop.excitation import excite, fine_step
from sim_core.loop.preview import preview_windows
from sim_core.scenario import Road
from sim_core.scenario.presets import preset
from sim_core.simulate import simulate
from sim_core.speed.profile import plan_speed
from sim_core.speed.stages import coordinated_weights, segments, spans
from sim_core.strategies import strategy_named
from sim_core.vehicle.half_car import discrete

SEED = 1000
STAGES = ("cruise", "brake", "bump")


def main() -> None:
    scenario = preset("paper").model_copy(update={"road": Road(seed=SEED)})
    assert scenario.road == preset("paper").road.model_copy(update={"seed": SEED})
    strategy, mpc, car = strategy_named("lv"), scenario.mpc, scenario.vehicle
    motion = plan_speed(scenario, strategy.speed)
    excitation = excite(scenario.road, car.wheelbase, motion, mpc.sample_time, fine_step(scenario, strategy))
    windows = preview_windows(mpc.preview, scenario.road, motion, excitation, mpc.prediction_horizon, car.wheelbase)
    horizon = Horizon(
        prediction=mpc.prediction_horizon,
        control=mpc.control_horizon,
        force_limit=mpc.force_limit,
        force_change_weight=mpc.force_change_weight,
    )
    stored = {}
    for stage in STAGES:
        terms = CostTerms(
            vehicle=car,
            speed=motion.initial_speed,
            sample_time=mpc.sample_time,
            weights=coordinated_weights(scenario, strategy, stage),
            deflection_weight=mpc.deflection_weight,
            deflection_limit=mpc.deflection_limit,
            force_weight=mpc.force_weight,
        )
        made = design(terms, horizon)
        stored |= {f"{stage}_hessian": made.shape.H, f"{stage}_linear": made.linear}
    plant = discrete(car, excitation.fine_step)
    stored |= {f"plant_{name}": getattr(plant, name) for name in "ABECDF"}
    stages = np.zeros(len(excitation.position), dtype=np.int8)
    for stage, first, last in segments(spans(scenario, strategy, motion), excitation.position):
        stages[first:last] = STAGES.index(stage)
    # The windows slide: the first one, and what each later one adds.
    by_input = windows.reshape(len(windows), 3, -1)
    ahead = np.concatenate([by_input[0].T, by_input[1:, :, -1]]).T
    again = np.lib.stride_tricks.sliding_window_view(ahead, by_input.shape[2], axis=1).transpose(1, 0, 2)
    assert np.array_equal(again.reshape(windows.shape), windows)
    assert np.array_equal(excitation.disturbance.reshape(-1, excitation.fine, 3)[:, 0, 2], excitation.disturbance[:, 2])
    stored |= {
        "rows": made.shape.A,
        "low": made.shape.low,
        "high": made.shape.high,
        "travel": made.travel,
        "travel_limit": np.array(made.travel_limit),
        "force_limit": np.array(mpc.force_limit),
        "road_ahead": ahead,
        "stages": stages,
        "disturbance": excitation.disturbance.reshape(-1, excitation.fine, 3),
        "on_record": np.array([excitation.on_record.start, excitation.on_record.stop]),
        "travel_time": np.array(simulate(scenario, "lv").travel_time),
    }
    for k, v in stored.items():
        print(k, v.shape, v.dtype)
    file = Path(__file__).with_name("plain_osqp_loop.npz")
    np.savez_compressed(file, allow_pickle=False, **stored)
    print(file.stat().st_size)


if __name__ == "__main__":
    main()
