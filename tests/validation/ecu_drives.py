"""Drives that ask much of the ECU's program: limits, iterations it does not have, converters and losses."""

from sim_core.scenario import Bump, Hil, Mpc, Road, Speed

HARD = Mpc(force_limit=1500, deflection_limit=0.03)  # limits bind in one step of ten, many of them together
DRIVES = {
    "paper": (Mpc(), Hil()),
    "at limits": (HARD, Hil(bits=24, iterations=200)),
    "out of iterations": (HARD, Hil(bits=24, iterations=3, noise=0.003, jitter=0.003, packet_loss=0.1)),
    "short and uncompensated": (
        Mpc(prediction_horizon=7, control_horizon=7, preview="wheelbase", force_limit=800),
        Hil(compensation="none"),
    ),
}
SHORT = Road(length=60, bump=Bump(start=40, width=3, height=0.09))
SLOWER = Speed(initial_speed_kmh=45, detection_distance=30)
