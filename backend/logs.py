"""Logs of the whole process on standard error: text on a terminal, else a JSON object for each event."""

import json
import logging
import sys
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Literal

Level = Literal["debug", "info", "warning", "error"]
REQUEST_ID: ContextVar[str] = ContextVar("request_id", default="")  # of the current request; empty outside one

# Control characters, and those at which some viewers break a line, as their escapes.
CONTROL = {code: f"\\x{code:02x}" for code in (*range(0x20), *range(0x7F, 0xA0))} | {
    code: f"\\u{code:04x}" for code in (0x2028, 0x2029)
}
# What every record has, and uvicorn's second copy of the text, with a terminal's colours; the rest is the event's own.
USUAL = {*vars(logging.makeLogRecord({})), "message", "asctime", "taskName", "color_message"}


class Lines(logging.Formatter):
    """An event as a line: its text, what it was told with, the request it belongs to, an exception's traceback."""

    def __init__(self, *, as_text: bool) -> None:
        super().__init__()
        self._as_text = as_text

    def format(self, record: logging.LogRecord) -> str:
        """Return a line; in text a traceback follows it."""
        time = datetime.fromtimestamp(record.created, UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")
        line = {"event": record.getMessage(), "level": record.levelname.lower(), "logger": record.name}
        line |= {"timestamp": time, **{name: value for name, value in vars(record).items() if name not in USUAL}}
        if request := REQUEST_ID.get():
            line["request_id"] = request
        trace = self.formatException(record.exc_info) if record.exc_info else ""
        if not self._as_text:  # whatever a text holds, it stays within its string and its line
            return json.dumps(line | ({"exception": trace} if trace else {}), default=repr)
        words = [f"{time} [{line.pop('level')}] {line.pop('event')} [{line.pop('logger')}]"]
        words += [f"{name}={value!r}" for name, value in line.items() if name != "timestamp"]
        return "\n".join(each.translate(CONTROL) for each in (" ".join(words), *trace.splitlines()))


def _is_for_a_person(record: logging.LogRecord) -> bool:
    """Check whether it is more than a step of a start or an end; what an end waits for says how to force it."""
    return record.levelno > logging.INFO or "force quit" in record.getMessage()


def on_terminal() -> bool:
    """Check whether standard error is one."""
    return sys.stderr.isatty()


def configure(level: Level) -> None:
    """Send the whole process's logs to standard error, from that level on."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(Lines(as_text=on_terminal()))
    root = logging.getLogger()
    root.handlers = [handler]
    root.setLevel(level.upper())
    if level == "info" and on_terminal():
        logging.getLogger("uvicorn.error").addFilter(_is_for_a_person)
    logging.captureWarnings(True)
