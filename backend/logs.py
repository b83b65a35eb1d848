"""Structured logs: one line for each event on standard error, JSON or text; every library's events too."""

import json
import logging
import sys
from datetime import UTC, datetime
from typing import Literal

Format = Literal["json", "console"]
Level = Literal["debug", "info", "warning", "error"]

# Control characters, and those at which some viewers break a line, as their escapes.
CONTROL = {code: f"\\x{code:02x}" for code in (*range(0x20), *range(0x7F, 0xA0))} | {
    code: f"\\u{code:04x}" for code in (0x2028, 0x2029)
}
# What every record has, and uvicorn's second copy of the text, with a terminal's colours; the rest is the event's own.
USUAL = {*vars(logging.makeLogRecord({})), "message", "asctime", "taskName", "color_message"}


class Lines(logging.Formatter):
    """An event as a line: its text, what it was told with, the request it belongs to, an exception's traceback."""

    def __init__(self, form: Format) -> None:
        super().__init__()
        self._form = form

    def format(self, record: logging.LogRecord) -> str:
        """A line; a traceback follows it in text."""
        from backend.http.request_log import request_id  # the web stack, which a start imports last

        time = datetime.fromtimestamp(record.created, UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")
        more = {name: value for name, value in vars(record).items() if name not in USUAL}
        if request := request_id():
            more["request_id"] = request
        trace = self.formatException(record.exc_info) if record.exc_info else ""
        level, event = record.levelname.lower(), record.getMessage()
        if self._form == "json":
            # Everything but ASCII is escaped: whatever a text holds, it stays within its string and its line.
            line = {"event": event, "level": level, "logger": record.name, "timestamp": time, **more}
            return json.dumps(line | ({"exception": trace} if trace else {}), default=repr)
        words = [
            f"{time} [{level}] {event}",
            f"[{record.name}]",
            *(f"{name}={value!r}" for name, value in more.items()),
        ]
        lines = [" ".join(words), *trace.splitlines()]
        # Escaped, so that it cannot begin another line or move the cursor.
        return "\n".join(line.translate(CONTROL) for line in lines)


def _is_for_a_person(record: logging.LogRecord) -> bool:
    """Whether it is more than a step of a start or an end; what an end waits for says how to force it."""
    return record.levelno > logging.INFO or "force quit" in record.getMessage()


def on_terminal() -> bool:
    """Whether standard error is one."""
    return sys.stderr.isatty()


def configure(form: Format | None, level: Level) -> None:
    """Send the whole process's logs to standard error in this form; None is text on a terminal, else JSON."""
    form = form or ("console" if on_terminal() else "json")
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(Lines(form))
    root = logging.getLogger()
    root.handlers = [handler]
    root.setLevel(level.upper())
    if form == "console" and level == "info" and on_terminal():
        logging.getLogger("uvicorn.error").addFilter(_is_for_a_person)
    logging.captureWarnings(True)
