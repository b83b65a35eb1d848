"""The container files, read as text and YAML: no container engine is needed."""

import re
import shlex
from pathlib import Path
from typing import Any

import pytest
import yaml

from backend.settings import Settings

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def compose() -> dict[str, Any]:
    content: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
    return content


@pytest.fixture(scope="module")
def instructions() -> list[list[str]]:
    """The Dockerfile's instructions, continuation lines joined."""
    text = re.sub(r"\\\n", " ", (ROOT / "Dockerfile").read_text())
    return [shlex.split(line) for line in text.splitlines() if line and not line.startswith("#")]


def test_the_service_runs_with_as_little_as_it_needs(compose: dict[str, Any]) -> None:
    service = compose["services"]["ridelab"]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert "no-new-privileges:true" in service["security_opt"]
    assert service["user"] == "10001:10001"
    assert any(mount.startswith("/tmp:") for mount in service["tmpfs"])  # noqa: S108 - a mount, not a file
    assert "privileged" not in service
    assert set(service["deploy"]["resources"]["limits"]) == {"cpus", "memory", "pids"}
    assert service["healthcheck"]["test"][0] == "CMD"
    assert int(service["stop_grace_period"].removesuffix("s")) > 10, "the service itself takes up to ten"


def test_the_database_outlives_the_container(compose: dict[str, Any], instructions: list[list[str]]) -> None:
    assert compose["services"]["ridelab"]["volumes"] == ["data:/data"]
    assert "data" in compose["volumes"]
    environment = next(words for words in instructions if words[0] == "ENV")
    assert "RIDELAB_DATA_DIR=/data" in environment


def test_only_this_machine_reaches_it_by_default(compose: dict[str, Any]) -> None:
    assert all(port.startswith("127.0.0.1:") for port in compose["services"]["ridelab"]["ports"])


def test_its_settings_exist(compose: dict[str, Any]) -> None:
    environment = compose["services"]["ridelab"]["environment"]
    assert Settings.from_environment(environment).workers == int(environment["RIDELAB_WORKERS"])


def test_the_image_holds_packages_to_their_hashes_and_runs_as_nobody_special(instructions: list[list[str]]) -> None:
    installs = [words for words in instructions if "pip" in words]
    assert installs
    assert all("--require-hashes" in words and "requirements.lock" in words for words in installs)
    last_stage = instructions[max(i for i, words in enumerate(instructions) if words[0] == "FROM") :]
    assert ["USER", "10001:10001"] in last_stage
    assert last_stage[-1][:1] == ["CMD"]


def test_everything_copied_into_the_image_exists_and_is_not_ignored(instructions: list[list[str]]) -> None:
    allowed = {line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")}
    copied = [
        source.rstrip("/")
        for words in instructions
        if words[0] == "COPY" and not words[1].startswith("--from")
        for source in words[1:-1]
    ]
    assert {"sim_core", "backend", "requirements.lock"} <= set(copied)
    for source in copied:
        assert (ROOT / source).exists(), source
        assert source.split("/")[0] in allowed, source
