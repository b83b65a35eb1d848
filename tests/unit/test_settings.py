"""Settings that are refused, and those that belong together: a database and its password, Dask and its certificates."""

import subprocess
import sys
from pathlib import Path

import pytest

from backend.settings import Settings, SettingsError
from tests.servers.process import ROOT
from tests.servers.programs import find

URL = "postgresql+psycopg://ridelab@database/ridelab"


@pytest.fixture
def files(tmp_path: Path) -> dict[str, str]:
    """The variables of TLS, with the certificates that the service's own script makes."""
    find("openssl", package="openssl")
    subprocess.run([ROOT / "backend/deploy/secrets.sh", tmp_path / "secrets"], check=True, capture_output=True)
    return {
        f"RIDELAB_DASK_TLS_{name}_FILE": f"{tmp_path}/secrets/dask_{name.lower()}.pem" for name in ("CA", "CERT", "KEY")
    }


def test_the_password_of_the_database_comes_from_a_file(tmp_path: Path) -> None:
    secret = tmp_path / "password"
    secret.write_text("s/e:c@r%t \n")
    settings = Settings.from_environment(
        {"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": str(secret), "PATH": "/bin"}
    )
    assert settings.store_url == "postgresql+psycopg://ridelab:s%2Fe%3Ac%40r%25t @database/ridelab"
    assert "s/e" not in repr(settings)
    secret.write_text("another")
    assert ":another@" in settings.store_url, "read again: secrets are changed under a running service's feet"


@pytest.mark.parametrize(
    ("variables", "named"),
    [
        ({"RIDELAB_DATABASE_PASSWORD_FILE": "/dev/null"}, "RIDELAB_DATABASE_URL"),
        ({"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": "/absent"}, "RIDELAB_DATABASE_PASSWORD_FILE"),
        ({"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": sys.executable}, "a file that cannot be read"),
        ({"RIDELAB_DATABASE_URL": "user:secret@host"}, "RIDELAB_DATABASE_URL"),
        ({"RIDELAB_DATABASE_URL": "postgresql://user:secret@host:port/d"}, "RIDELAB_DATABASE_URL is not"),
        ({"RIDELAB_DATABASE_URL": "mysql://user:secret@host/d"}, "RIDELAB_DATABASE_URL names neither"),
        ({"RIDELAB_DATABASE_URL": "sqlite://"}, "RIDELAB_DATABASE_URL names neither"),
        ({"RIDELAB_ALLOWED_HOSTS": "https://lab.example.com"}, "RIDELAB_ALLOWED_HOSTS"),
        ({"RIDELAB_ALLOWED_HOSTS": "lab.example.com:8000"}, "RIDELAB_ALLOWED_HOSTS"),
        ({"RIDELAB_DASK_SCHEDULER": "tls://scheduler:8786"}, "RIDELAB_DASK_TLS_KEY_FILE"),
        ({"RIDELAB_DASK_TLS_CA_FILE": "/dev/null"}, "RIDELAB_DASK_TLS_CERT_FILE"),
    ],
)
def test_settings_that_do_not_fit_together_are_named(variables: dict[str, str], named: str) -> None:
    with pytest.raises(SettingsError, match=named) as caught:
        Settings.from_environment(variables)
    assert "secret" not in str(caught.value)


@pytest.mark.parametrize("name", Settings.model_fields)
def test_nothing_is_no_value(name: str) -> None:
    variable = f"RIDELAB_{name.upper()}"
    if Settings.model_fields[name].default == "":
        assert Settings.from_environment({variable: ""}) == Settings()
        return
    with pytest.raises(SettingsError, match=f"^{variable}: it is empty; leave it out for the default$"):
        Settings.from_environment({variable: ""})


def test_an_unknown_setting_is_told_with_those_of_a_similar_name() -> None:
    said = "there is no such setting, perhaps RIDELAB_ALLOWED_HOSTS; docs/operations.md lists all$"
    with pytest.raises(SettingsError, match=said):
        Settings.from_environment({"RIDELAB_ALLOWED_HOST": "lab.example.com"})


def test_a_value_on_the_command_line_is_checked_as_well() -> None:
    with pytest.raises(SettingsError, match=r"^RIDELAB_DATA_DIR: it is empty"):
        Settings.from_environment({}, data_dir="")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("DASK_SCHEDULER", "nonsense"),
        ("DASK_SCHEDULER", "tcp://scheduler"),
        ("DASK_SCHEDULER", "tcp://scheduler:99999"),
        ("DASK_SCHEDULER", "http://scheduler:8786"),
        ("FORWARDED_ALLOW_IPS", "proxy.example.com"),
        ("FORWARDED_ALLOW_IPS", "10.0.0.1/8"),
        ("FORWARDED_ALLOW_IPS", "10.0.0.1,*"),
        ("FRONTEND_DIR", "/absent"),
        ("DATA_DIR", __file__),
        ("ECU_DIR", __file__),
    ],
)
def test_what_no_setting_can_be_is_one_sentence(name: str, value: str) -> None:
    with pytest.raises(SettingsError, match=f"^RIDELAB_{name}: ") as caught:
        Settings.from_environment({f"RIDELAB_{name}": value})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("DASK_SCHEDULER", "tcp://scheduler-1.example.com:8786"),
        ("DASK_SCHEDULER", "tcp://[::1]:8786"),
        ("FORWARDED_ALLOW_IPS", "*"),
        ("FORWARDED_ALLOW_IPS", "127.0.0.1, 10.0.0.0/8,::1"),
    ],
)
def test_addresses_of_every_kind_are_taken(name: str, value: str) -> None:
    assert getattr(Settings.from_environment({f"RIDELAB_{name}": value}), name.lower()) == value


def test_tls_takes_three_readable_files_and_an_address_that_says_so(files: dict[str, str]) -> None:
    scheduler = {"RIDELAB_DASK_SCHEDULER": "tls://scheduler:8786"}
    assert Settings.from_environment(scheduler | files).dask_tls_ca_file == Path(files["RIDELAB_DASK_TLS_CA_FILE"])
    for name in files:
        with pytest.raises(SettingsError, match=f"{name} not set"):
            Settings.from_environment(scheduler | {key: value for key, value in files.items() if key != name})
        with pytest.raises(SettingsError, match=f"{name} names a file that cannot be read"):
            Settings.from_environment(scheduler | files | {name: "/absent.pem"})
        with pytest.raises(SettingsError, match="in PEM that belong together"):
            Settings.from_environment(scheduler | files | {name: __file__})
    with pytest.raises(SettingsError, match="RIDELAB_DASK_SCHEDULER has to start with tls://"):
        Settings.from_environment({"RIDELAB_DASK_SCHEDULER": "tcp://scheduler:8786"} | files)
