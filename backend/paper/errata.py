"""What is printed in the paper and what Ridelab uses instead; docs/reference/errata.md is written from it.

Those that a reader may choose are in `backend.paper.readings`.
"""

from backend.paper.models import Erratum

ERRATA = [
    Erratum(
        place="Eq. 1",
        printed="noise with a mean of one, f0 not given",
        here="zero mean; cut-off n00 = 0.011 1/m, so f0 = n00·v",
    ),
    Erratum(
        place="Eq. 1",
        printed="filtered noise in time",
        here="made once in space: every strategy drives the same road whatever its speed, the rear axle the front's",
    ),
    Erratum(
        place="Eq. 2",
        printed="height over x without the fraction bar",
        here="h/2·(1 − cos 2πx/w)",
    ),
    Erratum(
        place="Eq. 3",
        printed="the bump replaces the roughness; road ends at 110 m",
        here="the bump is added; `road.length` 150 m, so the rear axle clears it and the car settles",
    ),
    Erratum(
        place="4.1.1, 4.2.2, Eq. 3",
        printed="RMS on the graded road surface; RMS for the full course; class B from 104 m on too",
        here="0 m to the bump; the reading `window` has the others",
    ),
    Erratum(
        place="Tables 4 and 7, front tyre load",
        printed="+8.45 % and −47.9 %",
        here="not both with this car: load transfer alone keeps LV above −32 % (docs/explanation/paper.md)",
    ),
    Erratum(
        place="3.1",
        printed="braking starts 80 m before the bump",
        here="`speed.detection_distance` = 80 m",
    ),
    Erratum(
        place="Eq. 5",
        printed="tan(2v_r/v_d)",
        here="tanh: friction must stay bounded",
    ),
    Erratum(
        place="Eq. 6",
        printed="fraction bar missing; µ, r_b, A, v_d not given",
        here="P = T/(k r_b A), k = 2µ; typical values in `brake`, ours",
    ),
    Erratum(
        place="Eq. 7, row 4",
        printed="C_s1 and u_1 in the rear wheel's row",
        here="C_s2 and u_2",
    ),
    Erratum(
        place="Eq. 7",
        printed="no braking term, although the brake stage exists to hold the pitch braking causes",
        here="moment m_b a_brake h_cg, `vehicle.cg_height` = 0.54 m, ours; 0 turns it off",
    ),
    Erratum(
        place="Eq. 7",
        printed="a road under each axle, and no delay between them",
        here="the rear axle meets the road later, by the wheelbase; `road.rear_axle` can have both meet it together, "
        "which comes nearer to the printed absolutes",
    ),
    Erratum(
        place="Table 5, no control",
        printed="tyre loads of 22,245 and 23,162 N beside 12.6 m/s²",
        here="no damping gives so much load beside that acceleration (`make nearest`)",
    ),
    Erratum(
        place="Eq. 9",
        printed="no road input in the prediction",
        here="measured or previewed road velocity, `mpc.preview`",
    ),
    Erratum(
        place="Eq. 11-15",
        printed="no penalty on force, limit on output instead of deflection, Nc + 1 moves, no slack",
        here="R and Δu weights, deflection limit with slack, Nc moves: `mpc.*`",
    ),
    Erratum(
        place="Eq. 16",
        printed="sums of raw squares would let newtons outweigh m/s² a million times",
        here="each term over the passive RMS squared, as the equation itself shows",
    ),
    Erratum(
        place="Table 2",
        printed="1270 kg and 1536.7 kg·m² look like a whole car, the stiffnesses like one wheel",
        here="preset `paper` as printed; preset `half_car_consistent` with half the masses",
    ),
    Erratum(
        place="Table 8, rear tyre load",
        printed="−44.0 %",
        here="−62.6 % follows from the printed absolutes",
    ),
    Erratum(
        place="Table 9, body acceleration, LQR",
        printed="+10.9 %",
        here="+12.3 % follows",
    ),
    Erratum(
        place="Table 9, body acceleration, HIL",
        printed="+1.6 %",
        here="+1.75 % follows",
    ),
    Erratum(
        place="abstract, 4.1.2",
        printed='pitch RMS "reduced" by 4.55 %',
        here="Table 7 says it rises by 4.55 %",
    ),
    Erratum(
        place="2.2.3",
        printed="pitch acceleration falls with speed",
        here="Table 5 and the model say it rises; with both axles together and a damping of 600 N s/m it falls from "
        "40 km/h on, far below Table 5: no interpretation that was tried has both",
    ),
]

_HEAD = """# Errata and readings of the paper

What is printed, what Ridelab uses, and how to choose otherwise.

Written from backend/paper/errata.py; a test keeps this page equal to it.

| place | printed | here |
|---|---|---|
"""
_TAIL = """
Not given in the paper and therefore ours: sampling time, force and travel limits, travel weight q4, R and Δu weights,
brake constants, drag, height of the centre of gravity. Each is a field of the scenario; its help text says "ours".
"""


def page() -> str:
    """docs/reference/errata.md."""
    return _HEAD + "".join(f"| {item.place} | {item.printed} | {item.here} |\n" for item in ERRATA) + _TAIL
