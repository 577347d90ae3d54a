"""`waypost figures`: what is drawn is what was measured, and whoever has the CSV can draw it again."""

import gzip
import json
import re
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import Result
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from tests.learner.experiments.figures_kit import run_of
from tests.learner.kit import corridor, examples, store
from tests.repository.kit import complaint, invocations
from typer.testing import CliRunner

from waypost import wire
from waypost.client import Client
from waypost_learner.cli import app
from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import archive, draw, look, make, measures, tables
from waypost_learner.experiments.figures.data import KINDS, Comparison, RunCurves
from waypost_learner.experiments.figures.published import NEVER
from waypost_learner.experiments.figures.statistics import Spread
from waypost_learner.experiments.figures.store import read
from waypost_learner.experiments.plan.series import Group, Series
from waypost_learner.remote.embedded import stored_runs
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.training import train
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

EPISODES = 6
TINY = Group(
    "tiny",
    "corridors, to try the figures",
    "Episodes: every rollout.",
    ("success-by-episode", "success-by-cost", "success-by-lo-cost", "cost-by-kind", "lo-cost-by-episode"),
    (
        Series(corridor(episodes=EPISODES), "hg-DAgger"),
        Series(corridor(algorithm="h-bc", episodes=EPISODES), "h-BC"),
    ),
)
TWO_SEEDS = ("--figure", "tiny", "--seeds", "1,2")


@pytest.fixture(scope="module", autouse=True)
def a_small_plan() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(plan.GROUPS, "tiny", TINY)
        patch.setitem(plan.FIGURES, "tiny", ("tiny",))
        yield


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("WAYPOST_TOKEN", raising=False)


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store with every run of the small plan."""
    folder = tmp_path_factory.mktemp("trained")
    with store(folder) as (connection, options):
        for config in plan.runs_of([TINY], (1, 2)):
            train(config, connection, options)
    return folder / "waypost.db"


@pytest.fixture(scope="module")
def expected(trained: Path) -> dict[str, bytes]:
    """The files that are drawn from that store."""
    drawn("--store", trained, *TWO_SEEDS, "--out", trained.parent / "figures")
    return contents(trained.parent / "figures")


def begin(client: Client, config: TrainConfig, episodes: int, hi_labels: int = 1) -> None:
    """Begin a run and report its first episodes."""
    values = {key: value for key, value in vars(config).items() if value is not None}
    vocabulary = client.runs()[0].vocabulary
    wanted = wire.RunCreate(name="r", algorithm=config.algorithm, seed=0, vocabulary=vocabulary, config=values)
    result = {"warm_start": True, "train_success": None, "test_success": False, "train_steps": 0, "test_steps": 1}
    result |= {"hi_labels": hi_labels, "lo_labels": 1, "seconds": 1.0}
    results = [wire.EpisodeResult.model_validate({"episode": n} | result) for n in range(episodes)]
    client.report(client.create_run(wanted).id, results)


def waypost(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, ["figures", *map(str, arguments)])


def drawn(*arguments: str | Path) -> dict[str, Any]:
    result = waypost(*arguments, "--json")
    assert result.exit_code == 0, result.output + repr(result.exception)
    return dict(json.loads(result.stdout))


def refused(*arguments: str | Path) -> str:
    result = waypost(*arguments)
    assert result.exit_code == 2, result.output + repr(result.exception)
    assert result.stdout == ""
    return result.stderr


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


# --- from the store to the figures and back


def test_figures_from_a_store_are_the_figures_from_its_csv_byte_by_byte(expected: dict[str, bytes]) -> None:
    Path("first").mkdir()
    Path("first", archive.FILE).write_bytes(expected[archive.FILE])
    done = drawn("--from", "first", *TWO_SEEDS, "--out", "again")
    assert (done["runs"], done["missing"]) == (4, [])
    assert contents(Path("again")) == expected


def test_every_figure_of_a_group_is_written_as_svg_and_png(trained: Path, expected: dict[str, bytes]) -> None:
    figures = {f"tiny-{name}.{form}" for name in TINY.figures for form in ("svg", "png")}
    assert expected.keys() == {*figures, archive.FILE, tables.FILE}
    for name in figures:
        assert len(expected[name]) > 5_000
        if name.endswith("svg"):
            assert ElementTree.fromstring(expected[name]).tag.endswith("svg")
        else:
            with Image.open(BytesIO(expected[name])) as image:
                assert image.width >= 800
                assert len(image.convert("RGB").getcolors(100_000)) > 10  # something is on it


def test_runs_of_several_machines_are_merged(trained: Path, expected: dict[str, bytes]) -> None:
    runs = archive.read(trained.parent / "figures")
    for name, seed in (("one", 1), ("other", 2)):
        Path(name).mkdir()
        archive.write(Path(name), [run for run in runs.values() if run.config.seed == seed])
        assert "seed 2" in refused("--from", "one", *TWO_SEEDS)
    drawn("--from", "other", "--from", "one", *TWO_SEEDS, "--out", "merged")
    assert contents(Path("merged")) == expected


def test_a_server_gives_the_same_figures_as_its_store(
    trained: Path, expected: dict[str, bytes], start_server: Callable[[Settings], serving.Served]
) -> None:
    shutil.copy(trained, "served.db")
    served = start_server(Settings(database="sqlite:///served.db"))
    viewer = served.db.write_now(lambda tx: users.ensure_user(tx, "ann", "viewer"))
    token = served.db.write_now(lambda tx: tokens.create_token(tx, viewer.id, "test")).token
    drawn("--server", served.url, "--token", token, *TWO_SEEDS, "--out", "server")
    assert contents(Path("server")) == expected


def test_drawing_changes_nothing_in_the_store(trained: Path) -> None:
    def rows() -> list[str]:
        with sqlite3.connect(trained) as file:
            dump = list(file.iterdump())
        file.close()
        return dump

    before = rows()
    drawn("--store", trained, *TWO_SEEDS, "--out", "figures")
    assert rows() == before


def test_figures_are_drawn_without_pytorch() -> None:
    drawing = "import sys, waypost_learner.experiments.figures.make"
    code = f"{drawing}; print({{'torch', 'waypost_learner.algorithms'}} & set(sys.modules))"
    root = Path(make.__file__).parents[3]
    done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_of_a_run_that_two_sources_have_the_one_that_got_further_counts() -> None:
    config = corridor(episodes=3)
    short, whole, other = run_of(config, [True]), run_of(config, [False] * 3), run_of(config, [True] * 3)
    assert make.merge([{config: short}, {config: whole}])[config] is whole
    assert make.merge([{config: whole}, {config: short}])[config] is whole
    assert make.merge([{config: whole}, {config: other}])[config] is whole


def test_of_several_runs_of_one_configuration_the_newest_of_those_that_got_furthest_is_drawn(trained: Path) -> None:
    shutil.copy(trained, "waypost.db")
    config = corridor(seed=9, episodes=20)
    with store(Path.cwd()) as (connection, _):
        for episodes, hi_labels in ((3, 1), (5, 2), (5, 3), (4, 4)):
            begin(connection.learner, config, episodes, hi_labels)
    with stored_runs(Path("waypost.db")) as source:
        found = read(source, [config])
    assert list(found[config].hi_labels) == [3] * 5


amounts = st.one_of(st.integers(0, 10**9).map(float), st.floats(0, 1e9, allow_subnormal=False))


@examples
@given(st.lists(st.tuples(*[amounts] * 6, st.sampled_from([True, False, None])), min_size=1, max_size=8), st.booleans())
def test_a_run_comes_back_from_the_csv_as_it_was(rows: list[tuple[Any, ...]], redraw: bool) -> None:
    *costs, tests = zip(*rows, strict=True)
    config = corridor(redraw=redraw, head_start=0.5, instances='odd, "name"', values="relabeling=false warm_start=1")
    run = run_of(config, tests, **dict(zip(KINDS, costs, strict=True)), lo_cost=costs[0])
    folder = Path("csv")
    folder.mkdir(exist_ok=True)
    first = archive.write(folder, [run]).read_bytes()
    (found,) = archive.read(folder).values()
    assert found.config == config
    for name in archive.COLUMNS[len(archive._CONFIG) : -len(KINDS)]:
        np.testing.assert_array_equal(getattr(found, name), getattr(run, name))
    for kind in KINDS:
        np.testing.assert_array_equal(found.units[kind], run.units[kind])
    assert archive.write(folder, [found]).read_bytes() == first


def room(seed: int, reached: float) -> RunCurves:
    """A run in Montezuma's Revenge, whose attempts reached the stair more and more often and the key never."""
    n = 4
    config = replace(plan.GROUPS["montezuma-hybrid"].series[0].config, seed=seed, episodes=n)
    learned = {"stair": np.linspace(0, reached, n), "key": np.zeros(n)}
    return replace(run_of(config, [False] * n), reward=np.arange(n, dtype=float), reached=learned)


def test_a_run_that_never_got_a_reward_has_one_tick_of_it() -> None:
    group = plan.GROUPS["montezuma-hybrid"]
    run = replace(room(0, 0.9), reward=np.zeros(4))
    figure = draw.reward_by_sample(Comparison(group, {group.series[0]: [run]}))
    figure.canvas.draw()
    low, high = figure.axes[0].get_ylim()
    assert [tick for tick in figure.axes[0].get_yticks() if low <= tick <= high] == [0]


def test_rewards_have_a_band_of_quartiles_within_the_band_of_their_range() -> None:
    group = plan.GROUPS["montezuma-hybrid"]
    runs = [replace(room(seed, 0.9), reward=np.full(4, float(seed))) for seed in range(5)]
    axes = draw.reward_by_sample(Comparison(group, {group.series[0]: runs})).axes[0]
    heights = [
        tuple(np.percentile(path.vertices[:, 1], [0, 100])) for one in axes.collections for path in one.get_paths()
    ]
    assert heights == [(0, 4), (1, 3)]


def test_the_csv_keeps_rewards_and_attempts_beside_runs_that_have_none() -> None:
    imitating = run_of(corridor(), [True, False])
    archive.write(Path(), [imitating, room(0, 0.95)])
    found = archive.read(Path())
    assert found[imitating.config].reached == {}
    assert np.isnan(found[imitating.config].reward).all()
    ours = found[room(0, 0.95).config]
    np.testing.assert_array_equal(ours.reward, [0, 1, 2, 3])
    np.testing.assert_array_equal(ours.reached["stair"], np.linspace(0, 0.95, 4))
    np.testing.assert_array_equal(ours.reached["key"], np.zeros(4))


def test_a_subgoal_is_learned_when_more_than_ninety_of_a_hundred_attempts_reached_it() -> None:
    group = plan.GROUPS["montezuma-hybrid"]
    comparison = Comparison(group, {group.series[0]: [room(0, 0.9), room(1, 0.91), room(2, 0.93)]})
    results = {one.measure: one for one in measures.summary([comparison])}
    stair, key = (results[f"LO samples until {subgoal} was learned"] for subgoal in ("stair", "key"))
    assert stair.ours == Spread(40, 40, NEVER, 3)  # ten samples an episode; the first run stays at 90 of 100
    assert key.ours == Spread(NEVER, NEVER, NEVER, 3)
    assert stair.published == 46_259  # the median of the authors' five logs
    assert results["total HI labels"].published == 12_218
    assert [name for name, _ in draw.figures_of(comparison)] == [f"{group.name}-{name}" for name in group.figures]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda text: text.replace("episode,", "epoch,", 1), "has a column 'epoch', which this version"),
        (lambda text: text.replace(",label_hi", "", 1), "has no column 'label_hi'"),
        (lambda text: text.replace(",6,1,", ",six,1,", 1), "line 2: invalid literal for int"),
        (
            lambda text: re.sub("(False,+)0,", r"\1zero,", text, count=1),
            "line 2: could not convert string to float: 'zero'",
        ),
        (lambda text: text.replace(",False,", ",maybe,", 1), "line 2: 'maybe' is neither True nor False"),
        (lambda text: text.replace("\n", "\n1,2\n", 1), "line 2: has 2 fields; the header has"),
    ],
)
def test_a_csv_that_is_none_of_runs_is_refused_by_its_line(
    expected: dict[str, bytes], wrong: Callable[[str], str], said: str
) -> None:
    path = Path(archive.FILE)
    path.write_bytes(expected[archive.FILE])
    text = gzip.decompress(path.read_bytes()).decode()
    assert wrong(text) != text
    path.write_bytes(gzip.compress(wrong(text).encode()))
    (sentence,) = refused("--from", ".", *TWO_SEEDS).splitlines()
    assert said in sentence


def test_a_file_that_is_no_archive_is_refused_by_its_name() -> None:
    Path(archive.FILE).write_text("episode,run\n")
    assert f"{archive.FILE} cannot be read" in refused("--from", ".", *TWO_SEEDS)


# --- what is missing


def test_missing_runs_are_listed_with_how_far_they_are_and_the_command_that_makes_them(
    trained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    longer = replace(TINY.series[1].config, episodes=20)
    monkeypatch.setitem(plan.GROUPS, "tiny", replace(TINY, series=(TINY.series[0], Series(longer, "h-BC"))))
    shutil.copy(trained, "waypost.db")
    with store(Path.cwd()) as (connection, _):
        begin(connection.learner, replace(longer, seed=3), episodes=7)
    arguments = ("--store", "waypost.db", "--figure", "tiny", "--seeds", "1,3", "--out", "figures")
    said = refused(*arguments).splitlines()
    assert said == [
        "These runs are missing:",
        "  h-bc, corridor, random, tiny, seed 1, not started",
        "  hg-dagger, corridor, random, tiny, seed 3, not started",
        "  h-bc, corridor, random, tiny, seed 3, 7 of 20 episodes",
        "This command trains them:",
        "  waypost sweep --figure tiny --seeds 1,3 --store waypost.db",
        "Use --partial to draw without them.",
    ]
    assert complaint(said[5].strip()) is None
    assert not Path("figures").exists()

    done = drawn(*arguments, "--partial", "--report", "report.md")
    assert done["runs"] == 2
    assert [f"  {line}" for line in done["missing"]] == said[1:4]
    report = Path("report.md").read_text()
    assert all(f"- {line}\n" in report for line in done["missing"])
    assert "--partial" in report


def test_only_the_seeds_that_are_missing_are_made_again(trained: Path) -> None:
    said = refused("--store", trained, "--figure", "tiny", "--seeds", "1,9,2,8")
    assert "--seeds 8,9 --store" in said
    assert "  h-bc, corridor, random, tiny, seeds 9, 8, not started\n" in said


def test_the_command_that_makes_what_is_missing_leaves_out_what_an_archive_has(trained: Path) -> None:
    drawn("--store", trained, *TWO_SEEDS, "--out", "kept")
    said = refused("--from", "kept", "--figure", "tiny", "--seeds", "1,9")
    assert "waypost sweep --figure tiny --seeds 9 --from kept --store runs.db" in said


def test_a_figure_of_which_no_run_is_there_is_refused_even_when_parts_are_wanted(trained: Path) -> None:
    assert "nothing to draw" in refused("--store", trained, "--figure", "hybrid", "--partial")


def test_a_store_of_a_newer_version_is_refused(trained: Path) -> None:
    shutil.copy(trained, "newer.db")
    with sqlite3.connect("newer.db") as file:
        file.execute("UPDATE alembic_version SET version_num = '9999'")
    file.close()
    (sentence,) = refused("--store", "newer.db", *TWO_SEEDS).splitlines()
    assert "use the newer version that wrote it" in sentence


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "--store FILE, --server URL, or --from FOLDER"),
        (("--store", "a.db", "--server", "http://127.0.0.1:9"), "either --server or --store"),
        (("--store", "nowhere.db"), "There is no store nowhere.db."),
        (("--from", "nowhere"), "There is no runs.csv.gz in nowhere."),
        (("--server", "http://127.0.0.1:9"), "WAYPOST_TOKEN"),
        (("--from", ".", "--seeds", "1,one"), "'1,one'"),
        (("--from", ".", "--seeds", "1,1"), "different numbers"),
        (("--from", ".", "--figure", "atari"), "the figures are: maze, options, lean, montezuma"),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(arguments: tuple[str, ...], said: str) -> None:
    (sentence,) = refused(*arguments).splitlines()
    assert said in sentence
    assert not Path("nowhere.db").exists()


def test_a_folder_that_cannot_be_written_is_said(trained: Path) -> None:
    Path("figures").write_text("a file")
    (sentence,) = refused("--store", trained, *TWO_SEEDS, "--out", "figures").splitlines()
    assert sentence.startswith("Cannot write figures: ")


# --- the report


def test_the_report_holds_tables_and_figures_and_the_commands_that_make_them(trained: Path) -> None:
    drawn("--store", trained, *TWO_SEEDS, "--out", "docs/results", "--report", "docs/results.md")
    text = Path("docs/results.md").read_text()
    linked = re.findall(r"\]\(([^)]+)\)", text)
    assert len(linked) == len(TINY.figures) + 2
    assert all(Path("docs", link).is_file() for link in linked)
    assert "| hg-DAgger |" in text
    commands = invocations(text)
    assert [complaint(command) for command in commands] == [None, None]
    assert commands == [
        "waypost sweep --figure tiny --seeds 1,2 --store waypost.db",  # no path of one machine
        "waypost figures --figure tiny --seeds 1,2 --from docs/results --out docs/results --report docs/results.md",
    ]
    drawn(*commands[1].split()[2:])
    assert Path("docs/results.md").read_text().replace("runs.db", "waypost.db") == text


@pytest.mark.parametrize("group", [group for group in plan.GROUPS.values() if group.figures], ids=lambda one: one.name)
def test_no_two_curves_of_a_figure_look_alike(group: Group) -> None:
    styles = [look.style_of(series) for series in group.series]
    assert len(set(styles)) == len(styles)
