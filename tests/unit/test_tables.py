"""Tables as engineers have them: one road and one drive in many shapes, read as the same values or asked about."""

import io
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sim_core import TableError, UnsureTableError, read_table
from sim_core.arrays import FloatArray
from sim_core.tables.titles import DRIVE, ROAD
from tests import wording

X = np.round(0.25 * np.arange(161), 4)  # [m]
HEIGHT = np.round(0.01 * np.sin(X) + 0.02 * np.exp(-((X - 20) ** 2)), 6)
RIGHT = np.round(HEIGHT + 0.002 * np.cos(3 * X), 6)
TIME = np.round(0.01 * np.arange(400), 4)  # [s]
ACCELERATION = np.round(1.5 * np.sin(12 * TIME) + 0.3 * np.cos(31 * TIME), 5)
SPEED = np.full(400, 12.5)


def lines(*columns: Any, head: str = "", between: str = ",", end: str = "\n", foot: str = "") -> str:
    rows = [between.join(map(str, row)) for row in zip(*columns, strict=True)]
    return end.join([*([head] if head else []), *rows, *([foot] if foot else [])]) + end


def comma(values: FloatArray, digits: int = 6) -> list[str]:
    return [f"{value:.{digits}f}".replace(".", ",") for value in values]


def erd(unit: str, scale: float, step: str, x_unit: str) -> str:
    numbers = f"2, {len(X)}, -1, 8, 5, {step}, -1,"
    names = f"SHORTNAMLElev.  RElev.  \nUNITSNAM{unit:8}{unit:8}\nXLABEL  Distance\nXUNITS  {x_unit}"
    head = f"ERDFILEV2.00\n{numbers}\nTITLE   Section 5\n{names}\nEND"
    return lines((HEIGHT / scale).round(7), (RIGHT / scale).round(7), head=head, between=" ")


MOTEC = (
    '"Format","MoTeC CSV File",,,"Workbook",""\n"Venue","Track",,,"Worksheet",""\n"Vehicle","Van",,,"Vehicle Desc",""\n'
    '"Log Date","05/05/2024",,,"Origin Time","0.000","s"\n"Log Time","14:30:00",,,"Start Time","0.000","s"\n'
    '"Sample Rate","100.000","Hz",,"End Time","4.000","s"\n"Beacon Markers",""\n\n\n'
)
VBO = (
    "File created on 02/05/2024 at 10:00:00\n\n[header]\nsatellites\ntime\nlatitude\nvelocity kmh\nvert accel g\n\n"
    "[comments]\n(c) Racelogic\n\n[column names]\nsats time lat velocity vertaccel\n\n[data]\n"
)


def quoted(values: FloatArray) -> list[str]:
    return [f'"{value}"' for value in values]


MM, INCH, FOOT, G = 1e-3, 0.0254, 0.3048, 9.80665
ROADS: dict[str, str | bytes] = {
    "brackets": lines(X, HEIGHT / MM, head="distance [m],height [mm]"),
    "parentheses": lines(X, HEIGHT / MM, head="Distance (m),Elevation (mm)"),
    "words": lines(X / FOOT, HEIGHT / INCH, head="distance (feet),height (inches)"),
    "suffixes": lines(X, HEIGHT / MM, head="distance_m,elevation_mm"),
    "in words": lines(comma(X), comma(HEIGHT / MM), head="Weg in m;Höhe in mm", between=";"),
    "cp1252": lines(comma(X), comma(HEIGHT / MM), head="Weg [m];Höhe [mm]", between=";").encode("cp1252"),
    "UTF-16": lines(X, HEIGHT, head="x [m]\tz [m]", between="\t").encode("utf-16"),
    "UTF-16 without a mark": lines(X, HEIGHT, head="x [m]\tz [m]", between="\t").encode("utf-16-be"),
    "byte order mark": lines(X, HEIGHT, head="x [m],z [m]").encode("utf-8-sig"),
    "blanks": lines(X, HEIGHT, head="  distance [m]   height [m]", between="   "),
    "blanks and tabs": lines(X, HEIGHT, head="distance[m] \t height[m]", between=" \t "),
    "bars": lines(X, HEIGHT, head="distance [m]|height [m]", between="|"),
    "numpy's comment": lines(X, HEIGHT, head="# distance [m], height [m]", between=","),
    "row of units": lines(X, HEIGHT / MM, head="distance,height\nm,mm"),
    "row of units in brackets": lines(X, HEIGHT / MM, head="Chainage\tElevation\n[m]\t[mm]", between="\t"),
    "preamble": lines(X, HEIGHT, head="Project,Demo\nOperator,N. N.\nDate,2024-05-02\n\ndistance [m],height [m]"),
    "long preamble": lines(
        X, HEIGHT, head="\n".join(f"Note {n}: free text; of any kind" for n in range(300)) + "\ndistance [m],height [m]"
    ),
    "footer": lines(X, HEIGHT, head="distance [m],height [m]", foot="\nEnd of data\nMean,0.002 m"),
    "CR": lines(X, HEIGHT, head="distance [m],height [m]", end="\r"),
    "CRLF": lines(X, HEIGHT, head="distance [m],height [m]", end="\r\n"),
    "quotes": lines(quoted(X), quoted(HEIGHT), head='"distance [m]","height [m]"'),
    "decimal commas in quotes": lines(
        [f'"{x}"' for x in comma(X)], [f'"{z}"' for z in comma(HEIGHT)], head='"distance [m]","height [m]"'
    ),
    "thousands": lines([f'"{1000 * x:,.1f}"' for x in X], HEIGHT, head="distance [mm],height [m]"),
    "German thousands": lines(
        [f"{1000 * x:,.1f}".translate(str.maketrans(",.", ".,")) for x in X],
        comma(HEIGHT),
        head="distance [mm];height [m]",
        between=";",
    ),
    "exponents": lines([f"{x:.4E}" for x in X], [f"{z:.6e}" for z in HEIGHT], head="distance [m],height [m]"),
    "index": lines(range(len(X)), X, HEIGHT, head=",distance [m],height [m]"),
    "index without a title": lines(
        [f'"{n + 1}"' for n in range(len(X))], X, HEIGHT, head='"distance [m]" "height [m]"', between=" "
    ),
    "other columns": lines(X, ["ok"] * len(X), HEIGHT, 3 * X, head="station [m],remark,elevation [m],lane"),
    "comments and empty lines": lines(
        X, HEIGHT, head="# by hand\n\ndistance [m],height [m]\n# the first metre"
    ).replace("\n5.0,", "\n\n# five\n5.0,"),
    "trailing separators": lines(X, HEIGHT, [""] * len(X), head="distance [m],height [m],"),
    "descending": lines(X[::-1], HEIGHT[::-1], head="distance [m],height [m]"),
    "missing cells": lines(
        X, ["NaN" if n in (50, 51) else z for n, z in enumerate(HEIGHT)], head="distance [m],height [m]"
    ),
    "two tracks": lines(X, HEIGHT, RIGHT, head="Distance (m),Left Elevation (m),Right Elevation (m)"),
    "wheel paths": lines(X, HEIGHT / MM, RIGHT / MM, head="Station_m,LWP_mm,RWP_mm"),
    "ERD in metres": erd("mm", MM, "0.25", "m"),
    "ERD in feet": erd("in", INCH, "0.8202099737532809", "ft"),
    "titles over two lines": lines(
        X, HEIGHT / MM, RIGHT / MM, head="Distance,Left,Right\nalong,wheel path,wheel path\n(m),(mm),(mm)"
    ),
    "tabs below lines of words": lines(
        X, HEIGHT / MM, head="Pro 3.6 Export\nSample Interval: 0.25 m\n\nDistance (m)\tElevation (mm)", between="\t"
    ),
    "hundredths of a millimetre": lines(X, HEIGHT / 1e-5, head="Distance [m];Height [0.01 mm]", between=";"),
    "miles and mils": lines(X / 1609.344, HEIGHT / 25.4e-6, head="Distance (mi),Elevation (mil)"),
    "stations": lines(
        [f"{12 + x // 1000:.0f}+{x % 1000:06.2f}" for x in X], HEIGHT, head="Station [m],Elevation [m]"
    ).replace("12+", "0+"),
    "sides behind the height": lines(
        X, [4] * len(X), [5] * len(X), HEIGHT, RIGHT, head="x (m),Rut L (mm),Rut R (mm),Elevation L (m),Elevation R (m)"
    ),
    "French": lines(comma(X), comma(HEIGHT), head="Abscisse (m);Altitude (m)", between=";").encode("cp1252"),
    "GPX names": lines([52.1] * len(X), X / 1000, HEIGHT, head="lat,dist_km,ele_m"),
    "sums behind an empty line": lines(X, HEIGHT, head="x [m];z [m]", between=";", foot="\nMean;0.002\nMax;0.03"),
    **{
        f"{code} of missing cells": lines(
            X, [code if n in (50, 51) else z for n, z in enumerate(HEIGHT / MM)], head="distance [m],height [mm]"
        )
        for code in ("-9999", "-999.0", "9999.99", "-32768", "65535", "-1E+10", "-1.#IND", "*****", "#NV", "#WERT!")
    },
}
TWO_TRACKS = (
    *("two tracks", "wheel paths", "ERD in metres", "ERD in feet"),
    *("titles over two lines", "sides behind the height"),
)


@pytest.mark.parametrize("shape", ROADS)
def test_a_road_in_any_shape_is_read_right(shape: str) -> None:
    content = ROADS[shape]
    table = read_table(content.encode() if isinstance(content, str) else content, ROAD)
    assert not table.questions
    there = np.delete(np.arange(len(X)), (50, 51)) if "missing cells" in shape else slice(None)
    assert "missing cells" not in shape or "Rows without a value: 2, the first in line 52" in table.notes
    np.testing.assert_allclose(table.signals["distance"], X[there], atol=2e-6)
    for name, heights in zip(("left", "right") if shape in TWO_TRACKS else ("height",), (HEIGHT, RIGHT), strict=False):
        np.testing.assert_allclose(table.signals[name], heights[there], atol=2e-6)


def stamps(form: Callable[[datetime], str]) -> list[str]:
    start = datetime(2024, 5, 2, 23, 59, 58, tzinfo=UTC)
    return [form(start + timedelta(seconds=float(second))) for second in TIME]


def milliseconds(each: datetime) -> str:
    return f"{each:%H:%M:%S}.{each.microsecond // 1000:03}"


DRIVES: dict[str, str | bytes] = {
    "brackets": lines(TIME, SPEED, ACCELERATION, head="time [s],speed [m/s],body_acceleration [m/s^2]"),
    "milliseconds": lines([round(1000 * t) for t in TIME], ACCELERATION, head="time_ms,acc_z [m/s²]"),
    "nanoseconds": lines(
        [1_700_000_000_000_000_000 + round(t * 1e9) for t in TIME], ACCELERATION, head="timestamp [ns],az [m/s2]"
    ),
    "unix time": lines([f"{1_700_000_000 + t:.3f}" for t in TIME], ACCELERATION, head="timestamp(unix),acc z (m/s/s)"),
    "unix milliseconds": lines(
        [1_700_000_000_000 + round(t * 1e3) for t in TIME], ACCELERATION, head="timestamp(unix),acc z (m/s/s)"
    ),
    "ISO 8601": lines(
        stamps(lambda each: each.isoformat(timespec="milliseconds")),
        ACCELERATION,
        head="timestamp,body acceleration [m/s^2]",
    ),
    "ISO 8601 with Z": lines(
        stamps(lambda each: f"{each:%Y-%m-%d} {milliseconds(each)}Z"),
        ACCELERATION,
        head="Date Time,body acceleration [m/s^2]",
    ),
    "clock": lines(stamps(milliseconds), ACCELERATION, head="time,body acceleration [m/s^2]"),
    "clock with a decimal comma": lines(
        [each.replace(".", ",") for each in stamps(milliseconds)],
        comma(ACCELERATION),
        head="Zeit;Vertikalbeschleunigung [m/s²]",
        between=";",
    ),
    "minutes and seconds": lines(
        [f"{int(t) // 60:02}:{t % 60:06.3f}" for t in TIME],
        ACCELERATION,
        head="Elapsed time,Vertical acceleration [m/s^2]",
    ),
    "rate in the preamble": lines(ACCELERATION / G, head="Logger,7\nSample Rate,100,Hz\n\nvertical acceleration [g]"),
    "MoTeC": lines(
        quoted(TIME),
        quoted(3.6 * SPEED),
        quoted(ACCELERATION / G),
        head=MOTEC + '"Time","Ground Speed","G Force Vert"\n"s","km/h","G"\n',
    ),
    "MoTeC with a decimal point in blanks": lines(
        TIME,
        3.6 * SPEED,
        [3] * 400,
        ACCELERATION / G,
        head=MOTEC + '"Time","Ground Speed","Gear","G Force Vert"\n"s","km/h","","G"\n\n',
    ),
    "VBO": lines(
        [9] * 400,
        [f"1000{t:06.3f}" for t in TIME],
        [3119.09973] * 400,
        3.6 * SPEED,
        (ACCELERATION / G).round(7),
        head=VBO.removesuffix("\n"),
        between=" ",
    ),
    "VBO with channel units": lines(
        [9] * 400,
        [f"1000{t:06.3f}" for t in TIME],
        [3119.09973] * 400,
        SPEED,
        ACCELERATION,
        head=VBO.replace("kmh", "")
        .replace(" g\n", "\n")
        .replace("[comments]", "[channel units]\nm/s\nm/s^2\n\n[comments]")
        .removesuffix("\n"),
        between=" ",
    ),
    "knots": lines(TIME, SPEED * 3600 / 1852, ACCELERATION, head="t [s];v [kn];acc_z [m/s^2]", between=";"),
    "other names twice": lines(TIME, ACCELERATION, TIME, head="time (s),accZ (m/s^2),time (s)"),
    "a clock without a title": lines(
        stamps(lambda each: f"{each:%Y-%m-%d %H:%M:%S.%f}"), ACCELERATION, head=",body_acceleration [m/s^2]"
    ),
    "date and clock": lines(
        stamps(lambda each: f"{each:%d.%m.%Y}"),
        [each.replace(".", ",") for each in stamps(milliseconds)],
        comma(ACCELERATION),
        head="Datum;Uhrzeit;Aufbaubeschleunigung [m/s²]",
        between=";",
    ),
    "hours and milli-g": lines(TIME / 3600, ACCELERATION / G * 1000, head="Time (h),Body acceleration (mg)"),
    "powers of units": lines(TIME, ACCELERATION, SPEED, head="t (s),acc z (m·s⁻²),v (m·s⁻¹)"),
    "sources below units": lines(
        TIME,
        SPEED,
        ACCELERATION / G,
        ACCELERATION,
        head="Note\n\nelapsed_time,speed,z_acc,x_acc\ns,m/s,G,G\n,gps,acc,acc",
    ),
    "rate in words": lines(range(400), ACCELERATION, head="Sampling rate [Hz]: 100\nn;acc z [m/s²]", between=";"),
}


@pytest.mark.parametrize("shape", DRIVES)
def test_a_drive_in_any_shape_is_read_right(shape: str) -> None:
    content = DRIVES[shape]
    table = read_table(content.encode() if isinstance(content, str) else content, DRIVE)
    assert not table.questions, table.questions
    np.testing.assert_allclose(table.signals["time"] - table.signals["time"][0], TIME, atol=2e-4)
    np.testing.assert_allclose(table.signals["body_acceleration"], ACCELERATION, atol=1e-5)
    if "speed" in table.signals:
        np.testing.assert_allclose(table.signals["speed"], SPEED, rtol=1e-6)


@pytest.mark.parametrize(
    ("content", "kind", "asked"),
    [
        (lines(X, HEIGHT, head="x,z"), ROAD, {"/columns/0/unit": "m", "/columns/1/unit": "m"}),
        (
            lines(X, HEIGHT / MM),
            ROAD,
            {
                "/columns/0/means": "distance",
                "/columns/1/means": "height",
                "/columns/0/unit": "m",
                "/columns/1/unit": "mm",
            },
        ),
        (lines(X, HEIGHT, head="distance [m],height [furlong]"), ROAD, {"/columns/1/unit": "m"}),
        (lines(HEIGHT, head="height [m]"), ROAD, {"/clock/spacing": None}),
        (lines(100 * X, HEIGHT, head="distance [m],height [m]"), ROAD, {"/to": 3000.0}),
        (lines(X[abs(X - 20) > 1], HEIGHT[abs(X - 20) > 1], head="distance [m],height [m]"), ROAD, {"/bridge": 2.5}),
        (lines(X, [f'"{z},123"' for z in range(1, 162)], head="distance [m],height [mm]"), ROAD, {"/decimal": ","}),
        (
            lines(ACCELERATION, ACCELERATION, ACCELERATION + G, head="x;y;z", between=";"),
            DRIVE,
            {"/columns/2/means": "body_acceleration", "/columns/2/unit": "m/s^2", "/clock/rate": None},
        ),
        (lines(TIME, ACCELERATION, head="time,acc z"), DRIVE, {"/columns/0/unit": "s", "/columns/1/unit": "m/s^2"}),
        (
            lines(TIME, ACCELERATION, 2 * ACCELERATION, head="time [s],acc z [m/s^2],body acceleration [m/s^2]"),
            DRIVE,
            {"/columns/1/means": "2"},
        ),
        (lines(1000 * TIME, ACCELERATION, head="time [s],acc z [m/s^2]"), DRIVE, {"/to": 3600.0}),
        (lines(X, HEIGHT, head="Distance [m],Height [mm]\nm,m"), ROAD, {"/columns/1/unit": "m"}),
        (lines(X, X / 2, HEIGHT, head="X [m],Y [m],Z [m]"), ROAD, {"/columns/0/means": "distance"}),
        (lines(X, -HEIGHT, head="Distance [m],Depth [m]"), ROAD, {"/columns/1/means": "height"}),
        (
            lines(TIME, ACCELERATION, ACCELERATION + G, SPEED, head="t (s),acc z (m/s²),acc y (m/s²),v (m/s)"),
            DRIVE,
            {"/columns/2/means": "3"},
        ),
        (
            lines(TIME, SPEED, ACCELERATION, head="t (s),Linear acc x (m/s²),Linear Acceleration z (m/s²)"),
            DRIVE,
            {"/columns/2/means": "body_acceleration"},
        ),
        (
            lines(45413.4 + TIME / 86400, ACCELERATION, head="Time;acc z [m/s²]", between=";"),
            DRIVE,
            {"/columns/0/unit": "d"},
        ),
        (
            lines(TIME, ACCELERATION, SPEED, head="X_Value,acc z (m/s²),v (m/s),Comment"),
            DRIVE,
            {"/columns/0/means": "time", "/columns/0/unit": "s"},
        ),
        (lines(ACCELERATION, ACCELERATION, ACCELERATION, head="x,y,z"), None, {"/kind": "drive"}),
    ],
)
def test_what_is_not_sure_is_asked_with_the_right_guess(
    content: str, kind: str | None, asked: dict[str, object]
) -> None:
    table = read_table(content.encode(), kind)
    guesses = {question.field: question.guess for question in table.questions}
    assert guesses | asked == guesses
    assert kind is None or guesses.keys() == asked.keys()
    with pytest.raises(UnsureTableError):
        _ = table.signals


def test_a_description_sent_back_answers_its_questions_with_its_guesses() -> None:
    content = lines(X, HEIGHT / MM).encode()
    asked = read_table(content, ROAD)
    settled = read_table(content, ROAD, asked.description())
    assert asked.questions
    np.testing.assert_allclose(settled.signals["height"], HEIGHT, atol=1e-6)


def test_corrections_decide() -> None:
    content = lines(ACCELERATION, ACCELERATION, -(ACCELERATION + G), head="x;y;z", between=";").encode()
    column = {"title": "z", "means": "body_acceleration", "unit": "m/s^2", "direction": "down"}
    table = read_table(content, DRIVE, {"columns": [column], "clock": {"rate": 100}, "from": 1, "to": 2})
    np.testing.assert_allclose(table.signals["body_acceleration"], ACCELERATION[100:201] + G)
    road = read_table(lines(100 * X, HEIGHT, head="distance [m],height [m]").encode(), ROAD, {"from": 500, "to": 1000})
    assert road.signals["distance"][[0, -1]].tolist() == [500, 1000]


@pytest.mark.parametrize("asked", wording.asked_in("tables"), ids=str)
def test_what_is_no_table_or_no_correction_is_refused_at_its_line(asked: dict[str, Any]) -> None:
    with pytest.raises(TableError) as refused:
        read_table(asked["content"].encode(), asked["kind"], asked.get("table"))
    wording.check("tables", asked, [refused.value.line, str(refused.value)])


@pytest.mark.parametrize(
    ("content", "message", "line"),
    [
        ('distance [m],height [m]\n0,0\n1,1\n2,"' + "2,\n" * 70_000, "quotation mark is not closed", 4),
        ("distance [m]," + "," * 1000 + "\n0,0\n1,1\n", "columns at most", 1),
        ("distance [m],height [m]\n" + "0" * 30_000 + ",1\n1,1\n2,2\n", "characters at most", 2),
        (f"distance [m],height [m]\n{'1' * 9000}+{'1' * 9000},1\n" + "1,1\n" * 50, "is not a number", 2),
    ],
)
def test_what_is_too_long_is_refused_at_its_line(content: str, message: str, line: int) -> None:
    with pytest.raises(TableError, match=message) as refused:
        read_table(content.encode(), ROAD)
    assert refused.value.line == line


def test_a_spreadsheet_is_read(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in [
        ("Survey of May",),
        (),
        ("distance [m]", "height [mm]"),
        *zip(X.tolist(), (HEIGHT / MM).tolist(), strict=True),
    ]:
        book.active.append(row)
    path = tmp_path / "road.xlsx"
    book.save(path)
    table = read_table(path, ROAD)
    assert (table.encoding, table.titles_line) == ("xlsx", 3)
    np.testing.assert_allclose(table.signals["height"], HEIGHT, atol=1e-9)
    book.create_sheet("notes", 0)
    book.save(path)
    assert [question.guess for question in read_table(path, ROAD).questions] == ["Sheet"]
    assert not read_table(path, ROAD, {"sheet": "Sheet"}).questions


def test_a_spreadsheet_that_unpacks_to_too_much_is_refused() -> None:
    import zipfile

    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/worksheets/sheet1.xml", b"0" * (80 * 2**20))
    with pytest.raises(TableError, match="unpacks to more than 64 MB"):
        read_table(packed.getvalue(), ROAD)
