"""The container files, read as text and YAML: no container engine is needed."""

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from backend.settings import MAX_BODY_BYTES, Settings
from tests.servers.compose import COMPOSE, VARIABLE
from tests.servers.process import ROOT
from tests.servers.programs import make_secrets

SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
IMAGE = r"[a-z]+:\d+[\w.-]*(?:@sha256:[0-9a-f]{64})?"


@pytest.fixture(scope="module")
def instructions() -> list[list[str]]:
    """The Dockerfile's instructions, continuation lines joined."""
    text = re.sub(r"\\\n", " ", (ROOT / "Dockerfile").read_text())
    return [shlex.split(line) for line in text.splitlines() if line and not line.startswith("#")]


def test_each_service_runs_with_as_little_as_it_needs_bounded_watched_and_of_a_version() -> None:
    """That the engine holds them to it can be seen in a running container alone."""
    assert [name for name, service in SERVICES.items() if "build" in service] == ["proxy", "api", "database"]
    for name, service in SERVICES.items():
        hardened = (service["read_only"], service["cap_drop"], service["security_opt"])
        assert hardened == (True, ["ALL"], ["no-new-privileges:true"]), name
        assert min(map(int, service["user"].split(":"))) > 0, name
        assert all("size=" in mount for mount in service["tmpfs"]), name
        assert not service.keys() & {"privileged", "cap_add", "devices", "pid", "ipc", "network_mode", "volumes_from"}
        assert set(service["deploy"]["resources"]["limits"]) == {"cpus", "memory", "pids"}, name
        assert (service["healthcheck"]["test"][0], service["restart"]) == ("CMD", "unless-stopped"), name
        assert int(service["stop_grace_period"].removesuffix("s")) > 10, "the service itself takes up to ten"
        assert service["logging"]["options"].keys() == {"max-size", "max-file"}, name
        assert "build" in service or (service["image"], service["pull_policy"]) == ("ridelab", "never"), name


def test_images_are_pinned_by_digest_once_there_is_a_registry(tmp_path: Path) -> None:
    """`make pin`, twice, with a docker that invents digests."""
    file = Path(shutil.copy(ROOT / "Dockerfile", tmp_path))
    docker = tmp_path / "docker"
    command = [ROOT / "backend/deploy/pin_images.sh", file]
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    images = re.findall(rf"^FROM ({IMAGE})", file.read_text(), re.MULTILINE)
    assert images
    for digit in "ab":
        docker.write_text(f'#!/bin/sh\nprintf "sha256:%064d" 0 | tr 0 {digit}\n')
        docker.chmod(0o755)
        subprocess.run(command, env=environment, check=True, capture_output=True)
        pinned = file.read_text()
        assert pinned.count(f"@sha256:{digit * 64}") == len(images) == pinned.count("@sha256:")
    docker.write_text("#!/bin/sh\necho no such image\n")
    done = subprocess.run(command, env=environment, capture_output=True, check=False)
    assert done.returncode == 1


def test_only_the_proxy_is_reached_from_outside_and_by_default_from_this_machine_only() -> None:
    assert [name for name, service in SERVICES.items() if "ports" in service] == ["proxy"]
    ports = [VARIABLE.sub(r"\2", port) for port in SERVICES["proxy"]["ports"]]
    assert ports == ["127.0.0.1:8000:8080", "127.0.0.1:8443:8443"]
    inside = {name for name, network in COMPOSE["networks"].items() if (network or {}).get("internal")}
    assert {name for name, service in SERVICES.items() if set(service["networks"]) - inside} == {"proxy"}
    meet_the_proxy = {name for name, service in SERVICES.items() if set(service["networks"]) & {"edge", "front"}}
    assert meet_the_proxy == {"proxy", "api"}


def test_secrets_are_files_and_not_in_the_file(tmp_path: Path) -> None:
    for name, service in SERVICES.items():
        for key, value in service.get("environment", {}).items():
            if value is not None and re.search("PASSWORD|SECRET|TOKEN|KEY|CERT", key):
                assert value.startswith("/run/secrets/"), f"{name}: {key}"
                assert value.removeprefix("/run/secrets/") in service["secrets"], f"{name}: {key}"
            assert not re.search(r"://[^/@]*:[^/@]*@", str(value)), f"{name}: {key} holds a password"
    assert {"/secrets/", ".env"} <= set((ROOT / ".gitignore").read_text().splitlines())
    folder = make_secrets(tmp_path / "secrets")
    assert {secret["file"] for secret in COMPOSE["secrets"].values()} == {f"secrets/{path.name}" for path in folder}


def test_the_script_makes_secrets_for_nobody_else_and_keeps_them(tmp_path: Path) -> None:
    folder = tmp_path / "secrets"
    files = {path.name: path.read_bytes() for path in make_secrets(folder)}
    assert folder.stat().st_mode & 0o077 == 0, "nobody else looks into the folder"
    assert len(files["database_password"].strip()) >= 32
    assert {path.name: path.read_bytes() for path in make_secrets(folder)} == files


def test_what_may_be_changed_is_in_the_example_with_its_default() -> None:
    variables = dict(VARIABLE.findall((ROOT / "docker-compose.yml").read_text()))
    lines = (ROOT / ".env.example").read_text().splitlines()
    example = dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))
    assert example == variables


def test_every_setting_and_every_limit_of_the_proxy_comes_from_env() -> None:
    """But for where things are in this file's own topology."""
    api = SERVICES["api"]
    assert {"path": ".env", "required": False} in api["env_file"], "what no line below sets"
    ours = {name: value for name, value in api["environment"].items() if name.startswith("RIDELAB_") and value}
    fixed = {name for name, value in ours.items() if f"${{{name}:-" not in value}
    places = {"CONTROLLERS", "DATABASE_PASSWORD_FILE", "DATABASE_URL", "FORWARDED_ALLOW_IPS"}
    assert {name.removeprefix("RIDELAB_") for name in fixed if "DASK" not in name} == places
    read = re.findall(r"\$\{?(PROXY_\w+)", (ROOT / "backend/deploy/haproxy.cfg").read_text())
    of_the_proxy = {"PROXY_BIND", "PROXY_TLS_BIND", "PROXY_CERTIFICATE"}
    variables = {name for name, _ in VARIABLE.findall((ROOT / "docker-compose.yml").read_text())}
    assert set(read) - of_the_proxy <= variables


def test_the_proxy_waits_longer_than_the_service_and_holds_its_longest_body() -> None:
    text = (ROOT / "backend/deploy/haproxy.cfg").read_text()
    timeout = re.search(r"timeout server (\d+)s", text)
    assert timeout
    assert int(timeout[1]) > Settings().run_timeout
    buffer = re.search(r"tune.bufsize (\d+)", text)
    assert buffer
    assert int(buffer[1]) > MAX_BODY_BYTES + 2 * 16384, "headers, and room for what the proxy writes itself"


LOCKS = {"requirements-manual.lock", "requirements-cluster.lock", "requirements-compiler.lock"}


def test_the_image_holds_packages_to_their_hashes_and_runs_as_nobody_special(instructions: list[list[str]]) -> None:
    installs = [words for words in instructions if "pip" in words]
    assert installs
    assert all("--require-hashes" in words for words in installs)
    assert {lock for words in installs for lock in words if lock.endswith(".lock")} == LOCKS
    assert any("npm" in words and "ci" in words for words in instructions)
    last_stage = instructions[max(i for i, words in enumerate(instructions) if words[0] == "FROM") :]
    assert ["USER", SERVICES["api"]["user"]] in last_stage
    assert all(re.search(r":\d", words[1]) for words in instructions if words[0] == "FROM"), "images of a version"
    assert ["VOLUME", "/data"] in instructions
