"""What each container may do, what the service answers in them, and controllers of one's own."""

import json
import shutil
import time

import pytest

from tests.compose.engine import SERVICES, Composed, docker, inspect, wait
from tests.servers.process import ROOT

NETWORKS = {
    "proxy": {"edge", "front"},
    "api": {"front", "back"},
    "scheduler": {"back"},
    "worker": {"back"},
    "database": {"back"},
}
CLUSTER = "/var/lib/postgresql/data"
WRITABLE = {
    "proxy": {"/tmp"},  # noqa: S108 - a container's
    "api": {"/tmp", "/fmu", "/data"},  # noqa: S108 - a container's
    "scheduler": {"/tmp", "/data"},  # noqa: S108 - a container's
    "worker": {"/tmp", "/fmu", "/data"},  # noqa: S108 - a container's
    "database": {"/tmp", "/var/run/postgresql", CLUSTER},  # noqa: S108 - a container's
}
RUNS_PROGRAMS = {"api": {"/fmu", "/data"}, "worker": {"/fmu"}, "database": {CLUSTER}}  # on a disk Docker allows it
PLACES = (
    "/ /app /etc /opt/ridelab /usr /usr/local /var /home /root /run /run/secrets /controllers /fmu /tmp /data "
    f"/var/run/postgresql {CLUSTER}"
)
PROBE = """for place in PLACES; do
    [ -d $place ] && printf '#!/bin/sh\\n' 2>/dev/null >$place/.probe || continue
    echo $place; chmod +x $place/.probe; $place/.probe 2>/dev/null && echo runs:$place; rm -f $place/.probe
done; true""".replace("PLACES", PLACES)


@pytest.mark.parametrize("part", SERVICES)
def test_a_container_may_do_what_it_needs_and_no_more(service: Composed, part: str) -> None:
    for name in service.containers(part):
        facts = inspect(name)
        host = facts["HostConfig"]
        users = {line.split()[0] for line in docker("top", name, "-eo", "uid,pid").splitlines()[1:]}
        assert "0" not in users
        assert (host["ReadonlyRootfs"], host["CapDrop"]) == (True, ["ALL"])
        assert not host["CapAdd"]
        assert not host["Privileged"]
        assert min(host["Memory"], host["NanoCpus"], host["PidsLimit"]) > 0
        assert host["LogConfig"]["Config"]["max-size"]
        status = docker("exec", name, "cat", "/proc/self/status")
        assert {line.split()[1] for line in status.splitlines() if line.startswith("Cap")} == {"0" * 16}
        assert "NoNewPrivs:\t1" in status
        assert "Seccomp:\t2" in status
        written = set(docker("exec", name, "sh", "-c", PROBE).split())
        # Whether the mode that a tmpfs on a folder of the image is given counts depends on runc's version.
        assert {each for each in written if not each.startswith("runs:")} | {"/data"} == WRITABLE[part] | {"/data"}
        assert {each for each in written if each.startswith("runs:")} == {
            f"runs:{each}" for each in RUNS_PROGRAMS.get(part, ())
        }
        networks = {each.removeprefix("ridelab-drill_") for each in facts["NetworkSettings"]["Networks"]}
        assert networks == NETWORKS[part]
        ports = [each["HostIp"] for bound in (host["PortBindings"] or {}).values() for each in bound]
        assert ports == ["127.0.0.1"] * (2 if part == "proxy" else 0)
        read = docker("exec", name, "sh", "-c", "cd /run/secrets && for f in *; do cat $f >/dev/null && echo $f; done")
        mounted = {each["Destination"] for each in facts["Mounts"]}
        assert {f"/run/secrets/{each}" for each in read.split()} == {each for each in mounted if "secrets" in each}
        password = (service.folder / "secrets/database_password").read_text().strip()
        assert password not in json.dumps(facts) + docker("logs", name)


def test_networks_keep_inside_what_belongs_inside(service: Composed) -> None:
    for network in ("front", "back"):
        assert json.loads(docker("network", "inspect", f"ridelab-drill_{network}"))[0]["Internal"]
    knock = """
import socket, ssl
for secure in (False, True):
    try:
        with socket.create_connection(("scheduler", 8786), 3) as plain:
            dask = ssl._create_unverified_context().wrap_socket(plain) if secure else plain
            dask.settimeout(3)
            dask.sendall(bytes(16))
            print("answered" if dask.recv(10) else "closed")
    except OSError:
        print("closed")
"""
    name = service.one_of("api")
    assert docker("exec", name, "python", "-c", knock).split() == ["closed", "closed"], "Dask hears a certificate only"
    assert docker("exec", service.one_of("proxy"), "sh", "-c", "getent hosts database || echo none") == "none"
    for path in ("/metrics", "/%6detrics"):
        assert service.request("GET", path).status_code == 403


def test_the_services_role_is_no_superuser_and_pages_have_checksums(service: Composed) -> None:
    assert service.sql(
        "select rolsuper or rolcreatedb or rolcreaterole from pg_roles where rolname = current_user"
    ) == ["f"]
    assert service.sql("show data_checksums") == ["on"]
    by_network = service.compose(
        *("exec", "-T", "database", "psql", "-h", "database", "-U", "postgres", "-w", "-c", "select 1"), check=False
    )
    assert by_network == "", "the superuser has no password"


def test_it_answers_all_that_it_serves(service: Composed) -> None:
    for path in ("/", "/manual/", "/manual/examples.zip", "/docs", "/openapi.json", "/api/v1/strategies", "/readyz"):
        assert {each.request("GET", path).status_code for each in (service, service.secure)} == {200}, path
    run = service.run("lv", "lqr", "passive", "lv_hil")
    assert {each["status"] for each in run["strategies"].values()} == {"ok"}
    place = f"/api/v1/runs/{run['id']}"
    for form, begins in (("csv", b"time"), ("json", b"{")):
        series = service.request("GET", f"{place}/series?format={form}&strategy=passive")
        assert series.content.startswith(begins)
    reads = ("figures", "report.html", "instant?position=100&strategy=lv")
    for path in (*(f"{place}/{each}" for each in reads), "/api/v1/paper", "/api/v1/paper/report.html"):
        assert service.request("GET", path).status_code == 200, path
    road = (ROOT / "docs/roads/street.csv").read_bytes()
    sent = service.request("POST", "/api/v1/roads", content=road, headers={"Content-Type": "text/csv"})
    assert sent.is_success
    for path in ("/controller", "/controller/report", "/fmus"):
        begun = time.monotonic()
        body: dict[str, object] = {"scenario": {}} | ({"strategy": "lqr"} if path == "/fmus" else {})
        assert service.request("POST", f"/api/v1{path}", json=body).status_code == 200, path
        print(f"the first {path} took {time.monotonic() - begun:.2f} s")
    link = service.ask("POST", "/links", {"run_id": run["id"]})
    assert service.request("GET", link["url"]).status_code == 200
    batch = service.batch(2000)
    service.assert_complete(batch, 2000)
    events = service.request("GET", f"/api/v1/batches/{batch}/events").text  # a stream that ends with it
    assert '"done"' in [line for line in events.splitlines() if line.startswith("data:")][-1]


def test_controllers_of_ones_own_are_driven_by_api_and_workers(service: Composed) -> None:
    """A Python file, and an FMU, which is unpacked."""
    folder = service.folder / "controllers"
    shutil.copyfile(ROOT / "examples/controllers/pid.py", folder / "pid.py")
    exported = service.request("POST", "/api/v1/fmus", json={"scenario": {}, "strategy": "lqr", "of": "controller"})
    (folder / "theirs.fmu").write_bytes(exported.content)
    for file in folder.iterdir():
        file.chmod(0o644)
    own = {"deflection_pid", "theirs"}
    wait(lambda: own <= {each["id"] for each in service.ask("GET", "/strategies")}, "they are there", 30)
    run = service.run("lqr", *own)
    assert {each["status"] for each in run["strategies"].values()} == {"ok"}
    service.assert_complete(service.batch(20, *own), 40)
    assert docker("exec", service.one_of("worker"), "sh", "-c", "ls /fmu/*"), "it was unpacked there"
