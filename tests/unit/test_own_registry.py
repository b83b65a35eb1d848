"""What there is of one's own: a file that takes too long is tried again, ever less often."""

from pathlib import Path
from typing import Any, NoReturn

import pytest

from backend.own import registry
from backend.own.host import SlowFileError
from sim_core import controller_files


class Slow:
    """In a host's place: its file never ends."""

    def __init__(self, source: str) -> None:
        pass

    def call(self, *_: Any, limit: float) -> NoReturn:
        raise SlowFileError("slow.py: it did not end")

    def close(self) -> None:
        pass


class Clock:
    """In the place of `time`."""

    now = 0.0

    def monotonic(self) -> float:
        return self.now


def test_the_pause_before_another_try_doubles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_sources", "_of", "_controllers"):
        monkeypatch.setattr(registry, name, type(getattr(registry, name))())
    monkeypatch.setattr(controller_files, "_find", controller_files.load_all)
    monkeypatch.setattr(registry, "Host", Slow)
    clock = Clock()
    monkeypatch.setattr(registry, "time", clock)
    (tmp_path / "slow.py").touch()
    monkeypatch.setenv(controller_files.VARIABLE, str(tmp_path))
    registry.refresh(20.0)
    stand_in = registry._controllers["slow"]
    for pause in (60.0, 120.0, 240.0):
        clock.now += pause - 1
        assert not registry.slow()
        clock.now += 1
        assert registry.slow()
        registry.try_again(20.0)
        assert registry._controllers["slow"] is stand_in, "what ends the same way makes nothing anew"
    (tmp_path / "slow.py").write_text("pass")
    assert registry.stale()
    registry.refresh(20.0)
    clock.now += 60
    assert registry.slow(), "a saved file begins with the first pause again"
