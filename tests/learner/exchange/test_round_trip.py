"""Export and import: the same run in another store, bit for bit."""

import json
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from tests.learner.exchange.kit import done, refused, trained, trained_with_pictures
from tests.learner.kit import history

from waypost_learner.remote.embedded import embedded, stored_runs
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.db.engine import Database
from waypost_server.settings import Settings
from waypost_server.users import service as users

Trained = tuple[Path, dict[str, Any]]


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Trained:
    """A store with a finished run of hg-DAgger, and the run's summary."""
    folder = tmp_path_factory.mktemp("original")
    return folder / "waypost.db", trained(folder)


def data_files(folder: Path) -> dict[str, bytes]:
    """The files of an export without its card, which names the command."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name != "README.md"}


@pytest.mark.parametrize("form", ["jsonl", "parquet"])
@pytest.mark.parametrize("names", [[], ["--names"]], ids=["pseudonyms", "names"])
def test_an_imported_run_is_exported_as_the_same_bytes(
    original: Trained, tmp_path: Path, form: str, names: list[str]
) -> None:
    source, summary = original
    run, copy = summary["run"], tmp_path / "copy.db"
    done("export", run, "--store", source, "--format", form, "--out", tmp_path / "once", *names)
    done("import", tmp_path / "once", "--store", copy)
    done("export", run, "--store", copy, "--format", form, "--out", tmp_path / "twice", *names)
    assert data_files(tmp_path / "once") == data_files(tmp_path / "twice")
    assert all(data_files(tmp_path / "once").values())


@pytest.mark.parametrize("form", ["jsonl", "parquet"])
def test_an_imported_run_has_the_same_curves_costs_and_answers(original: Trained, tmp_path: Path, form: str) -> None:
    source, summary = original
    run, copy = summary["run"], tmp_path / "copy.db"
    done("export", run, "--store", source, "--format", form, "--out", tmp_path / "data")
    done("import", tmp_path / "data", "--store", copy)
    with embedded(source) as here, embedded(copy) as there:
        for found in ("run", "curves", "costs"):
            assert getattr(here.learner, found)(run) == getattr(there.learner, found)(run)
        assert history(here.learner, run) == history(there.learner, run)
    assert summary["cost"]["total"] > 0


def test_reading_a_store_for_an_export_leaves_it_as_it_was(original: Trained, tmp_path: Path) -> None:
    def dump() -> list[str]:
        with closing(sqlite3.connect(original[0])) as store:
            return list(store.iterdump())

    before = dump()
    done("export", original[1]["run"], "--store", original[0], "--out", tmp_path / "data")
    assert dump() == before


def test_a_server_exports_the_same_bytes_as_its_store(original: Trained, tmp_path: Path, start_server) -> None:  # type: ignore[no-untyped-def]
    source, summary = original
    db = Database(f"sqlite:///{source}")
    viewer = db.write_now(lambda tx: users.ensure_user(tx, "vic", "viewer"))
    token = db.write_now(lambda tx: tokens.create_token(tx, viewer.id, "test")).token
    db.close()
    served: serving.Served = start_server(Settings(database=f"sqlite:///{source}"))
    done("export", summary["run"], "--server", served.url, "--token", token, "--out", tmp_path / "served")
    done("export", summary["run"], "--store", source, "--out", tmp_path / "stored")
    assert data_files(tmp_path / "served") == data_files(tmp_path / "stored")


def test_pictures_travel_along(tmp_path: Path) -> None:
    run = trained_with_pictures(tmp_path, episodes=6)["run"]
    done("export", run, "--store", tmp_path / "waypost.db", "--out", tmp_path / "once")
    lines = [json.loads(line) for line in (tmp_path / "once" / "run.jsonl").read_text().splitlines()]
    frames = [line["frame"]["hash"] for line in lines if line["record"] == "frame"]
    assert len(frames) == len(set(frames)) > 0
    done("import", tmp_path / "once", "--store", tmp_path / "copy.db")
    done("export", run, "--store", tmp_path / "copy.db", "--out", tmp_path / "twice")
    assert data_files(tmp_path / "once") == data_files(tmp_path / "twice")


# --- privacy, cards, refusals


def test_names_stay_out_of_an_export_unless_asked_for(original: Trained, tmp_path: Path) -> None:
    source, summary = original
    run = summary["run"]
    done("export", run, "--store", source, "--out", tmp_path / "shared")
    done("export", run, "--store", source, "--out", tmp_path / "own", "--names")
    shared = [json.loads(line) for line in (tmp_path / "shared" / "run.jsonl").read_text().splitlines()]
    assert {one["answered"]["annotator"] for one in shared if one["record"] == "query"} == {f"annotator-{run}-1"}
    assert '"annotator":"oracle"' in (tmp_path / "own" / "run.jsonl").read_text()
    assert "oracle" not in (tmp_path / "shared" / "README.md").read_text()


def test_the_card_has_the_runs_costs(original: Trained, tmp_path: Path) -> None:
    source, summary = original
    found = json.loads(done("export", summary["run"], "--store", source, "--out", tmp_path / "data", "--json"))
    card = (tmp_path / "data" / "README.md").read_text()
    assert found["units"] == summary["cost"]["total"]
    for kind, units in summary["cost"]["by_kind"].items():
        if units:
            assert f"| {kind} | " in card
            assert f" | {units:g} | " in card
    assert '"preset": "tiny"' in card
    assert "Not stated. The owner of the data decides" in card


def test_a_folder_that_exists_is_never_overwritten(original: Trained, tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    sentence = refused("export", original[1]["run"], "--store", original[0], "--out", tmp_path / "data")
    assert sentence.endswith("data exists; give --out a folder that does not exist.")
    assert list((tmp_path / "data").iterdir()) == []


def test_an_export_that_fails_leaves_no_folder(original: Trained, tmp_path: Path) -> None:
    assert "There is no run 'none'" in refused("export", "none", "--store", original[0], "--out", tmp_path / "data")
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_export_is_refused_with_its_place_and_makes_no_run(original: Trained, tmp_path: Path) -> None:
    done("export", original[1]["run"], "--store", original[0], "--out", tmp_path / "data")
    file = tmp_path / "data" / "run.jsonl"
    lines = file.read_text().splitlines()
    file.write_text("\n".join([*lines[:3], lines[3][:-20], *lines[4:]]))
    assert "run.jsonl, line 4: " in refused("import", tmp_path / "data", "--store", tmp_path / "copy.db")
    file.write_text("\n".join(lines[:-1]))
    assert "is the file complete?" in refused("import", tmp_path / "data", "--store", tmp_path / "copy.db")
    with stored_runs(tmp_path / "copy.db") as copy:
        assert copy.runs() == []


def test_an_import_is_refused_the_second_time(original: Trained, tmp_path: Path) -> None:
    done("export", original[1]["run"], "--store", original[0], "--out", tmp_path / "data")
    done("import", tmp_path / "data", "--store", tmp_path / "copy.db")
    sentence = refused("import", tmp_path / "data", "--store", tmp_path / "copy.db")
    assert sentence == (
        f"The store already has run {original[1]['run']}; import it into another store, or keep this one."
    )


def test_a_path_without_an_export_creates_no_store(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    assert "has no run.jsonl and no run.json" in refused("import", tmp_path / "empty", "--store", tmp_path / "copy.db")
    assert "there is no export" in refused("import", tmp_path / "none", "--store", tmp_path / "copy.db").lower()
    assert not (tmp_path / "copy.db").exists()


def test_a_source_and_a_target_are_needed(tmp_path: Path) -> None:
    assert "either --store FILE or --server URL" in refused("export", "x", "--out", tmp_path / "data")
    assert "either --store FILE or --database URL" in refused("import", tmp_path)
