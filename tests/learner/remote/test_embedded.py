"""The server's app in this process, and stores that are read without it."""

from pathlib import Path

import pytest
from tests.learner.kit import corridor, store
from tests.server.kit import make_older_store, schema_of

from waypost_learner.remote.embedded import embedded, stored_runs
from waypost_learner.runs.training import train


def test_a_store_is_read_as_the_server_would_return_it(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        run = train(corridor(algorithm="h-bc", episodes=2), connection, options)["run"]
        runs, curves = connection.learner.runs(), connection.learner.curves(run)
    with stored_runs(tmp_path / "waypost.db") as found:
        assert [one.id for one in found.runs()] == [one.id for one in runs] == [run]
        assert found.curves(run) == curves


def test_a_store_that_is_not_there_is_not_created_by_reading_it(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"there is no store .*none\.db"), stored_runs(tmp_path / "none.db"):
        pass
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("opened", [embedded, stored_runs])
def test_a_file_that_is_no_store_is_refused_in_the_servers_words(tmp_path: Path, opened) -> None:  # type: ignore[no-untyped-def]
    file = tmp_path / "notes.db"
    file.write_text("no database, but long enough to be looked at as one " * 20)
    with pytest.raises(ValueError, match=r"^Cannot open sqlite:///.*notes\.db"), opened(file):
        pass


@pytest.mark.parametrize("opened", [embedded, stored_runs])
def test_a_store_of_an_older_version_is_not_changed_without_being_asked(tmp_path: Path, opened) -> None:  # type: ignore[no-untyped-def]
    url = f"sqlite:///{tmp_path / 'old.db'}"
    make_older_store(url)
    with (
        pytest.raises(ValueError, match=r"run `waypost migrate --database sqlite:///.*old\.db`"),
        opened(tmp_path / "old.db"),
    ):
        pass
    assert schema_of(url) == "0006"
