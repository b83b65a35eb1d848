"""What is printed in the paper and what Ridelab uses instead; docs/reference/errata.md is written from it.

Those that a reader may choose are in `backend.paper.interpretations`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Erratum:
    """One place of the paper; `printed` and `here` are short Markdown."""

    place: str
    printed: str
    here: str


ERRATA = (
    Erratum("Eq. 1", "noise with a mean of one, f0 not given", "zero mean; cut-off n00 = 0.011 1/m, so f0 = n00·v"),
    Erratum(
        "Eq. 1",
        "filtered noise in time",
        "made once in space: every strategy drives the same road whatever its speed, the rear axle the front's",
    ),
    Erratum("Eq. 2", "height over x without the fraction bar", "h/2·(1 − cos 2πx/w)"),
    Erratum(
        "Eq. 3",
        "the bump replaces the roughness; road ends at 110 m",
        "the bump is added; `road.length` 150 m, so the rear axle clears it and the car settles",
    ),
    Erratum(
        "4.1.1, 4.2.2, Eq. 3",
        "RMS on the graded road surface; RMS for the full course; class B from 104 m on too",
        "0 m to the bump; the reading `window` has the others",
    ),
    Erratum(
        "Tables 4 and 7, front tyre load",
        "+8.45 % and −47.9 %",
        "not both with this car: load transfer alone keeps LV above −32 % (docs/explanation/paper.md)",
    ),
    Erratum("3.1", "braking starts 80 m before the bump", "`speed.detection_distance` = 80 m"),
    Erratum("Eq. 5", "tan(2v_r/v_d)", "tanh: friction must stay bounded"),
    Erratum(
        "Eq. 6",
        "fraction bar missing; µ, r_b, A, v_d not given",
        "P = T/(k r_b A), k = 2µ; typical values in `brake`, ours",
    ),
    Erratum("Eq. 7, row 4", "C_s1 and u_1 in the rear wheel's row", "C_s2 and u_2"),
    Erratum(
        "Eq. 7",
        "no braking term, although the brake stage exists to hold the pitch braking causes",
        "moment m_b a_brake h_cg, `vehicle.cg_height` = 0.54 m, ours; 0 turns it off",
    ),
    Erratum("Eq. 9", "no road input in the prediction", "measured or previewed road velocity, `mpc.preview`"),
    Erratum(
        "Eq. 11-15",
        "no penalty on force, limit on output instead of deflection, Nc + 1 moves, no slack",
        "R and Δu weights, deflection limit with slack, Nc moves: `mpc.*`",
    ),
    Erratum(
        "Eq. 16",
        "sums of raw squares would let newtons outweigh m/s² a million times",
        "each term over the passive RMS squared, as the equation itself shows",
    ),
    Erratum(
        "Table 2",
        "1270 kg and 1536.7 kg·m² look like a whole car, the stiffnesses like one wheel",
        "preset `paper` as printed; preset `half_car_consistent` with half the masses",
    ),
    Erratum("Table 8, rear tyre load", "−44.0 %", "−62.6 % follows from the printed absolutes"),
    Erratum("Table 9, body acceleration, LQR", "+10.9 %", "+12.3 % follows"),
    Erratum("Table 9, body acceleration, HIL", "+1.6 %", "+1.75 % follows"),
    Erratum("abstract, 4.1.2", 'pitch RMS "reduced" by 4.55 %', "Table 7 says it rises by 4.55 %"),
    Erratum("2.2.3", "pitch acceleration falls with speed", "Table 5 and the model say it rises"),
)

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
