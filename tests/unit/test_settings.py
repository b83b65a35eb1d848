"""Settings that are refused, with a sentence that names the variable, and those that belong together."""

import sys
from pathlib import Path

import pytest

from backend.command_error import CommandError
from backend.settings import Settings, removed_in
from tests import wording
from tests.servers.programs import make_secrets

URL = "postgresql+psycopg://ridelab@database/ridelab"


def test_settings_come_from_the_environment_and_the_command_line_wins(tmp_path: Path) -> None:
    environment = {"RIDELAB_WORKERS": "3", "RIDELAB_DATA_DIR": "/elsewhere", "PATH": "/bin"}
    settings = Settings.from_environment(environment, data_dir=tmp_path, database_url=None)
    assert (settings.workers, settings.data_dir) == (3, tmp_path)
    assert settings.store_url == f"sqlite:///{tmp_path}/ridelab.sqlite"
    of_the_command_line = {"RIDELAB_SERVER": "http://h", "RIDELAB_TOKEN": "t"}
    assert Settings.from_environment(of_the_command_line) == Settings()


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


@pytest.mark.parametrize("scheme", ["postgres", "postgresql", "postgresql+psycopg"])
def test_where_the_data_are_is_the_database_without_its_password(scheme: str, tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, database_url=f"{scheme}://ridelab:secret@database/ridelab")
    assert settings.store_url == "postgresql+psycopg://ridelab:secret@database/ridelab"
    assert settings.shown_store == "postgresql+psycopg://ridelab:***@database/ridelab"
    assert Settings(data_dir=tmp_path).shown_store == str(tmp_path)


@pytest.mark.parametrize("setting", wording.asked_in("settings"))
def test_what_no_setting_can_be_is_one_sentence(setting: str) -> None:
    with pytest.raises(CommandError) as caught:
        Settings.from_environment(dict([setting.split("=", 1)]))
    assert "secret" not in str(caught.value)
    assert "\n" not in str(caught.value)
    wording.check("settings", setting, str(caught.value))


def test_a_setting_of_an_earlier_release_is_named_and_has_no_effect() -> None:
    environment = {"RIDELAB_BODY_TIMEOUT": "5", "RIDELAB_HEAD_TIMEOUT": "", "RIDELAB_WORKERS": "2"}
    assert Settings.from_environment(environment) == Settings(workers=2)
    said = removed_in(environment)
    assert said is not None
    assert said.startswith("RIDELAB_BODY_TIMEOUT, RIDELAB_HEAD_TIMEOUT have no effect")
    assert removed_in({"RIDELAB_WORKERS": "2"}) is None


def test_there_are_no_more_settings_than_an_operator_reads() -> None:
    assert len(Settings.model_fields) <= 25


def test_nothing_is_no_value_but_where_it_is_the_default() -> None:
    for name, field in Settings.model_fields.items():
        if field.default == "":
            assert Settings.from_environment({f"RIDELAB_{name.upper()}": ""}) == Settings()
            continue
        for variables, overrides in (({f"RIDELAB_{name.upper()}": ""}, {}), ({}, {name: ""})):
            with pytest.raises(CommandError, match=f"^RIDELAB_{name.upper()}: it is empty"):
                Settings.from_environment(variables, **overrides)


@pytest.mark.parametrize("password", ["/absent", sys.executable])
def test_a_password_that_cannot_be_read_ends_the_start(password: str) -> None:
    with pytest.raises(CommandError, match="RIDELAB_DATABASE_PASSWORD_FILE names a file that cannot be read"):
        Settings.from_environment({"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": password})


def test_tls_takes_three_readable_files_and_an_address_that_says_so(tmp_path: Path) -> None:
    make_secrets(tmp_path / "secrets")
    names = {name: f"RIDELAB_DASK_TLS_{name.upper()}_FILE" for name in ("ca", "cert", "key")}
    files = {variable: f"{tmp_path}/secrets/dask_{name}.pem" for name, variable in names.items()}
    scheduler = {"RIDELAB_DASK_SCHEDULER": "tls://scheduler:8786"}
    assert Settings.from_environment(scheduler | files).dask_tls_ca_file == Path(files[names["ca"]])
    for name in files:
        for wrong, said in (
            ({key: value for key, value in files.items() if key != name}, f"{name} not set"),
            (files | {name: "/absent.pem"}, f"{name} names a file that cannot be read"),
            (files | {name: __file__}, "in PEM that belong together"),
        ):
            with pytest.raises(CommandError, match=said):
                Settings.from_environment(scheduler | wrong)
    with pytest.raises(CommandError, match="RIDELAB_DASK_SCHEDULER has to start with tls://"):
        Settings.from_environment({"RIDELAB_DASK_SCHEDULER": "tcp://scheduler:8786"} | files)
