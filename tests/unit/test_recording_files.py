"""Files of recorded drives: what they are read as, and why some are none."""

import numpy as np
import pytest

from backend.recordings.export import as_csv
from backend.recordings.reading import read
from sim_core.tables.errors import TableError

HEAD = "time [s],body_acceleration [m/s^2]\n"
ROWS = [f"{0.01 * n:.2f},{n % 5 - 2}" for n in range(40)]


def file(*rows: str, head: str = HEAD) -> bytes:
    return "\n".join([head.strip(), *rows, ""]).encode()


def test_units_decimal_commas_and_names_are_read() -> None:
    rows = [f'{10 * n};"{n % 5 - 2}"'.replace('"', "") + f";{n},5;text" for n in range(20)]
    found = read(file(*rows, head='t [ms];"Body acceleration [g]";v (km/h);driver'))
    signals = found.drive.signals()
    assert signals["time"][:2].tolist() == [0, 0.01]
    assert signals["body_acceleration"][0] == pytest.approx(-2 * 9.80665)
    assert signals["speed"][1] == pytest.approx(1.5 / 3.6)
    assert found.warnings == ["Left out: driver"]
    assert read(as_csv(found.drive)).drive == found.drive


def test_a_slower_signal_is_straight_between_its_values_and_a_gap_is_none() -> None:
    rows = [f"{0.01 * n:.2f},1,{'' if n % 5 else n}" for n in range(60) if not 30 < n < 50]
    found = read(file(*rows, head="time [s],body_acceleration [m/s^2],front_deflection [mm]"))
    signals, gap = found.drive.signals(), 0.4
    assert signals["front_deflection"][7] == pytest.approx(0.007)
    at = int(np.searchsorted(signals["time"], gap - 1e-9))
    assert np.isnan([signals["body_acceleration"][at], signals["front_deflection"][at]]).all()
    assert any("Gaps: 1, the longest 0.2 s, the first before line 33" in warning for warning in found.warnings)


def test_two_samples_at_one_instant_are_a_jump() -> None:
    found = read(file(*ROWS[:20], ROWS[19].replace(",", ",7"), *ROWS[20:]))
    assert found.drive.signals()["time"][19] == found.drive.signals()["time"][20]
    assert "Instants with two samples: 1, taken as the values before and after a jump" in found.warnings


def test_doubts_are_said() -> None:
    rows = [f"{0.01 * n:.2f},{9.8 + 0.1 * (n % 2)},{500 * (-1) ** n}" for n in range(40)]
    said = read(file(*rows, head="time [s],body_acceleration [m/s^2],front_deflection [cm]")).warnings
    assert any("it contains gravity" in each for each in said)
    assert any("reaches 5 m: is its unit right?" in each for each in said)


@pytest.mark.parametrize(
    ("content", "line", "said"),
    [
        (file(*ROWS[:20], "0.05,1", *ROWS[21:]), 22, "The time goes back"),
        (file(*ROWS[:20], ROWS[19], ROWS[19]), 23, "The time stands still"),
        (file(*ROWS[:20], "nan,1"), 22, "The time is missing"),
        (file(*ROWS[:20], "0.2,inf", *ROWS[21:]), 22, "is beyond any measurement"),
        (file(*ROWS[:20], "0.2,=1+1", *ROWS[21:]), 22, "is not a number"),
        (file(*ROWS[:20], "0.2", *ROWS[21:]), 22, "is not like the others"),
    ],
)
def test_a_file_that_is_none_is_refused_at_its_line(content: bytes, line: int, said: str) -> None:
    with pytest.raises(TableError, match=said) as caught:
        read(content)
    assert caught.value.line == line
