"""`waypost figures`: what is drawn is what was measured, and whoever has the CSV can draw it again."""

import gzip
import json
import re
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
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
from matplotlib.figure import Figure
from PIL import Image
from typer.testing import CliRunner

from learner.cli import app
from learner.client import Client
from learner.config import TrainConfig
from learner.experiments import plan
from learner.experiments.figures import archive, draw, look, make, measures, tables
from learner.experiments.figures.data import KINDS, Comparison, RunCurves
from learner.experiments.figures.published import published
from learner.experiments.figures.statistics import Track, band, first_at, spread
from learner.experiments.figures.store import read, stored
from learner.training import train
from server import people, serving, wire
from server.curves import _first_at as server_first_at
from server.curves import trailing
from server.settings import Settings
from tests.learner.kit import corridor, examples, store
from tests.repository.kit import complaint, invocations

EPISODES = 6
TINY = plan.Group(
    "tiny",
    "corridors, to try the figures",
    "Episodes: every rollout.",
    ("success-by-episode", "success-by-cost", "success-by-lo-cost", "cost-by-kind", "lo-cost-by-episode"),
    (
        plan.Series(corridor(episodes=EPISODES), "hg-DAgger"),
        plan.Series(corridor(algorithm="h-bc", episodes=EPISODES), "h-BC"),
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


# --- hand-made runs


def run_of(
    config: TrainConfig, tests: Sequence[bool | None], hi: Sequence[int] | None = None, **costs: Sequence[float]
) -> RunCurves:
    """A run whose tests, sizes of D_HI and cumulative costs are given; 10 LO samples an episode."""
    n = len(tests)
    by_kind: dict[wire.Kind, list[float]] = {kind: list(costs.get(kind, [0.0] * n)) for kind in KINDS}
    curves = wire.Curves(
        episode=list(range(n)),
        success_rate=trailing(tests),
        test_success=list(tests),
        cost=[sum(column) for column in zip(*by_kind.values(), strict=True)],
        lo_cost=list(costs.get("lo_cost", [0.0] * n)),
        seconds=[0.0] * n,
        active_seconds=[0.0] * n,
        cost_by_kind=by_kind,
        hi_labels=list(hi or [0] * n),
        lo_samples=[10 * (row + 1) for row in range(n)],
        learner_seconds=[0.1 * (row + 1) for row in range(n)],
    )
    return RunCurves.of(config, curves)


def published_runs(n: int = 1_000, **more: Any) -> Comparison:
    """The published group with one run each, in which everything costs 1 an episode."""
    group = plan.GROUPS["published"]
    ones = list(np.cumsum(np.ones(n)))
    runs = {
        series: [run_of(replace(series.config, episodes=n), [True] * n, **dict.fromkeys(KINDS, ones), **more)]
        for series in group.series
    }
    return Comparison(group, runs)


def results_of(comparison: Comparison) -> dict[tuple[str, str], measures.Result]:
    return {(result.series, result.measure): result for result in measures.summary([comparison])}


def marked(figure: Figure) -> dict[str, tuple[float, float]]:
    """The published points on a figure, by what they are of."""
    points = [line for axes in figure.axes for line in axes.get_lines() if (line.get_gid() or "").startswith("publ")]
    return {str(line.get_gid()): (line.get_xdata()[0], line.get_ydata()[0]) for line in points}  # type: ignore[index]


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
    viewer = served.db.write_now(lambda tx: people.ensure_user(tx, "ann", "viewer"))
    token = served.db.write_now(lambda tx: people.create_token(tx, viewer.id, "test")).token
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
    code = "import sys, learner.experiments.figures.make; print({'torch', 'learner.algorithms'} & set(sys.modules))"
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
    with stored(Path("waypost.db")) as source:
        found = read(source, [config])
    assert list(found[config].hi_labels) == [3] * 5


amounts = st.one_of(st.integers(0, 10**9).map(float), st.floats(0, 1e9, allow_subnormal=False))


@examples
@given(st.lists(st.tuples(*[amounts] * 6, st.sampled_from([True, False, None])), min_size=1, max_size=8), st.booleans())
def test_a_run_comes_back_from_the_csv_as_it_was(rows: list[tuple[Any, ...]], redraw: bool) -> None:
    *costs, tests = zip(*rows, strict=True)
    config = corridor(redraw=redraw, head_start=0.5, instances='odd, "name"')
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


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda text: text.replace("episode,", "epoch,", 1), "has a column 'epoch', which this version"),
        (lambda text: text.replace(",label_hi", "", 1), "has no column 'label_hi'"),
        (lambda text: text.replace(",6,1,", ",six,1,", 1), "line 2: invalid literal for int"),
        (
            lambda text: text.replace("False,,0,", "False,,zero,", 1),
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
    monkeypatch.setitem(plan.GROUPS, "tiny", replace(TINY, series=(TINY.series[0], plan.Series(longer, "h-BC"))))
    shutil.copy(trained, "waypost.db")
    with store(Path.cwd()) as (connection, _):
        begin(connection.learner, replace(longer, seed=3), episodes=7)
    arguments = ("--store", "waypost.db", "--figure", "tiny", "--seeds", "1,3", "--out", "figures")
    said = refused(*arguments).splitlines()
    assert said == [
        "These runs are missing:",
        "  h-bc, random, seed 1, not begun",
        "  hg-dagger, random, seed 3, not begun",
        "  h-bc, random, seed 3, 7 of 20 episodes",
        "This makes them:",
        "  waypost sweep --figure tiny --seeds 1,3 --store waypost.db",
        "With --partial, what is there is drawn.",
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
    assert "--seeds 8,9 --store" in refused("--store", trained, "--figure", "tiny", "--seeds", "1,9,2,8")


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
        (("--from", ".", "--seeds", "1,1"), "numbers that differ"),
        (("--from", ".", "--figure", "atari"), "those that exist are: maze, published"),
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


# --- medians, ranges, and first times


def test_a_spread_is_the_median_and_the_range_of_what_is_known_and_never_is_infinite() -> None:
    nan, never = float("nan"), float("inf")
    found = spread([3, nan, 1, never, 2])
    assert found is not None
    assert (found.median, found.low, found.high, found.runs) == (2.5, 1, never, 4)
    most_never = spread([1, never, never])
    assert most_never is not None
    assert most_never.median == never
    assert spread([nan]) is None


def track(x: Sequence[float], y: Sequence[float], over: bool = True) -> Track:
    return Track(np.array(x, float), np.array(y, float), over)


def test_a_run_is_a_step_function_whose_end_holds_once_it_is_over() -> None:
    grid = np.array([0, 1, 1.9, 2, 3, 9])
    np.testing.assert_array_equal(track([1, 2, 2, 3], [1, 2, 3, 4]).at(grid), [np.nan, 1, 1, 3, 4, 4])
    np.testing.assert_array_equal(track([1, 2, 2, 3], [1, 2, 3, 4], over=False).at(grid), [np.nan, 1, 1, 3, 4, np.nan])


def test_a_band_ends_where_half_of_the_runs_have_ended_and_keeps_what_whole_runs_ended_with() -> None:
    found = band([track([0, 10], [0, 1]), track([0, 20], [0, 2]), track([0, 30], [0, 9])])
    assert found is not None
    assert (found.x[0], found.x[-1]) == (0, 20)
    assert (found.low[-1], found.median[-1], found.high[-1]) == (0, 1, 2)  # 1 since 10, 2 since 20, and 0 until 30


def test_a_band_begins_where_all_runs_have_begun() -> None:
    found = band([track([1, 10], [0, 1]), track([5, 10], [0, 1])])
    assert found is not None
    assert found.x[0] == 5


def test_a_band_leaves_an_unfinished_run_out_from_its_end_on() -> None:
    found = band([track([0, 10], [5, 5], over=False), track([0, 20], [1, 1]), track([0, 20], [1, 1])])
    assert found is not None
    assert (found.high[found.x <= 10] == 5).all()
    assert (found.high[found.x > 10] == 1).all()


def test_a_band_is_there_though_first_tests_are_not_and_not_there_without_any() -> None:
    found = band([track([0, 1, 2], [np.nan, 4, 4])])
    assert found is not None
    assert found.x[0] == 1
    assert band([track([0, 1], [np.nan, np.nan])]) is None


curves = st.lists(st.tuples(st.floats(0, 50), st.floats(0, 100)), min_size=1, max_size=30)


@examples
@given(st.lists(st.tuples(curves, st.booleans()), min_size=1, max_size=5))
def test_a_band_holds_its_median_within_its_range_within_what_runs_had(
    runs: list[tuple[list[tuple[float, float]], bool]],
) -> None:
    tracks = [track(np.cumsum([x for x, _ in rows]), [y for _, y in rows], over) for rows, over in runs]  # type: ignore[arg-type]
    found = band(tracks)
    assert found is not None
    assert (found.low <= found.median).all()
    assert (found.median <= found.high).all()
    assert found.low.min() >= min(t.y.min() for t in tracks)
    assert found.high.max() <= max(t.y.max() for t in tracks)
    assert (np.diff(found.x) > 0).all()
    assert found.x[-1] <= max(t.x[-1] for t in tracks)


@examples
@given(st.lists(st.tuples(st.booleans(), st.integers(60, 140)), max_size=6), st.sampled_from([0.5, 0.8, 0.95, 1.0]))
def test_a_level_is_first_reached_where_the_server_says_so(pieces: list[tuple[bool, int]], level: float) -> None:
    tests: list[bool | None] = [None, *(value for value, n in pieces for value in [value] * n)]
    run = run_of(corridor(), tests)
    expected = server_first_at(level, list(range(len(tests))), tests, [0.0] * len(tests))
    assert first_at(level, run.test_success, run.success_rate) == (expected and expected.episode)


def test_a_level_needs_a_full_hundred_of_tests() -> None:
    run = run_of(corridor(), [True] * 120)
    assert first_at(0.8, run.test_success, run.success_rate) == 99


# --- what is compared


def test_counted_as_the_authors_count_inspections_cost_nothing() -> None:
    comparison = published_runs()
    found = results_of(comparison)[("hg-DAgger", "expert cost in all")].ours
    assert found is not None
    assert found.median == 4 * 1_000  # six kinds without two inspections
    honest = results_of(Comparison(plan.GROUPS["corners"], comparison.runs))
    with_inspections = honest[("hg-DAgger", "expert cost in all")].ours
    assert with_inspections is not None
    assert with_inspections.median == 6 * 1_000
    assert [name for name, group in plan.GROUPS.items() if group.labels_only] == ["published", "naive"]


def test_published_numbers_stand_beside_those_counted_alike_and_nowhere_else() -> None:
    comparison = published_runs()
    beside = results_of(comparison)
    assert beside[("hg-DAgger", "success after 500 episodes")].published == pytest.approx(81)
    assert beside[("h-BC", "expert cost in all")].published == 64_000
    assert beside[("flat BC", "expert cost when 80% was reached")].published == float("inf")
    assert beside[("", "expert cost of hg-DAgger to flat DAgger's")].published == pytest.approx(0.35)
    elsewhere = results_of(Comparison(plan.GROUPS["corners"], comparison.runs))
    assert {result.published for result in elsewhere.values()} == {None}


def test_a_level_that_was_not_reached_is_never_in_a_whole_run_and_unknown_in_an_unfinished_one() -> None:
    whole = run_of(corridor(episodes=3), [False] * 3)
    assert measures.at_level(whole, 0.8, whole.lo_samples) == float("inf")
    unfinished = run_of(corridor(episodes=9), [False] * 3)
    assert np.isnan(measures.at_level(unfinished, 0.8, unfinished.lo_samples))
    assert np.isnan(measures.at_end(unfinished, unfinished.lo_samples))


def test_success_after_so_many_episodes_is_the_rate_at_just_that_one() -> None:
    run = run_of(corridor(episodes=4), [True, False, True, True])
    assert [measures.success_after(run, n) for n in (1, 2, 4)] == [100, 50, 75]
    assert np.isnan(measures.success_after(run, 5))


def test_the_late_share_is_what_was_spent_after_episode_500() -> None:
    lo_cost = [900.0 * min(n, 500) / 500 + max(n - 500, 0) / 5 for n in range(1, 1_001)]
    run = run_of(corridor(episodes=1_000), [True] * 1_000, lo_cost=lo_cost)
    assert measures.late_share(run, run.lo_cost) == pytest.approx(10)


def test_hi_labels_are_counted_per_sample_in_the_first_and_the_last_fifth() -> None:
    hi = [min(10 * n, 200) for n in range(1, 101)]  # 10 an episode of 10 samples, until the 20th
    run = run_of(corridor(episodes=100), [True] * 100, hi)
    assert measures.labels_per_thousand_samples(run, 0.0, 0.2) == pytest.approx(1_000)
    assert measures.labels_per_thousand_samples(run, 0.8, 1.0) == 0


def test_ratios_are_of_runs_of_one_seed() -> None:
    group = plan.GROUPS["naive"]
    guided, naive = group.series

    def runs(series: plan.Series, spent: dict[int, float]) -> list[RunCurves]:
        config = replace(series.config, episodes=2)
        return [run_of(replace(config, seed=seed), [True] * 2, label_lo=[1, units]) for seed, units in spent.items()]

    comparison = Comparison(group, {guided: runs(guided, {0: 2, 1: 10, 7: 9}), naive: runs(naive, {1: 20, 0: 100})})
    found = results_of(comparison)[("", "LO cost of naive h-DAgger to hg-DAgger's, without demonstrations")].ours
    assert found is not None
    assert (found.low, found.high, found.runs) == (2, 50, 2)


def test_the_summary_says_never_where_the_median_run_never_got_there(tmp_path: Path) -> None:
    series = plan.GROUPS["published"].series[0]
    config = replace(series.config, episodes=150)
    runs = [run_of(replace(config, seed=n), [n == 0] * 150) for n in range(3)]
    comparison = Comparison(plan.GROUPS["published"], {series: runs})
    rows = tables.write_summary(tmp_path, [comparison]).read_text().splitlines()
    (row,) = [row for row in rows if "95%" in row]
    assert row == "published,hg-DAgger,expert cost when 95% was reached,units,never,0,never,3,17000"
    (line,) = [line for line in tables.markdown(comparison) if line.startswith("| hg-DAgger | never (0 to never)")]
    assert line.count("never") == 4


# --- the figures


def test_the_published_numbers_are_on_the_figures(tmp_path: Path) -> None:
    comparison = published_runs(20)
    by_episode = marked(draw.success_by_episode(comparison))
    assert len(by_episode) == 16
    assert by_episode["published hg-DAgger 600 95%"] == (600, 95)
    assert by_episode["published flat BC 1000 69%"] == (1_000, 69)
    by_cost = marked(draw.success_by_cost(comparison))
    assert by_cost["published hg-DAgger 14500 80%"] == (14_500, 80)
    assert by_cost["published h-BC 64000 87%"] == (64_000, 87)
    assert not [name for name in by_cost if "h-BC" in name and "95%" in name]  # it never got there
    by_lo_cost = marked(draw.success_by_lo_cost(comparison))
    assert by_lo_cost["published flat DAgger 60000 80%"] == (60_000, 80)
    assert not [name for name in by_lo_cost if "hg-DAgger" in name]  # of its LO cost, nothing was published
    assert marked(draw.cost_by_kind(comparison)) == {"published hg-dagger cost": (1_000, 21_000)}
    svg, _ = draw.save(draw.success_by_cost(comparison), tmp_path, "figure")
    assert svg.read_text().count("published hg-DAgger") == 3


def test_the_published_levels_of_h_dqn_are_on_the_hybrid_figure() -> None:
    group = plan.GROUPS["hybrid"]
    runs = {series: [run_of(replace(series.config, episodes=5), [False] * 5)] for series in group.series}
    levels = marked(draw.success_by_sample(Comparison(group, runs)))
    assert {name: y for name, (_, y) in levels.items()} == {
        "published h-DQN, head start 50 % 30%": 30,
        "published h-DQN 0%": 0,
    }


def test_no_published_number_is_on_a_figure_that_is_counted_otherwise() -> None:
    comparison = Comparison(plan.GROUPS["corners"], published_runs(20).runs)
    assert not [name for _, figure in draw.figures_of(comparison) for name in marked(figure)]


def test_every_figure_of_the_plan_can_be_drawn_and_its_series_told_apart() -> None:
    for group in (plan.GROUPS[name] for name in plan.FIGURES["maze"]):
        styles = [look.style_of(series) for series in group.series]
        assert len({style.color for style in styles}) == len({str(style.line) for style in styles}) == len(styles)
        runs = {series: [run_of(replace(series.config, episodes=5), [True] * 5)] for series in group.series}
        names = [name for name, _ in draw.figures_of(Comparison(group, runs))]
        assert names == [f"{group.name}-{figure}" for figure in group.figures]


def test_every_figure_says_how_it_counts_and_of_how_many_runs() -> None:
    comparison = published_runs(5)
    for _, figure in draw.figures_of(comparison):
        said = " ".join(text.get_text() for text in figure.texts)
        assert comparison.group.counting in said
        assert "One run each." in said
        assert all(axes.get_xlabel() or len(figure.axes) > 1 for axes in figure.axes)
        assert all(axes.get_ylabel() for axes in figure.axes)


def test_a_figure_says_that_some_of_its_runs_are_unfinished() -> None:
    series = TINY.series[0]
    runs = [run_of(replace(series.config, seed=n), [True] * 2) for n in range(3)]
    said = " ".join(text.get_text() for text in draw.success_by_episode(Comparison(TINY, {series: runs})).texts)
    assert "Median and range of 3 runs, some unfinished." in said


def test_what_was_published_is_known_of_every_series_of_its_group() -> None:
    group = plan.GROUPS["published"]
    assert all(published(group, series).cost for series in group.series)


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
