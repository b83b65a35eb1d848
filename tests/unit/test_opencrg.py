"""OpenCRG files: the two wheel tracks that ASAM's reader finds, and what is refused or said, each at its line."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pycrg
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.roads import opencrg, survey
from backend.roads.opencrg import as_binary, as_text, read
from sim_core.arrays import FloatArray
from sim_core.scenario.measured import MeasuredRoad
from sim_core.tables.errors import TableError

LINES = 24
ROWS = "".join(f"{0.01 * (i % 3):10.6f}{0.02 * (i % 5):10.6f}{0.0:10.6f}\n" for i in range(LINES))
PLACES = "D:long section at v = -1.0,m\nD:long section at v = 0.0,m\nD:long section at v = 1.0,m\n"
NUMBERED = "D:long section 1,m\nD:long section 2,m\nD:long section 3,m\n"
WIDE = "".join(f"D:long section {i},m\n" for i in range(1, 10))
INCREMENT = "REFERENCE_LINE_INCREMENT = 1.0 ! m\n"


def file(
    road: str = INCREMENT, channels: str = PLACES, rows: str = ROWS, *, form: str = "LRFI", more: str = ""
) -> bytes:
    """A text file as a person writes it."""
    definition = f"$KD_Definition\n#:{form}\nU:reference line u,m,0,1.0\n{channels}$!***\n"
    head = f"$CT  ! comment\nanything = 1\n$\n{more}$ROAD_CRG\n{road}$!***\n{definition}* a comment\n$$$$$$$$10$$$$\n"
    return (head + rows).encode("latin-1")


@pytest.fixture
def tracks_of(monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[FloatArray, list[FloatArray]]]:
    """Distances and tracks as `read` hands them on."""
    seen: dict[str, Any] = {}

    def survey_of(distance: FloatArray, tracks: list[FloatArray]) -> survey.Survey:
        seen.update(d=distance, t=tracks)
        return survey.survey_of(distance, tracks)

    monkeypatch.setattr(opencrg, "survey_of", survey_of)

    def tracks(*content: Any) -> tuple[FloatArray, list[FloatArray]]:
        read(*content)
        return seen["d"], seen["t"]

    return tracks


def asam(path: Path, u: Any, v: float) -> FloatArray:
    with pycrg.DataSet.open(str(path)) as data:
        first = data.u_range()[0]
        return np.asarray(data.create_contact_point().uv_to_z_many(first + u - u[0], np.full(len(u), v)))


def same_shape(ours: FloatArray, theirs: FloatArray, limit: float) -> None:
    """Their default modifiers move the road as a whole."""
    assert np.ptp(ours - theirs) < limit


@pytest.mark.parametrize("form", ["KRBI", "KDBI", "LRFI", "LDFI"])
def test_tracks_are_those_of_asams_reader(form: str, tmp_path: Path, tracks_of: Any) -> None:
    """Bent, sloped and banked, with missing heights at the borders; single precision keeps 1e-7 of a metre or two."""
    noise = np.random.default_rng(3)
    v = np.array([-1.6, -1.0, -0.7, 0.1, 0.9, 1.4])
    z = 0.05 * noise.standard_normal((400, len(v)))
    z[50:60, :3] = z[200, 4:] = np.nan
    bend = 0.3 * np.sin(np.arange(399) / 90)
    slope, banking = 0.02 * noise.standard_normal(400), 0.03 * np.sin(np.arange(400) / 50)
    path = tmp_path / "road.crg"
    scales: dict[str | int, float] = {
        "scale_z_grid": 1.2,
        "scale_slope": 0.5,
        "scale_banking": 2.0,
        "scale_length": 1.1,
        "scale_width": 1.05,
    }
    pycrg.write(
        path,
        z,
        0.05,
        v,
        bend,
        u0=700.0,
        z0=3.0,
        slope=slope,
        banking=banking,
        fmt=form,
        mods={**scales, "refpoint_u": 9.0, "grid_nan_mode": 2},
    )
    distance, tracks = tracks_of(path.read_bytes(), 0.8, -0.85)
    assert distance[-1] - distance[0] == pytest.approx(399 * 0.05 * 1.1)
    for v_wheel, track in zip((0.8, -0.85), tracks, strict=True):
        same_shape(track, asam(path, distance, v_wheel), 2e-6)


@pytest.mark.parametrize(
    ("road", "channels"),
    [
        (INCREMENT, PLACES),
        (INCREMENT, "".join(reversed(PLACES.splitlines(keepends=True)))),
        (INCREMENT + "LONG_SECTION_V_RIGHT = -1.0\nLONG_SECTION_V_INCREMENT = 1.0\n", NUMBERED),
        (INCREMENT + "reference_line_start_s = 0.03\nREFERENCE_LINE_START_B = -.04\n", PLACES),
        ("REFERENCE_LINE_START_U = 5.0D0\nREFERENCE_LINE_END_U = 28\n" + INCREMENT, "D:friction,-\n" + PLACES[29:]),
    ],
)
def test_a_header_is_read_as_asams_reader_does(road: str, channels: str, tmp_path: Path, tracks_of: Any) -> None:
    content = file(road, channels)
    path = tmp_path / "road.crg"
    path.write_bytes(content)
    left, right = (0.5, -0.5) if "friction" not in channels else (0.9, 0.1)
    distance, tracks = tracks_of(content, left, right)
    for v, track in zip((left, right), tracks, strict=True):
        same_shape(track, asam(path, distance, v), 1e-7)


def test_what_a_row_of_text_may_hold(tracks_of: Any) -> None:
    """A value more than a line has room for, one without a blank before it, one unused, one missing, an exponent."""
    row = "**unused**-0.1000000 *missing* 1.0000D-1" + "0.20000000" * 4 + "\n 0.3000000\n"
    road = INCREMENT + "LONG_SECTION_V_RIGHT = -4\nLONG_SECTION_V_INCREMENT = 1\n"
    _, (left, right) = tracks_of(file(road, WIDE, (row + "\n").replace("\n", "\r\n") * LINES), 4.0, -3.0)
    assert (set(left), set(right)) == ({0.3}, {-0.1})
    _, (between, unused) = tracks_of(file(road, WIDE, row * LINES), -2.0, -4.0)
    assert (set(between), set(unused)) == ({0.0}, {0.0})


@pytest.mark.parametrize(("wanted", "wheels"), [("", (-0.5, 0.5)), ("LONG_SECTION_V_LEFT = 2.0\n", (0.5, 1.5))])
def test_a_grid_whose_place_is_unsaid_lies_around_its_reference_line(
    wanted: str, wheels: tuple[float, float], tracks_of: Any
) -> None:
    """As ASAM's example handmade_straight_minimalist.crg says of itself; its C reader begins at v = 0."""
    _, there = tracks_of(file(), 0.5, -0.5)
    numbered = file(INCREMENT + "LONG_SECTION_V_INCREMENT = 1\n" + wanted, NUMBERED)
    _, tracks = tracks_of(numbered, wheels[1], wheels[0])
    np.testing.assert_array_equal(tracks, there)


def test_what_is_done_or_left_out_is_said() -> None:
    said = read(file(more="$ROAD_CRG_OPTS\nBORDER_SMOOTH_UBEG = 3\nborder_mode_u = 2\n$\n")).warnings
    assert said[0] == "The option border_smooth_ubeg is left out: heights are taken as they are in the file"
    assert said[1] == "Wheels run 0.75 m left of the reference line and 0.75 m right of it"
    narrow = read(file(channels=PLACES.replace("-1.0", "-0.3"))).warnings
    assert narrow[0] == "Wheels run 0.75 m left of the reference line and 0.3 m right of it"
    gaps = read(file(rows=ROWS.replace("  0.020000  0.080000", " *missing**missing*"))).warnings
    assert any(
        re.fullmatch(r"At v = -0.75 m \d heights are missing: those beside them are taken", line) for line in gaps
    )
    bend = "".join(f"{0.04 * i:10.6f}{0.0:10.6f}{0.0:10.6f}{0.0:10.6f}\n" for i in range(LINES))
    bent = read(file(channels="D:reference line phi,rad\n" + PLACES, rows=bend)).warnings
    assert "Distance is the reference line's: on its bends a wheel's path differs by up to 3.0%" in bent


@pytest.mark.parametrize("write", [as_binary, as_text])
@pytest.mark.parametrize(
    ("samples", "scale"), [(1_991, 1.0), pytest.param(300_001, 0.1, marks=pytest.mark.thorough), (1_000, 150.0)]
)
def test_an_exported_road_is_the_same_road_for_us_and_for_asam(
    write: Callable[[MeasuredRoad], bytes], samples: int, scale: float, tmp_path: Path
) -> None:
    """To a micrometre; ASAM's reader keeps single precision whatever the file has."""
    road = MeasuredRoad.of(scale * (1 + 0.1 * np.random.default_rng(1).standard_normal(samples)))
    content = write(road)
    again = read(content)
    assert again.road == road
    assert again.warnings == ["This is an exported road: its heights are taken as they are"]
    path = tmp_path / "road.crg"
    path.write_bytes(content)
    u = np.arange(samples) * 0.01
    assert np.abs(asam(path, u, -1.2) - road.heights()).max() < 0.5e-6 + 1e-7 * scale


def cut(content: bytes, share: float = 0.5) -> bytes:
    return content[: int(len(content) * share)]


def binary(**road: Any) -> bytes:
    return as_binary(MeasuredRoad.of(0.1 * np.random.default_rng(2).standard_normal(1_000)), **road)


def swapped(content: bytes) -> bytes:
    begin = content.index(b"$$$$") + 73
    return content[:begin] + np.frombuffer(content, ">f4", offset=begin).astype("<f4").tobytes()


@pytest.mark.parametrize(
    ("content", "line", "said"),
    [
        (b"", 1, "This is no OpenCRG file"),
        (b"distance [m],height [mm]\n0,0\n5,1\n", 4, "This is no OpenCRG file"),
        (b"$CT\n$\n" + b"\n" * 30_000, 20_000, "The header may have 20000 lines"),
        (b"$CT\n" + b"x" * 600 + b"\n", 2, "A line may have 500 characters"),
        (file(more="$ROAD_CRG_FILE\nother.crg\n$\n"), 4, "It refers to other files"),
        (file(more="$ROAD_CRG_MODS\nGRID_NAN_MODE = 0\n$\n"), 5, "The modifier grid_nan_mode is not supported"),
        (file(more="$ROAD_CRG_MODS\nSCALE_WIDTH = -1\n$\n"), 5, "scale_width is above 0"),
        (file(road="REFERENCE_LINE_INCREMENT = nan\n"), 5, "reference_line_increment is not a number"),
        (file(road="REFERENCE_LINE_INCREMENT = -1.0\n"), None, "REFERENCE_LINE_INCREMENT is from 0.0001 to 5 m"),
        (file(road="REFERENCE_LINE_INCREMENT = 1e-300\n"), None, "REFERENCE_LINE_INCREMENT is from 0.0001 to 5 m"),
        (file(road=""), None, "REFERENCE_LINE_INCREMENT is from"),
        (file(form="XXXX"), 8, "The format of values is one of LRFI, LDFI, KRBI, KDBI"),
        (file(channels="D:reference line x,m\n" + PLACES), 10, "The channel reference line x,m is not supported"),
        (file(channels="D:long section at v = 1..2,m\n"), 10, "The place of a long section is not a number"),
        (file(channels="D:long section at v = 1,mm\n"), 10, "or its unit is not"),
        (file(channels="D:long section 1,m\n"), None, "A grid has two long sections at least"),
        (file(channels=NUMBERED.replace("3", "4")), None, "Long sections are all numbered from 1 on"),
        (file(channels=PLACES.replace("1.0", "0.0")), None, "Two long sections are at one place"),
        (file(rows=ROWS.replace("  0.010000", "  0.01.000")), None, "A value of cross-section 2 is not a number"),
        (file(channels=WIDE, rows="0.00000000" * 8 + "\n"), 22, "The file ends within a cross-section"),
        (file(rows=ROWS[:-20]), None, "This line has 3 values of 10 characters"),
        (file(rows=ROWS.replace("  0.000000\n", "  0.000000  1\n")), None, "This line has 3 values of 10 characters"),
        (file(rows=ROWS.replace("  0.02", "123456789D")), None, "This line has 3 values"),
        (file(rows=ROWS.replace("  0.010000", "  9.9D0099")), None, "A height of more than 100 km"),
        (file(rows=ROWS.replace("  0.020000  0.020000  0.000000", "*" * 30)), None, "has no height at all"),
        (file(rows=ROWS[:93]), None, "A road is from 5 to 3000 m long, this one 2 m"),
        (file(road=INCREMENT + "REFERENCE_LINE_END_U = 500\n"), None, "The file is cut off: 501 cross-sections are"),
        (file(road=INCREMENT + "REFERENCE_LINE_END_U = -9\n"), None, "the end is behind the start"),
        (file(road=INCREMENT + "REFERENCE_LINE_END_U = 1e12\n"), None, "The file is cut off"),
        (cut(binary()), None, "The file is cut off: 1000 cross-sections are announced"),
        (cut(binary(), 0.07), None, "The file is cut off: 1000 cross-sections are announced, 16 are"),
        (swapped(binary()), None, "are they big-endian"),
        (file(form="KRBI"), None, "Values are none of a road"),
        (file(channels="D:reference line phi,rad\n" + PLACES[29:], rows=ROWS.replace("0.02", "1.02")), None, "bends"),
    ],
)  # fmt: skip
def test_what_is_no_road_is_refused(content: bytes, line: int | None, said: str) -> None:
    with pytest.raises(TableError) as caught:
        read(content)
    assert said in caught.value.message
    if line is not None:
        assert caught.value.line == line


@pytest.mark.parametrize(("left", "right"), [(0.5, 0.9), (0.5, 0.5), (1.2, 0.0), (0.0, -1.2)])
def test_wheels_are_within_the_road(left: float, right: float) -> None:
    with pytest.raises(TableError, match="within the road: v from -1 m right to 1 m left"):
        read(file(), left, right)


@settings(max_examples=200)
@given(st.data())
def test_damaged_bytes_are_a_road_or_refused(data: st.DataObject) -> None:
    whole = data.draw(st.sampled_from([file(), binary(), file(form="LDFI"), file(form="KDBI")]))
    content = bytearray(whole[: data.draw(st.integers(0, len(whole)))])
    for _ in range(data.draw(st.integers(0, 4))):
        if content:
            content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    try:
        road = read(bytes(content)).road
    except TableError:
        return
    assert np.isfinite(road.heights()).all()
