"""The numbers the paper prints in Tables 4-5 and 7-10 (Meng et al. 2025), and what is misprinted in them.

Each value as printed; changes in %, in the order of PAPER_SIGNALS. tests hold them against an independent copy.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from sim_core.catalogue import PAPER_SIGNALS

# (window, statistic) -> strategy -> body acceleration [m/s^2], pitch acceleration [rad/s^2], tyre loads [N]
ABSOLUTES: dict[tuple[str, str], dict[str, tuple[float, float, float, float]]] = {
    ("rough_road", "rms"): {
        "passive": (1.12, 0.53, 1692, 1803),
        "speed_only": (0.83, 0.49, 1835, 1753),
        "suspension_only": (0.63, 0.44, 1356, 1534),
        "lv": (0.57, 0.46, 955.8, 1261),
        "lv_hil": (0.58, 0.47, 968, 1268),
        "lqr": (0.64, 0.57, 1065, 1414),
    },
    ("bump", "peak"): {
        "passive": (12.6, 6.39, 22245, 23162),
        "speed_only": (6.76, 3.76, 12212, 11833),
        "suspension_only": (5.00, 1.98, 5472, 6629),
        "lv": (3.81, 1.19, 3024, 4429),
        "lv_hil": (4.02, 1.28, 3224, 4648),
        "lqr": (4.57, 1.34, 3751, 4976),
    },
}


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperTable:
    """One comparing table: two pairs (strategy, against) and the changes printed for each [%]."""

    number: int
    title: str
    window: str
    statistic: str
    columns: tuple[tuple[str, str, tuple[float, float, float, float]], ...]


TABLES = (
    PaperTable(
        number=4,
        title="RMS on the rough road: single controls against no control",
        window="rough_road",
        statistic="rms",
        columns=(
            ("speed_only", "passive", (-25.9, -7.54, 8.45, -2.77)),
            ("suspension_only", "passive", (-43.7, -17.0, -19.9, -14.9)),
        ),
    ),
    PaperTable(
        number=5,
        title="Peak on the bump: single controls against no control",
        window="bump",
        statistic="peak",
        columns=(
            ("speed_only", "passive", (-46.3, -41.1, -45.1, -48.9)),
            ("suspension_only", "passive", (-60.3, -69.0, -75.4, -71.4)),
        ),
    ),
    PaperTable(
        number=7,
        title="RMS on the rough road: LV control against single controls",
        window="rough_road",
        statistic="rms",
        columns=(
            ("lv", "speed_only", (-31.3, -6.12, -47.9, -28.1)),
            ("lv", "suspension_only", (-9.52, 4.55, -29.5, -17.8)),
        ),
    ),
    PaperTable(
        number=8,
        title="Peak on the bump: LV control against single controls",
        window="bump",
        statistic="peak",
        columns=(
            ("lv", "speed_only", (-43.6, -68.3, -75.2, -44.0)),
            ("lv", "suspension_only", (-23.8, -39.9, -44.7, -33.2)),
        ),
    ),
    PaperTable(
        number=9,
        title="RMS on the rough road: hardware in the loop and LQR against LV control",
        window="rough_road",
        statistic="rms",
        columns=(("lv_hil", "lv", (1.6, 2.1, 1.3, 0.6)), ("lqr", "lv", (10.9, 23.9, 11.4, 12.1))),
    ),
    PaperTable(
        number=10,
        title="Peak on the bump: hardware in the loop and LQR against LV control",
        window="bump",
        statistic="peak",
        columns=(("lv_hil", "lv", (5.5, 7.6, 6.6, 4.9)), ("lqr", "lv", (19.9, 12.6, 24.0, 12.3))),
    ),
)

# (table, strategy, against, signal) -> the change that follows from the absolutes printed beside it [%]
MISPRINTS: dict[tuple[int, str, str, str], float] = {
    (8, "lv", "speed_only", "rear_tyre_load"): -62.6,
    (9, "lqr", "lv", "body_acceleration"): 12.3,
    (9, "lv_hil", "lv", "body_acceleration"): 1.75,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperCell:
    """One printed change.

    Attributes:
        table: Its number.
        window: catalogue.WINDOWS key.
        statistic: rms or peak.
        signal: catalogue.SIGNALS key.
        strategy: What is compared.
        against: With what.
        value: The strategy's printed absolute, SI.
        base: The other's, SI.
        printed: The change as printed [%].
        follows: What follows from the absolutes, where the printed one is a misprint [%].
    """

    table: int
    window: str
    statistic: str
    signal: str
    strategy: str
    against: str
    value: float
    base: float
    printed: float
    follows: float | None

    @property
    def claim(self) -> float:
        """The change the paper's own absolutes claim [%]."""
        return self.printed if self.follows is None else self.follows


def cells() -> Iterator[PaperCell]:
    """Every printed change, table by table, column by column."""
    for table in TABLES:
        absolutes = ABSOLUTES[table.window, table.statistic]
        for strategy, against, changes in table.columns:
            for index, signal in enumerate(PAPER_SIGNALS):
                yield PaperCell(
                    table=table.number,
                    window=table.window,
                    statistic=table.statistic,
                    signal=signal,
                    strategy=strategy,
                    against=against,
                    value=absolutes[strategy][index],
                    base=absolutes[against][index],
                    printed=changes[index],
                    follows=MISPRINTS.get((table.number, strategy, against, signal)),
                )
