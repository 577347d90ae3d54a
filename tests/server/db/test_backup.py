"""Backups: whole and of one moment, also while a server writes; a backup that was broken off leaves no file."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from tests.server.kit import Service, in_process, make_older_store, query, schema_of, together
from typer.testing import CliRunner

from waypost_server.cli.main import app
from waypost_server.db.migration import migrate
from waypost_server.db.schema import newest


def run(*arguments: str, status: int = 0) -> str:
    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == status, done.output
    return done.output.strip()


@pytest.fixture
def elsewhere(empty_url: str, tmp_path: Path, request: pytest.FixtureRequest) -> str:
    """The URL of a store to restore to: a new file, or an empty database."""
    if empty_url.startswith("sqlite"):
        return f"sqlite:///{tmp_path / 'restored.db'}"
    return str(request.getfixturevalue("cluster").create_empty())


def answer_all(service: Service, stop: threading.Event) -> None:
    run = service.learner.create_run()
    for ordinal in range(10_000):
        service.learner.ask(run, query(ordinal=ordinal))
        service.annotator.answer(service.annotator.lease())
        if stop.is_set():
            return


def test_what_is_backed_up_while_a_server_writes_is_restored_whole(
    empty_url: str, elsewhere: str, tmp_path: Path
) -> None:
    stop = threading.Event()
    with in_process(empty_url) as service:
        writing = threading.Thread(target=answer_all, args=[service, stop])
        writing.start()
        time.sleep(0.5)
        *_, log = json.loads(run("check", "--json", "--database", empty_url))
        for number in range(3):
            assert "Backed up" in run("backup", str(tmp_path / f"{number}"), "--database", empty_url)
        stop.set()
        writing.join()
        spent = service.viewer.get("/runs")["runs"][0]["spent"]
    run("restore", str(tmp_path / "2"), "--database", elsewhere)
    assert "WRONG" not in run("check", "--audit-head", log["head"], "--database", elsewhere)
    with in_process(elsewhere) as restored:
        assert 0 < restored.viewer.get("/runs")["runs"][0]["spent"] <= spent


def test_a_backup_replaces_nothing(empty_url: str, tmp_path: Path) -> None:
    with in_process(empty_url):
        pass
    (tmp_path / "mine").write_text("precious")
    assert "exists" in run("backup", str(tmp_path / "mine"), "--database", empty_url, status=2)
    assert (tmp_path / "mine").read_text() == "precious"
    assert [one.name for one in tmp_path.iterdir() if one.name.startswith(".mine")] == []


def test_nothing_is_restored_over_a_store(empty_url: str, tmp_path: Path) -> None:
    with in_process(empty_url) as service:
        service.learner.create_run(name="kept")
        run("backup", str(tmp_path / "backup"), "--database", empty_url)
        said = run("restore", str(tmp_path / "backup"), "--database", empty_url, status=2)
        assert "exists" in said
        assert service.viewer.get("/runs")["runs"][0]["name"] == "kept"
    assert "WRONG" not in run("check", "--database", empty_url)


@pytest.mark.parametrize("content", [b"", b"not a store", b"SQLite format 3\x00" + bytes(4_000)])
def test_a_file_that_is_no_backup_is_refused(sqlite_url: str, tmp_path: Path, content: bytes) -> None:
    (tmp_path / "file").write_bytes(content)
    assert "not a sound backup" in run("restore", str(tmp_path / "file"), "--database", sqlite_url, status=2)
    assert not Path(sqlite_url.removeprefix("sqlite:///")).exists()


@pytest.mark.parametrize(
    ("change", "fact"),
    [
        ("UPDATE runs SET spent = 1", "What a run has spent is what the ledger says."),
        ("UPDATE runs SET gold_rate = 7", "The file is sound."),
    ],
)
def test_a_backup_with_a_fault_is_restored_only_if_one_insists(
    sqlite_url: str, tmp_path: Path, change: str, fact: str
) -> None:
    with in_process(sqlite_url) as service:
        service.learner.create_run()
    backup, elsewhere = tmp_path / "backup", f"sqlite:///{tmp_path / 'restored.db'}"
    run("backup", str(backup), "--database", sqlite_url)
    with closing(sqlite3.connect(backup)) as store:
        store.execute("PRAGMA ignore_check_constraints = ON")
        store.execute(change)
        store.commit()
    assert fact in run("restore", str(backup), "--database", elsewhere, status=2)
    assert sorted(one.name for one in tmp_path.iterdir() if "restored" in one.name) == []
    assert fact in run("restore", str(backup), "--database", elsewhere, "--anyway", status=1)
    assert f"WRONG {fact}" in run("check", "--database", elsewhere, status=1)


def test_a_backup_of_an_older_store_is_restored_and_can_be_migrated(
    empty_url: str, elsewhere: str, tmp_path: Path
) -> None:
    make_older_store(empty_url)
    run("backup", str(tmp_path / "backup"), "--database", empty_url)
    assert "`waypost migrate`" in run("restore", str(tmp_path / "backup"), "--database", elsewhere)
    run("migrate", "--no-backup", "--database", elsewhere)
    assert "WRONG" not in run("check", "--database", elsewhere)


def test_what_does_not_exist_is_neither_backed_up_nor_restored(sqlite_url: str, tmp_path: Path) -> None:
    assert "no store" in run("backup", str(tmp_path / "backup"), "--database", sqlite_url, status=2)
    assert "no file" in run("restore", str(tmp_path / "nothing"), "--database", sqlite_url, status=2)
    assert list(tmp_path.iterdir()) == []


def test_a_backup_that_is_killed_leaves_no_file_of_its_name(sqlite_url: str, tmp_path: Path) -> None:
    with in_process(sqlite_url) as service:
        run_id = service.learner.create_run()
        service.learner.ask(run_id, *(query(ordinal=n, instance={"lava": ["x" * 1_000] * 20}) for n in range(200)))
    program = "import sqlite3, time; from waypost_server.db import backup; import pathlib, sys; "
    slow = "backup._to_disk = lambda _: (print('written', flush=True), time.sleep(60)); "
    call = "backup.back_up(sys.argv[1], pathlib.Path(sys.argv[2]))"
    command: list[Any] = [sys.executable, "-c", program + slow + call, sqlite_url, tmp_path / "backup"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "written\n"
        os.kill(process.pid, signal.SIGKILL)
    assert not (tmp_path / "backup").exists()
    run("backup", str(tmp_path / "backup"), "--database", sqlite_url)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder: an empty one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def copies(folder: Path) -> list[Path]:
    return list(folder.glob("*.before-*"))


def test_an_older_store_is_backed_up_before_it_is_migrated(empty_url: str, elsewhere: str, here: Path) -> None:
    make_older_store(empty_url)
    said = run("migrate", "--database", empty_url)
    (copy,) = copies(here)
    assert copy.name in said
    run("restore", str(copy), "--database", elsewhere)
    assert (schema_of(elsewhere), schema_of(empty_url)) == ("0006", newest())
    run("migrate", "--database", empty_url)
    assert len(copies(here)) == 1, "a store of this version needs no copy"


def test_those_who_migrate_at_once_make_one_backup(empty_url: str, here: Path) -> None:
    make_older_store(empty_url)
    done = together(lambda _: migrate(empty_url), 4)
    assert sorted(one.migrated.before for one in done) == ["0006", newest(), newest(), newest()]
    assert [one.backup.name for one in done if one.backup] == [one.name for one in copies(here)]


def test_a_store_that_cannot_be_backed_up_is_not_migrated(
    empty_url: str, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_older_store(empty_url)
    with monkeypatch.context() as patched:
        patched.setattr("waypost_server.db.backup.shutil.which", lambda _: None)
        patched.setattr("waypost_server.db.backup.os.link", unwritable)
        assert "Nothing was migrated" in run("migrate", "--database", empty_url, status=2)
    assert schema_of(empty_url) == "0006"
    run("migrate", "--no-backup", "--database", empty_url)
    assert (schema_of(empty_url), copies(here)) == (newest(), [])


def unwritable(*_: object) -> None:
    raise OSError("No space left on device")
