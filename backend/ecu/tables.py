"""The controller's numbers for the C program: float32, loaded at its start, or C text to compile in."""

import struct
import zlib
from collections.abc import Iterable, Iterator

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.ecu.calibration import MOST_ACTIVE, Calibration
from sim_core.ecu.channels import PREVIEW, SENSORS, STAGES, highest_code
from sim_core.vehicle.half_car import FORCES, STATES

_ACROSS = 6  # numbers a line


def fingerprint(calibration: Calibration) -> int:
    """The hash of a set of tables: both sides of a connection must have the same."""
    return zlib.crc32(_body(calibration))


def loaded(calibration: Calibration) -> bytes:
    """The bytes that the program reads at its start: fingerprint, sizes, tables."""
    body = _body(calibration)
    return struct.pack("<I", zlib.crc32(body)) + body


def _body(calibration: Calibration) -> bytes:
    whole = (
        calibration.intervals,
        calibration.preview_length,
        calibration.row_count,
        int(calibration.predicts),
        calibration.iterations,
        highest_code(calibration.bits),
    )
    real = (calibration.command_step, calibration.slack_price, calibration.inverse_slack_weight)
    head = struct.pack("<6i3f", *whole, *real)
    parts = [
        _single(part)
        for part in (calibration.input_steps, calibration.A, calibration.B, calibration.E, calibration.bounds)
    ]
    parts.append(np.array(calibration.axles, dtype=np.int8).tobytes())
    for stage in calibration.stages:
        parts += [_single(stage.rows), _single(stage.gram)]
    return b"".join([head, *parts])


def _single(values: FloatArray) -> bytes:
    return np.ascontiguousarray(values, dtype="<f4").tobytes()


def sizes_header(calibration: Calibration) -> str:
    """`ridelab_sizes.h` of an exported controller: memory for these tables and no more."""
    return _guarded(
        "RIDELAB_SIZES_H",
        "How much memory the controller keeps: what these tables need.",
        [
            f"#define RIDELAB_MOST_PREVIEWED {calibration.preview_length}",
            f"#define RIDELAB_MOST_ROWS {calibration.row_count}",
            f"#define RIDELAB_MOST_ACTIVE {most_active(calibration)}",
        ],
    )


def most_active(calibration: Calibration) -> int:
    """Limits that may bind together: one more than there are unknowns, forces and two slacks, never happens."""
    return min(MOST_ACTIVE, FORCES * calibration.moves + 3)


def calibration_header(calibration: Calibration) -> str:
    """`ridelab_calibration.h`: the tables' name, and the channels with their ranges."""
    lines = ['#include "ridelab_tables.h"', "", f"#define RIDELAB_FINGERPRINT 0x{fingerprint(calibration):08x}u", ""]
    highest = highest_code(calibration.bits)
    lines.append(f"/* Converters of {calibration.bits} bits: codes from -{highest} to the same above zero.")
    for i, channel in enumerate(SENSORS):
        lines.append(f"   code {i}: {channel.label.lower()}, +-{channel.full_scale:g} {channel.unit}")
    for i, channel in enumerate(PREVIEW):
        first = STATES + i * calibration.preview_length
        last = first + calibration.preview_length - 1
        lines.append(f"   codes {first} to {last}: {channel.label.lower()}, +-{channel.full_scale:g} {channel.unit}")
    lines.append(f"   commands: force front and rear, +-{calibration.command_step * highest * KILO:g} N */")
    lines.append("extern const ridelab_tables ridelab_calibration;")
    return _guarded("RIDELAB_CALIBRATION_H", "The tables of one scenario.", lines)


def tables_source(calibration: Calibration) -> str:
    """`ridelab_tables.c`."""
    single = {
        "input_steps": calibration.input_steps,
        "a": calibration.A,
        "b": calibration.B,
        "e": calibration.E,
        "bounds": calibration.bounds,
    }
    lines = ["/* Generated. */", '#include "ridelab_calibration.h"', ""]
    for name, values in single.items():
        lines += _array(name, values)
    axles = ", ".join(map(str, calibration.axles))
    lines += [f"static const int8_t axles[{len(calibration.axles)}] = {{{axles}}};", ""]
    for stage, tables in zip(STAGES, calibration.stages, strict=True):
        lines += [*_array(f"{stage}_effects", tables.rows), *_array(f"{stage}_gram", tables.gram)]
    fields = {
        "intervals": str(calibration.intervals),
        "previewed": str(calibration.preview_length),
        "rows": str(calibration.row_count),
        "predicts": str(int(calibration.predicts)),
        "iterations": str(calibration.iterations),
        "highest": str(highest_code(calibration.bits)),
        "command_step": _text(calibration.command_step),
        "slack_price": _text(calibration.slack_price),
        "inverse_slack_weight": _text(calibration.inverse_slack_weight),
        **{name: name for name in single},
        "axles": "axles",
        "effects": "{" + ", ".join(f"{stage}_effects" for stage in STAGES) + "}",
        "gram": "{" + ", ".join(f"{stage}_gram" for stage in STAGES) + "}",
    }
    lines.append("const ridelab_tables ridelab_calibration = {")
    lines += [f"    .{name} = {value}," for name, value in fields.items()]
    return "\n".join([*lines, "};", ""])


def _guarded(name: str, purpose: str, lines: Iterable[str]) -> str:
    head = [f"/* Generated. {purpose} */", f"#ifndef {name}", f"#define {name}", ""]
    return "\n".join([*head, *lines, "", "#endif", ""])


def _array(name: str, values: FloatArray) -> Iterator[str]:
    flat = np.asarray(values, dtype=np.float32).ravel()
    yield f"static const float {name}[{len(flat)}] = {{"
    for first in range(0, len(flat), _ACROSS):
        yield "    " + " ".join(f"{_text(value)}," for value in flat[first : first + _ACROSS])
    yield "};"
    yield ""


def _text(value: float) -> str:
    """A float32 as C text: nine digits represent it exactly (IEEE 754, table in 5.12.2)."""
    text = f"{float(np.float32(value)):.9g}"
    return f"{text}f" if any(mark in text for mark in ".en") else f"{text}.0f"
