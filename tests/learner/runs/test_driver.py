"""The driver: the same run whoever answers and in whatever order; what a budget, a pause and a refusal do to it."""

import random
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from tests.learner.kit import corridor, history, outcome, store

from waypost import wire
from waypost.client import Refused
from waypost_learner.algorithms import ALGORITHMS
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import Maze
from waypost_learner.experts.bot import Bot, BotSettings
from waypost_learner.experts.head_start import head_start
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.datasets import Dataset
from waypost_learner.policies.imitation import Policy
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.translation import vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs import driver
from waypost_learner.runs.checkpoints import read_header
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.training import train


class OutOfOrder:
    """Stands between a learner and its server: answers come only when the learner waits, one at a time, shuffled."""

    def __init__(self, connection: Connection, seed: int) -> None:
        assert connection.annotator is not None
        self._client, self._annotator = connection.learner, connection.annotator
        self._expert = OracleExpert(CorridorDomain())
        self._rng = random.Random(seed)
        self._held: list[wire.Assignment] = []
        self.most_open = 0

    def __getattr__(self, name: str) -> Any:
        return getattr(self._client, name)

    def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
        while (assignment := self._annotator.lease(wire.Lease(run=run))) is not None:
            self._held.append(assignment)
        self.most_open = max(self.most_open, len(self._held))
        chosen = self._held.pop(self._rng.randrange(len(self._held)))
        self._annotator.answer(chosen, self._expert(chosen.query.ask))
        return self._client.answers(run, after, wait)


class Noted(OutOfOrder):
    """Notes when the learner asks an episode's first question, goes on with it, and has learned."""

    def __init__(self, connection: Connection, events: list[str]) -> None:
        super().__init__(connection, seed=0)
        self._events = events

    def ask(self, run: str, queries: Sequence[wire.Ask]) -> list[wire.Query]:
        self._events.append("asks" if queries[0].ordinal == 0 else "goes on")
        return self._client.ask(run, queries)

    def report(self, run: str, results: Sequence[wire.EpisodeResult]) -> None:
        self._events.append("learned")
        self._client.report(run, results)


def at_once(path: Path, config: TrainConfig) -> tuple[Any, ...]:
    """The run with every query answered the moment it is asked."""
    with store(path) as (connection, options):
        return outcome(connection, train(config, connection, options))


def out_of_order(path: Path, config: TrainConfig, seed: int) -> tuple[tuple[Any, ...], int]:
    """The run with its answers in an order of chance, and how many queries were open at most."""
    with store(path) as (connection, options):
        between: Any = OutOfOrder(connection, seed)
        summary = train(config, Connection(between, None), options)
        return outcome(connection, summary), between.most_open


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, ...]:
    """The run that most tests are about."""
    return at_once(tmp_path_factory.mktemp("plain"), corridor())


@pytest.fixture(scope="module")
def three_in_flight(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, ...]:
    return at_once(tmp_path_factory.mktemp("three"), corridor(in_flight=3))


@pytest.mark.parametrize("seed", range(3))
def test_with_three_episodes_in_flight_the_run_is_the_same_whatever_order_the_answers_come_in(
    tmp_path: Path, three_in_flight: tuple[Any, ...], seed: int
) -> None:
    found, most_open = out_of_order(tmp_path, corridor(in_flight=3), seed)
    assert found == three_in_flight
    assert most_open == 3


def test_several_environments_step_together_and_their_episodes_are_open_at_once(tmp_path: Path) -> None:
    config = corridor(environments=4, episodes=15)
    found, most_open = out_of_order(tmp_path / "other", config, seed=1)
    assert found == at_once(tmp_path / "one", config)
    assert most_open == 4


def test_fewer_tests_change_nothing_but_the_tests(tmp_path: Path) -> None:
    config = corridor(algorithm="hg-dagger-q", episodes=15)
    weights, cost, *_, (_, tests, *_), asked = at_once(tmp_path / "each", config)
    fewer = at_once(tmp_path / "fewer", replace(config, test_every=4))
    assert (fewer[0], fewer[1], fewer[-1]) == (weights, cost, asked)
    assert fewer[-2][1] == [test if (episode + 1) % 4 == 0 else None for episode, test in enumerate(tests)]


@pytest.mark.parametrize("in_flight", [1, 3])
def test_training_on_and_asking_less_depend_on_nobodys_pace(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, in_flight: int
) -> None:
    monkeypatch.setattr(driver, "_UNTIL_NEXT_LOOK", 0)  # answers come after each update
    train_idle = " ".join(f"train_{level}.idle=32" for level in ("hi", "lo"))
    sampled = "monitoring.share=0.5 monitoring.rate=0.5 monitoring.confidence=0.5"
    config = corridor(in_flight=in_flight, values=f"{train_idle} {sampled}")
    assert out_of_order(tmp_path / "other", config, seed=1)[0] == at_once(tmp_path / "one", config)


def test_the_next_question_is_put_before_policies_train_idle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    events: list[str] = []
    trained_on = Policy.idle_updates
    monkeypatch.setattr(Policy, "idle_updates", lambda policy, rows: (events.append("on"), trained_on(policy, rows))[1])
    config = corridor(values="train_hi.idle=32 train_lo.idle=32", episodes=8)
    with store(tmp_path) as (connection, options):
        between: Any = Noted(connection, events)
        train(config, Connection(between, None), options)
    assert events[:4] == ["asks", "learned", "asks", "on"]
    last = len(events) - 1 - events[::-1].index("learned")
    before = {events[i - 1] for i in range(1, last) if events[i] == "on"} - {"on"}
    assert before == {"asks"}


def test_an_episode_goes_on_while_policies_train(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driver, "_UNTIL_NEXT_LOOK", 0)
    events: list[str] = []
    trained_on = Policy.idle_updates

    def noted(policy: Policy, rows: Dataset) -> Iterator[None]:
        for update in trained_on(policy, rows):
            events.append("update")
            yield update
        events.append("trained")

    monkeypatch.setattr(Policy, "idle_updates", noted)
    with store(tmp_path) as (connection, options):
        between: Any = Noted(connection, events)
        train(corridor(values="train_hi.idle=320", in_flight=3), Connection(between, None), options)
    during = {after for before, after in pairwise(events) if before == "update"}
    assert during == {"update", "goes on", "trained"}


def test_one_episode_in_flight_never_has_more_than_one_open_question(tmp_path: Path, plain: tuple[Any, ...]) -> None:
    found, most_open = out_of_order(tmp_path, corridor(), seed=1)
    assert most_open == 1
    assert found == plain


def test_the_same_values_give_the_same_run_and_another_seed_another(tmp_path: Path, plain: tuple[Any, ...]) -> None:
    assert at_once(tmp_path / "again", corridor()) == plain
    assert at_once(tmp_path / "other", corridor(seed=2))[0] != plain[0]


def test_queries_are_numbered_from_zero_in_every_episode_and_each_is_asked_once(plain: tuple[Any, ...]) -> None:
    *_, asked = plain
    by_episode: dict[int, list[int]] = {}
    for episode, ordinal, *_ in asked:
        by_episode.setdefault(episode, []).append(ordinal)
    assert list(by_episode) == list(range(12))
    assert all(ordinals == list(range(len(ordinals))) for ordinals in by_episode.values())
    assert {ask["kind"] for _, _, ask, *_ in asked} == {
        "hier_demo",
        "inspect_full",
        "label_hi",
        "inspect_lo",
        "label_lo",
    }


def test_the_run_starts_with_demonstrations_and_goes_on_with_questions(plain: tuple[Any, ...]) -> None:
    *_, asked = plain
    first = {episode: ask["kind"] for episode, ordinal, ask, *_ in asked if ordinal == 0}
    assert [first[episode] for episode in range(12)] == ["hier_demo"] * 3 + ["inspect_full"] * 9


def test_the_ledgers_sum_is_the_cost_of_the_summary(plain: tuple[Any, ...]) -> None:
    _, cost, *_, asked = plain
    assert cost["total"] == sum(units for *_, units in asked) == sum(cost["by_kind"].values())


def test_demonstrations_alone_make_a_run_of_algorithm_1(tmp_path: Path) -> None:
    *_, asked = at_once(tmp_path, corridor(algorithm="h-bc", episodes=4))
    assert [ask["kind"] for _, _, ask, *_ in asked] == ["hier_demo"] * 4


def test_every_episode_is_reported_with_a_test_on_an_unseen_instance(tmp_path: Path) -> None:
    reported: list[wire.EpisodeResult] = []
    with store(tmp_path) as (connection, options):
        train(corridor(), connection, options, on_episode=lambda result, _units: reported.append(result))
    assert [result.episode for result in reported] == list(range(12))
    assert [result.warm_start for result in reported] == [True] * 3 + [False] * 9
    assert [result.train_success is None for result in reported] == [True] * 3 + [False] * 9
    assert all(0 < result.test_steps <= 30 for result in reported)
    assert all(b.hi_labels >= a.hi_labels for a, b in pairwise(reported))
    assert reported[2].hi_labels > 0
    assert reported[2].lo_labels > reported[2].hi_labels


def test_a_budget_ends_the_run_with_what_it_has_and_is_never_overspent(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(), connection, replace(options, budget=95.0))
        run = connection.learner.run(summary["run"])
    assert summary["ended"] == "budget exhausted"
    assert 0 < summary["episodes"] < 12
    assert 0 < summary["cost"]["total"] <= 95
    assert (run.state, run.spent, run.reserved) == ("finished", summary["cost"]["total"], 0)
    assert (options.checkpoints / f"{run.id}.safetensors").exists()


@pytest.mark.parametrize("budget", [95.0, 110.0, 130.0])
def test_a_run_whose_budget_ends_has_learned_all_it_paid_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, budget: float
) -> None:
    events: list[str] = []
    learn, train_idle = Learner.learn, Learner.train_idle
    monkeypatch.setattr(Learner, "learn", lambda learner, labels: (events.append("learn"), learn(learner, labels)))
    monkeypatch.setattr(
        Learner, "train_idle", lambda learner, *some: (events.append("on"), train_idle(learner, *some))[1]
    )
    with store(tmp_path) as (connection, options):
        train(corridor(), connection, replace(options, budget=budget))
    assert "learn" in events
    assert events[-1] == "on"


def test_a_budget_that_pays_nothing_ends_the_run_before_its_first_episode(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(), connection, replace(options, budget=1.0))
    assert (summary["ended"], summary["episodes"], summary["cost"]["total"]) == ("budget exhausted", 0, 0)
    assert summary["success_rate"] is None


def test_a_run_that_somebody_finishes_stops_with_the_servers_refusal(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        runs: list[str] = []

        def finish(result: wire.EpisodeResult, _units: float) -> None:
            if result.episode == 4:
                connection.learner.patch_run(runs[0], wire.RunPatch(state="finished"))

        with pytest.raises(Refused, match="finished"):
            train(corridor(), connection, options, lambda run, _: runs.append(run.id), finish)


def test_the_expert_in_process_answers_what_somebody_else_took_and_gave_back(
    tmp_path: Path, plain: tuple[Any, ...]
) -> None:
    class Taken(OutOfOrder):
        """Somebody takes each of the first questions, and gives it back only when the learner waits."""

        waits = 0

        def ask(self, run: str, queries: Sequence[wire.Ask]) -> list[wire.Query]:
            asked = self._client.ask(run, queries)
            if self.waits < 3:
                self._held += filter(None, [self._annotator.lease(wire.Lease(run=run))])
            return asked

        def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
            del wait
            self.waits += 1
            assert self.waits < 20, "nobody answers"
            while self._held:
                self._annotator.release(self._held.pop())
            return self._client.answers(run, after)

    with store(tmp_path) as (connection, options):
        between: Any = Taken(connection, seed=0)
        assert outcome(connection, train(corridor(), Connection(between, connection.annotator), options)) == plain
        assert between.waits >= 3


def test_a_bot_that_errs_answers_what_the_server_accepts_and_changes_the_run(
    tmp_path: Path, plain: tuple[Any, ...]
) -> None:
    class Erring(OutOfOrder):
        def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
            bot.work(wait=0)
            return self._client.answers(run, after, wait)

    with store(tmp_path) as (connection, options):
        assert connection.annotator is not None
        bot = Bot(connection.annotator, BotSettings(error_rate=0.5, seed=1))
        between: Any = Erring(connection, seed=0)
        summary = train(corridor(), Connection(between, None), options)
        erred = outcome(connection, summary)
    assert erred[0] != plain[0]
    assert summary["episodes"] == 12


def test_a_bot_answers_only_the_kinds_and_the_run_it_was_told_to(tmp_path: Path) -> None:
    class Restricted(OutOfOrder):
        def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
            for bot in (inspector, labeler):
                bot.work(wait=0, on_answer=lambda receipt, bot=bot: answered[bot].append(receipt.query))
            stranger.work(wait=0, on_answer=lambda _: pytest.fail("answered a run it was not told to"))
            return self._client.answers(run, after, wait)

    another = wire.RunCreate(name="another", algorithm="h-bc", seed=0, vocabulary=vocabulary(CorridorDomain()))
    with store(tmp_path) as (connection, options):
        annotator = connection.annotator
        assert annotator is not None
        inspector = Bot(annotator, BotSettings(kinds=("inspect_full", "inspect_lo")))
        labeler = Bot(annotator, BotSettings(kinds=("hier_demo", "label_hi", "label_lo")))
        stranger = Bot(annotator, BotSettings(run=connection.learner.create_run(another).id))
        answered: dict[Bot, list[int]] = {inspector: [], labeler: []}
        between: Any = Restricted(connection, seed=0)
        train(corridor(), Connection(between, None), options)
        kinds = {bot: {connection.learner.query(q).ask.kind for q in queries} for bot, queries in answered.items()}
    assert "inspect_full" in kinds[inspector]
    assert kinds[inspector] <= {"inspect_full", "inspect_lo"}
    assert "hier_demo" in kinds[labeler]
    assert kinds[labeler] <= {"hier_demo", "label_hi", "label_lo"}


@pytest.mark.parametrize("algorithm", sorted(ALGORITHMS))
@pytest.mark.parametrize("lean", [{}, {"preset": "tiny-lean", "domain": "maze", "episodes": 6}])
def test_every_algorithm_repeats_itself_to_the_last_bit(tmp_path: Path, algorithm: str, lean: dict[str, Any]) -> None:
    config = corridor(algorithm=algorithm, head_start=0.5 if algorithm == "h-dqn" else None, **lean)
    found, again = at_once(tmp_path / "one", config), at_once(tmp_path / "other", config)
    assert found == again


@pytest.mark.parametrize("algorithm", ["hg-dagger", "naive-h-dagger", "flat-dagger"])
def test_with_redraw_every_episode_after_the_warm_start_is_a_failed_one(tmp_path: Path, algorithm: str) -> None:
    reported: list[wire.EpisodeResult] = []
    with store(tmp_path) as (connection, options):
        config = corridor(algorithm=algorithm, redraw=True)
        summary = train(config, connection, options, on_episode=lambda result, _units: reported.append(result))
        drawn = read_header(options.checkpoints / f"{summary['run']}.safetensors").progress.draws
    assert [result.train_success for result in reported] == [None] * 3 + [False] * 9
    assert drawn > 12  # otherwise nothing was drawn again, and this test shows nothing


def test_an_instance_that_fails_is_not_drawn_again_for_as_long_as_there_are_others(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        run = train(corridor(redraw=True), connection, options)["run"]
        asked = history(connection.learner, run)
    instances = [str(ask["instance"]) for episode, ordinal, ask, *_ in asked if ordinal == 0]
    assert len(set(instances)) == len(instances)


@pytest.mark.parametrize("algorithm", ["h-bc", "flat-bc", "hg-dagger-q", "h-dqn", "flat-dqn"])
def test_redraw_is_refused_where_no_instance_is_drawn_for_a_question(tmp_path: Path, algorithm: str) -> None:
    with store(tmp_path) as (connection, options), pytest.raises(ValueError, match="leave out --redraw"):
        train(corridor(algorithm=algorithm, redraw=True), connection, options)


def test_a_head_start_is_for_learners_without_an_expert(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options), pytest.raises(ValueError, match="leave out --head-start"):
        train(corridor(head_start=0.5), connection, options)


@pytest.mark.parametrize("share", [0.0, 1.0, -0.5])
def test_a_head_start_is_a_share_of_the_way(tmp_path: Path, share: float) -> None:
    with store(tmp_path) as (connection, options), pytest.raises(ValueError, match="between 0 and 1"):
        train(corridor(algorithm="h-dqn", head_start=share), connection, options)


def test_a_head_start_is_the_first_half_of_an_optimal_way_and_costs_no_steps() -> None:
    domain = CorridorDomain()
    simulator = Simulator(domain, head_start(domain, 0.5))
    assert simulator.reset(Corridor(2, 11)).view == 2 + 4  # of 9 steps
    assert (simulator.steps, simulator.ended) == (0, False)


def test_learning_by_reinforcement_alone_costs_nothing_and_is_tested_all_the_same(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(algorithm="flat-dqn"), connection, options)
        curves = connection.learner.curves(summary["run"])
    assert summary["cost"]["total"] == 0
    assert len(curves.test_success) == 12
    assert curves.lo_samples[-1] > 0


def test_where_q_functions_learn_subgoals_every_attempt_and_reward_is_reported(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(algorithm="h-dqn"), connection, options)
        curves = connection.learner.curves(summary["run"])
        flat = connection.learner.curves(train(corridor(algorithm="flat-dqn"), connection, options)["run"])
    assert set(curves.reached) <= set(CorridorDomain().subgoals)
    assert any(rates[-1] > 0 for rates in curves.reached.values())
    assert any(curves.reward)
    assert flat.reached == {}


def test_training_instances_are_varied_where_their_set_says_so(tmp_path: Path) -> None:
    config = TrainConfig("h-bc", instances="corners", preset="tiny", episodes=3)
    with store(tmp_path) as (connection, options):
        asked = [history(connection.learner, train(config, connection, options)["run"]) for _ in range(2)]
    mazes = [Maze.from_json(ask["instance"]) for *_, ask, _answer, _units in asked[0]]
    assert asked[0] == asked[1]  # the same doors in the same run
    stored = MazeDomain().instances("corners").train
    assert not any((maze.lava == one.lava).all() for maze in mazes for one in stored)
