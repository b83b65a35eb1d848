"""Units as people write them, and the core's one table, which the client and the page have copies of."""

import os
from pathlib import Path

import pytest

from ridelab.units import quantity, switch
from sim_core.scenario import dotted
from sim_core.units import UNITS, factor

ROOT = Path(__file__).parents[2]
COPIES = ("frontend/src/units/units.gen.json", "client/ridelab/units.gen.json")


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.12", "m", 0.12),
        ("12 cm", "m", 0.12),
        ("120MM", "m", 0.12),
        ("-6 cm", "m", -0.06),
        ("30kmh", "m/s", 8.33333333333),
        ("250mm/s", "m/s", 0.25),
        ("1.2 kN", "N", 1200),
        ("1.5kN*s/m", "N·s/m", 1500),
        ("1500 Ns/m", "N·s/m", 1500),
        ("64 cm³", "m^3", 64e-6),
        ("2°/s", "rad/s", 0.0349065850399),
        ("1.5 MPa", "Pa", 1.5e6),
        ("0.3 g", "m/s^2", 2.941995),
        ("60 %", "1", 0.6),
        ("1e-9 1/N²", "1/N^2", 1e-9),
    ],
)
def test_a_number_with_a_unit_is_converted(text: str, unit: str, value: float) -> None:
    assert quantity(text, unit) == value


@pytest.mark.parametrize(
    ("written", "unit", "expected"),
    [("cm", "m", 0.01), ("KG m2", "kg·m^2", 1), ("km/h", "m/s", 1 / 3.6), ("deg/s", "rad/s", 0.0174532925199)],
)
def test_a_unit_is_so_many_of_another(written: str, unit: str, expected: float) -> None:
    assert factor(written, unit) == pytest.approx(expected, rel=1e-12)
    with pytest.raises(ValueError, match="furlongs is not understood"):
        factor("furlongs", unit)


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("12 kg", "m", "12 kg is not understood: it takes m, mm, cm, km, in, ft or µm"),
        ("3 furlongs", "km/h", "3 furlongs is not understood: it takes m/s, km/h, mph, ft/s, kn, cm/s or mm/s"),
        ("2 m", "1/N^2", "2 m is not understood: it takes 1/N^2"),
        ("high", "m", "high is not a number"),
    ],
)
def test_another_quantity_is_refused_with_the_units_there_are(text: str, unit: str, message: str) -> None:
    with pytest.raises(ValueError, match="^" + message.replace("^", "\\^") + "$"):
        quantity(text, unit)


@pytest.mark.parametrize("words", [("true", "on", "yes", "1"), ("false", "off", "no", "0")])
def test_a_switch_is_read_as_people_write_it(words: tuple[str, ...]) -> None:
    written = {spelling for word in words for spelling in (word, word.capitalize(), word.upper(), f" {word} ")}
    assert {switch(text) for text in written} == {words[0] == "true"}


@pytest.mark.parametrize("text", ["", "2", "null", "none", "enabled", "0.0"])
def test_another_word_for_a_switch_is_refused_with_those_there_are(text: str) -> None:
    with pytest.raises(
        ValueError, match=f"^{text} is not understood: it takes true or false, on or off, yes or no, 1 or"
    ):
        switch(text)


def test_every_fields_unit_is_known() -> None:
    known = {unit for units in UNITS.values() for unit in units}
    assert {field.unit for field in dotted.fields().values()} <= known | {"1/N^2"}


@pytest.mark.parametrize("copy", COPIES)
def test_the_clients_and_the_pages_table_is_the_cores(copy: str) -> None:
    """UPDATE_DOCS=1 writes it."""
    file, text = ROOT / copy, (ROOT / "sim_core/units.json").read_text(encoding="utf-8")
    if os.environ.get("UPDATE_DOCS"):
        file.write_text(text, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == text
