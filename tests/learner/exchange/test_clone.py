"""`waypost clone`: what is learned from given labels is what the run that collected them learned."""

import json
from pathlib import Path
from typing import Any

import pytest
from tests.learner.exchange.kit import done, refused, trained

from waypost_learner.remote.embedded import stored_runs

CLONE = ("--preset", "tiny", "--seed", "1", "--threads", "1", "--json")


def cloned(*arguments: str | Path) -> dict[str, Any]:
    """Clone, and return the result."""
    return dict(json.loads(done("clone", *arguments, *CLONE)))


@pytest.mark.parametrize("form", ["jsonl", "parquet"])
@pytest.mark.parametrize("algorithm", ["h-bc", "flat-bc"])
def test_demonstrations_give_the_weights_of_the_run_from_store_export_and_import(
    algorithm: str, form: str, tmp_path: Path
) -> None:
    run = trained(tmp_path, algorithm=algorithm, episodes=5)
    chosen = ("--algorithm", algorithm, "--checkpoints", tmp_path / "weights")
    done("export", run["run"], "--store", tmp_path / "waypost.db", "--format", form, "--out", tmp_path / "data")
    done("import", tmp_path / "data", "--store", tmp_path / "copy.db")
    stored = cloned(run["run"], "--store", tmp_path / "waypost.db", *chosen)
    imported = cloned(run["run"], "--store", tmp_path / "copy.db", *chosen)
    exported = cloned(tmp_path / "data", *chosen)
    assert run["weights"] == stored["weights"] == imported["weights"] == exported["weights"]
    assert (stored["episodes"], stored["run"], stored["success_rate"]) == (5, run["run"], run["success_rate"])


@pytest.mark.parametrize(("algorithm", "episodes"), [("hg-dagger", 8), ("hg-takeover", 24)])
def test_labels_of_an_interactive_run_give_its_weights_too(tmp_path: Path, algorithm: str, episodes: int) -> None:
    """With redrawn instances and the lean preset, so that every instance must be found again and relabeled."""
    run = trained(tmp_path, algorithm=algorithm, preset="tiny-lean", redraw=True, episodes=episodes)
    if algorithm == "hg-takeover":
        with stored_runs(tmp_path / "waypost.db") as source:
            records: Any = source.records(run["run"], "queries").records
        assert any(one.ask.kind == "hier_demo" and one.ask.context for one in records), "nobody took over"
    arguments = (run["run"], "--store", tmp_path / "waypost.db", "--checkpoints", tmp_path / "weights")
    found = done("clone", *arguments, "--preset", "tiny-lean", "--seed", "1", "--threads", "1", "--json")
    assert json.loads(found)["weights"] == run["weights"]


def test_labels_toward_wrong_subgoals_are_told_apart_as_in_the_run(tmp_path: Path) -> None:
    """`general` learns which subgoals are right from labels of actions, too: from those toward right ones."""
    values = " ".join(f"train_shared.{rows}=128" for rows in ("least", "most", "idle"))
    chosen = ("--preset", "general", "--values", values, "--seed", "1", "--threads", "1", "--json")
    store = ("--store", tmp_path / "waypost.db")
    run = json.loads(done("train", "naive-h-dagger", "--warm-start", "1", "--episodes", "3", *chosen, *store))
    assert json.loads(done("clone", run["run"], *chosen, *store))["weights"] == run["weights"]


def test_another_seed_and_fewer_episodes_learn_something_else_from_the_same_labels(tmp_path: Path) -> None:
    run = trained(tmp_path, algorithm="h-bc", episodes=4)
    store = ("--store", tmp_path / "waypost.db", "--preset", "tiny", "--threads", "1", "--json")
    first, fewer, other = (
        json.loads(done("clone", run["run"], *store, *more))
        for more in (("--seed", "1"), ("--seed", "1", "--episodes", "2"), ("--seed", "2"))
    )
    assert len({first["weights"], fewer["weights"], other["weights"]}) == 3
    assert first["labels"] == other["labels"] > fewer["labels"] > 0


def test_a_clone_is_evaluated_like_a_run(tmp_path: Path) -> None:
    run = trained(tmp_path, algorithm="h-bc", episodes=2)["run"]
    store = ("--store", tmp_path / "waypost.db")
    found = cloned(run, *store)
    evaluated = json.loads(done("evaluate", found["checkpoint"], *store, "--json"))
    assert evaluated["episodes"] == 52


def test_what_cannot_be_learned_from_is_refused(tmp_path: Path) -> None:
    run = trained(tmp_path, algorithm="flat-bc", episodes=2)["run"]
    store = ("--store", tmp_path / "waypost.db", "--preset", "tiny")
    assert "has no labels that h-bc can learn from" in refused("clone", run, *store)
    assert "choose one of: h-bc, flat-bc" in refused("clone", run, *store, "--algorithm", "hg-dagger")
    assert "There is no export" in refused("clone", tmp_path / "none")


def test_data_of_a_domain_that_has_changed_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from waypost_learner.domains import corridor

    run = trained(tmp_path, algorithm="hg-dagger", episodes=6)["run"]
    store = ("--store", tmp_path / "waypost.db", "--preset", "tiny")
    monkeypatch.setattr(corridor, "moved", lambda cell, _: cell)
    assert "its actions lead to other states; has the domain 'corridor' changed?" in refused("clone", run, *store)
    monkeypatch.setattr(corridor, "CELLS", 14)
    assert "its instance cannot be drawn again" in refused("clone", run, *store)
