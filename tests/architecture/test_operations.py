"""docs/how-to/operations.md names every setting with its default, every variable of the proxy, and every metric."""

import re
from pathlib import Path
from typing import Any

import pytest
from prometheus_client.core import Metric
from pydantic_core import PydanticUndefined

from backend.__main__ import main
from backend.gate import Gate, explained
from backend.metrics import service_registry
from backend.settings import REMOVED, Settings

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs/how-to/operations.md").read_text()


def rows(prefix: str, text: str = TEXT) -> dict[str, str]:
    """Return variable and second cell of every table row whose first cell begins so."""
    return dict(re.findall(rf"^\| `({prefix}\w+)` \| ([^|]+?) \|", text, re.MULTILINE))


KEPT, GONE = TEXT.split("| gone in ")


def test_the_settings_are_all_there_and_no_others() -> None:
    assert list(rows("RIDELAB_", KEPT)) == list(variables())
    assert rows("RIDELAB_", GONE).keys() == REMOVED


def variables() -> dict[str, object]:
    """Each variable with its default, undefined where it is computed."""
    return {f"RIDELAB_{name.upper()}": field.default for name, field in Settings.model_fields.items()}


@pytest.mark.parametrize(("name", "default"), variables().items(), ids=variables().keys())
def test_a_default_is_the_one_in_the_code(name: str, default: object) -> None:
    written = rows("RIDELAB_", KEPT)[name].strip("`")
    if isinstance(default, bool):
        assert written == ("yes" if default else "no")
    elif isinstance(default, int | float):
        assert float(written) == default
    elif isinstance(default, Path):
        assert Path.cwd().joinpath(default).as_posix().endswith(written)
    elif default in (None, ""):
        assert written == "none"
    elif default is PydanticUndefined:
        assert "cores" in written
    else:
        assert written == default


def test_the_proxys_variables_are_documented() -> None:
    configuration = (ROOT / "backend/deploy/haproxy.cfg").read_text()
    with_defaults = re.findall(r"\$\{?(PROXY_\w+)(?:-([^}\"]*)\})?", configuration)
    read = {name: next((d for n, d in with_defaults if n == name and d), "none") for name, _ in with_defaults}
    assert {name: value.strip("`") for name, value in rows("PROXY_").items()} == read


def test_the_limits_are_those_that_a_service_prints_with_its_own_settings(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert explained(Gate(Settings()).limits()) in TEXT
    monkeypatch.setenv("RIDELAB_MAX_CLIENT_REQUESTS", "7")
    assert main(["--explain-limits", "--data-dir", str(tmp_path)]) == 0
    assert "| requests of one client, waiting or handled | 7 | 429 |" in capsys.readouterr().out


class Idle:
    """Workers and gate with nothing to do."""

    load: Any = dict.fromkeys(("busy", "idle", "waiting", "cost", "requests", "streams", "memory"), 0)


def test_the_metrics_are_all_there_and_no_others() -> None:
    def name(metric: Metric) -> str:
        return f"{metric.name}_total" if metric.type == "counter" else metric.name

    exported = {name(metric) for metric in service_registry(Idle(), Idle()).collect()}
    gone = {old for old, new in re.findall(r"`(ridelab_\w+)` is now `(ridelab_\w+)`", TEXT) if new in exported}
    documented = set(re.findall(r"`(ridelab_\w+)`", TEXT)) - gone
    assert documented == {name for name in exported if name.startswith("ridelab_")}


def test_the_secrets_script_does_what_the_page_says_by_hand() -> None:
    """The script and the page make three equal calls of openssl, apart from names."""
    script = (ROOT / "backend/deploy/secrets.sh").read_text()
    for text in (script, TEXT):
        for words in ("openssl req -x509", "openssl x509 -req", "ec_paramgen_curve:prime256v1", "-CAcreateserial"):
            assert words in text
