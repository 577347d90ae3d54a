"""What is measured in runs, compared and drawn: medians and ranges, first times, costs, published numbers."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.experiments.figures_kit import marked, published_runs, results_of, run_of
from tests.learner.kit import corridor, examples

from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import draw, look, measures, tables
from waypost_learner.experiments.figures.data import KINDS, Comparison, RunCurves
from waypost_learner.experiments.figures.published import published
from waypost_learner.experiments.figures.statistics import Track, band, first_at, spread
from waypost_learner.experiments.plan.series import Series
from waypost_server.runs.curves import first_at as server_first_at

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
    assert (found.low <= found.lower_quartile).all()
    assert (found.lower_quartile <= found.median).all()
    assert (found.median <= found.upper_quartile).all()
    assert (found.upper_quartile <= found.high).all()
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
    found = results_of(comparison)[("hg-DAgger", "total expert cost")].ours
    assert found is not None
    assert found.median == 4 * 1_000  # six kinds without two inspections
    honest = results_of(Comparison(plan.GROUPS["corners"], comparison.runs))
    with_inspections = honest[("hg-DAgger", "total expert cost")].ours
    assert with_inspections is not None
    assert with_inspections.median == 6 * 1_000
    options = ["options-hg-dagger", "options-flat-dagger", "options-flat-bc"]
    assert [name for name, group in plan.GROUPS.items() if group.labels_only] == ["published", "naive", *options]


def test_published_numbers_stand_beside_those_counted_alike_and_nowhere_else() -> None:
    comparison = published_runs()
    beside = results_of(comparison)
    assert beside[("hg-DAgger", "success after 500 episodes")].published == pytest.approx(81)
    assert beside[("h-BC", "total expert cost")].published == 64_000
    assert beside[("flat BC", "expert cost when 80% was reached")].published == float("inf")
    assert beside[("", "expert cost, hg-DAgger / flat DAgger")].published == pytest.approx(0.35)
    elsewhere = results_of(Comparison(plan.GROUPS["corners"], comparison.runs))
    assert {result.published for result in elsewhere.values()} == {None}


def test_of_several_variants_of_an_algorithm_the_first_stands_beside_the_published_numbers() -> None:
    costs = {
        name: [published(plan.GROUPS[name], series).cost for series in plan.GROUPS[name].series]
        for name in ("options-hg-dagger", "options-flat-bc")
    }
    assert costs == {"options-hg-dagger": [21_000] + [None] * 5, "options-flat-bc": [44_000] + [None] * 3}


def test_no_two_runs_of_the_plan_have_the_same_name() -> None:
    names = [plan.name_of(run) for run in plan.runs_of(list(plan.GROUPS.values()), (0, 1))]
    assert len(set(names)) == len(names)


def test_a_level_that_was_not_reached_is_never_in_a_whole_run_and_unknown_in_an_unfinished_one() -> None:
    whole = run_of(corridor(episodes=100), [False] * 100)
    assert measures.at_level(whole, 0.8, whole.lo_samples) == float("inf")
    unfinished = run_of(corridor(episodes=900), [False] * 100)
    assert np.isnan(measures.at_level(unfinished, 0.8, unfinished.lo_samples))
    assert np.isnan(measures.at_end(unfinished, unfinished.lo_samples))


def test_whether_a_run_with_less_than_a_hundred_tests_reached_a_level_is_unknown() -> None:
    short = run_of(corridor(episodes=99), [True] * 99)
    assert np.isnan(measures.at_level(short, 0.8, short.lo_samples))


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

    def runs(series: Series, spent: dict[int, float]) -> list[RunCurves]:
        config = replace(series.config, episodes=2)
        return [run_of(replace(config, seed=seed), [True] * 2, label_lo=[1, units]) for seed, units in spent.items()]

    comparison = Comparison(group, {guided: runs(guided, {0: 2, 1: 10, 7: 9}), naive: runs(naive, {1: 20, 0: 100})})
    found = results_of(comparison)[("", "LO cost without demonstrations, naive h-DAgger / hg-DAgger")].ours
    assert found is not None
    assert (found.low, found.high, found.runs) == (2, 50, 2)


def test_totals_of_runs_that_are_not_equally_long_have_no_ratio() -> None:
    comparison = published_runs(20)
    name = ("", "expert cost, hg-DAgger / flat DAgger")
    assert name in results_of(comparison)
    [flat] = [series for series in comparison.runs if series.config.algorithm == "flat-dagger"]
    longer = run_of(replace(flat.config, episodes=30), [True] * 30, **dict.fromkeys(KINDS, [1.0] * 30))
    assert name not in results_of(Comparison(comparison.group, {**comparison.runs, flat: [longer]}))


def test_of_several_variants_of_an_algorithm_the_first_has_the_ratio() -> None:
    comparison = published_runs(20)
    guided = next(series for series in comparison.runs if series.config.algorithm == "hg-dagger")
    variant = replace(guided, label="hg-DAgger, variant")
    dear = run_of(replace(guided.config, episodes=20), [True] * 20, **dict.fromkeys(KINDS, [1_000.0] * 20))
    name = ("", "expert cost, hg-DAgger / flat DAgger")
    with_variant = Comparison(comparison.group, {**comparison.runs, variant: [dear]})
    assert results_of(with_variant)[name].ours == results_of(comparison)[name].ours


def test_the_summary_says_never_where_the_median_run_never_got_there(tmp_path: Path) -> None:
    series = plan.GROUPS["published"].series[0]
    config = replace(series.config, episodes=150)
    runs = [run_of(replace(config, seed=n), [n == 0] * 150) for n in range(3)]
    comparison = Comparison(plan.GROUPS["published"], {series: runs})
    rows = tables.write_summary(tmp_path, [comparison]).read_text().splitlines()
    (row,) = [row for row in rows if "95%" in row]
    assert row == "published,hg-DAgger,expert cost when 95% was reached,units,never,0,never,3,17000"
    (line,) = [line for line in tables.markdown(comparison) if line.startswith("| hg-DAgger | 3 | never (0 to never)")]
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
    for group in (plan.GROUPS[name] for name in plan.FIGURES["maze"] if plan.GROUPS[name].figures):
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
    group = plan.GROUPS["published"]
    series = group.series[0]
    runs = [run_of(replace(series.config, seed=n), [True] * 2) for n in range(3)]
    said = " ".join(text.get_text() for text in draw.success_by_episode(Comparison(group, {series: runs})).texts)
    assert "Median and range of 3 runs, some unfinished." in said


def test_what_was_published_is_known_of_every_series_of_its_group() -> None:
    group = plan.GROUPS["published"]
    assert all(published(group, series).cost for series in group.series)
