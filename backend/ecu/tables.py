"""The controller's numbers for the C program, float32: C text to compile in, and their fingerprint."""

import struct
import zlib
from collections.abc import Iterator

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW, SENSORS, STAGES, highest_code
from sim_core.vehicle.half_car import FORCES, STATES

_ACROSS = 6  # numbers a line


def fingerprint(calibration: Calibration) -> int:
    """Return the hash of a set of tables: both sides of a connection must have the same."""
    sizes = (calibration.intervals, calibration.preview_length, calibration.row_count, int(calibration.predicts))
    whole = (*sizes, calibration.iterations, highest_code(calibration.bits))
    real = (calibration.command_step, calibration.slack_price, calibration.inverse_slack_weight)
    parts = [np.ascontiguousarray(values, dtype="<f4").tobytes() for values in calibration.arrays.values()]
    parts.insert(5, np.array(calibration.axles, dtype=np.int8).tobytes())  # before those of the stages
    return zlib.crc32(struct.pack("<6i3f", *whole, *real) + b"".join(parts))


def calibration_header(calibration: Calibration) -> str:
    """Return `ridelab_calibration.h`: the tables' name, and the channels with their ranges."""
    lines = [
        "/* Generated. The tables of one scenario. */",
        "#ifndef RIDELAB_CALIBRATION_H",
        "#define RIDELAB_CALIBRATION_H",
    ]
    lines += ["", '#include "ridelab_dual.h"', "", f"#define RIDELAB_FINGERPRINT 0x{fingerprint(calibration):08x}u", ""]
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
    lines += ["", "/* What the controller works in: codes to read, limits that bind, numbers. */"]
    lines.append(f"#define RIDELAB_CODE_COUNT {code_count(calibration)}")
    lines += [f"extern {memory};" for memory in _memory(calibration)]
    return "\n".join([*lines, "", "#endif", ""])


def tables_source(calibration: Calibration) -> str:
    """Return `ridelab_tables.c`: the tables, and the memory that they need."""
    axles = ", ".join(map(str, calibration.axles))
    lines = ["/* Generated. */", '#include "ridelab_calibration.h"', ""]
    lines += [f"static const int8_t axles[{len(calibration.axles)}] = {{{axles}}};", ""]
    lines += [line for name, values in calibration.arrays.items() for line in _array(name, values)]
    fields = {
        "intervals": str(calibration.intervals),
        "previewed": str(calibration.preview_length),
        "rows": str(calibration.row_count),
        "predicts": str(int(calibration.predicts)),
        "iterations": str(calibration.iterations),
        "highest": str(highest_code(calibration.bits)),
        "active": str(calibration.most_active),
        "command_step": _text(calibration.command_step),
        "slack_price": _text(calibration.slack_price),
        "inverse_slack_weight": _text(calibration.inverse_slack_weight),
        **{name: name for name in ("input_steps", "a", "b", "e", "bounds")},
        "axles": "axles",
        "effects": "{" + ", ".join(f"{stage}_effects" for stage in STAGES) + "}",
        "gram": "{" + ", ".join(f"{stage}_gram" for stage in STAGES) + "}",
    }
    lines.append("const ridelab_tables ridelab_calibration = {")
    lines += [f"    .{name} = {value}," for name, value in fields.items()]
    lines += ["};", "", *(f"{memory};" for memory in _memory(calibration)), ""]
    return "\n".join(lines)


def code_count(calibration: Calibration) -> int:
    """Return how many codes an input has."""
    return STATES + len(PREVIEW) * calibration.preview_length


def work_count(calibration: Calibration) -> int:
    """Return how many numbers the controller works in: RIDELAB_WORK of ridelab_controller.h."""
    columns, active = STATES + FORCES + len(PREVIEW) * calibration.intervals, calibration.most_active
    return columns + calibration.row_count + active * (active + 3)


def _memory(calibration: Calibration) -> list[str]:
    """Return the declarations of the controller's memory."""
    return [
        f"int32_t ridelab_codes[{code_count(calibration)}]",
        f"ridelab_limit ridelab_limits[{calibration.most_active}]",
        f"float ridelab_work[{work_count(calibration)}]",
    ]


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
