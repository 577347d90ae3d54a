"""Defines the messages about runs: their settings, episodes, curves, costs and events."""

from typing import Literal

from pydantic import Field

from waypost.wire.words import GoldRate, Json, Kind, Message, Name, RunState, SecondShare, Units

__all__ = [
    "Attempt",
    "CostOfKind",
    "Costs",
    "Curves",
    "EpisodeList",
    "EpisodeResult",
    "Event",
    "Forecast",
    "ForecastRange",
    "Milestone",
    "Prices",
    "Run",
    "RunCreate",
    "RunDeletion",
    "RunList",
    "RunPatch",
    "RunSort",
    "SuccessLevel",
    "Vocabulary",
]


class Prices(Message):
    """The prices of a run, in units with up to six decimals.

    The defaults are the paper's: a Label costs the length of what it labels, an Inspect costs 1.
    """

    subgoal: Units = Field(default=1.0, description="The price of one HI label (a subgoal at a state), in units.")
    action: Units = Field(default=1.0, description="The price of one LO label (an action at a state), in units.")
    termination: Units = Field(default=1.0, description="The price of the termination labels of one segment, in units.")
    inspect_full: Units = Field(default=1.0, description="The price of one Inspect_FULL, in units.")
    inspect_lo: Units = Field(default=1.0, description="The price of one Inspect_LO, in units.")


class Vocabulary(Message):
    """The names of a domain, in the order of its numbers, and the renderer that draws it in the web app."""

    domain: Name
    subgoals: list[Name] = Field(max_length=1_000, description="The subgoals; empty for a domain without subgoals.")
    actions: list[Name] = Field(min_length=1, max_length=1_000, description="The actions.")
    renderer: Name = Field(description="The renderer of the web app that draws its instances and states.")


class RunCreate(Message):
    """The description of a new run, sent by the learner."""

    name: Name
    algorithm: Name
    seed: int = Field(ge=0, le=2**63 - 1)
    vocabulary: Vocabulary
    config: dict[str, Json] = Field(default_factory=dict, description="All values that determine the run.")
    prices: Prices = Field(default_factory=Prices)
    budget: Units | None = Field(
        default=None, description="The highest total cost of the run, in units; null for no limit."
    )
    episodes: int | None = Field(default=None, ge=1, le=10**9, description="The planned number of episodes.")
    second_answers: SecondShare = 0


class RunPatch(Message):
    """Changes of a run. Absent fields do not change; a null budget removes the limit."""

    name: Name | None = None
    state: RunState | None = None
    budget: Units | None = Field(default=None, description="The highest total cost of the run, in units.")
    priority: int | None = Field(
        default=None,
        ge=-1_000,
        le=1_000,
        description="Queries of a run with a higher priority are handed out first.",
    )
    result: dict[str, Json] | None = Field(default=None, description="The learner's report at the end of the run.")
    gold_rate: GoldRate | None = None
    second_answers: SecondShare | None = None


class Run(Message):
    """A run and its account, sent by the server. `spent + reserved <= budget` holds at all times."""

    id: str
    name: str
    algorithm: str
    seed: int
    state: RunState
    vocabulary: Vocabulary
    config: dict[str, Json] = Field(description="All values that determine the run.")
    prices: Prices
    budget: float | None = Field(description="The highest total cost of the run, in units; null for no limit.")
    reserved: float = Field(description="The units reserved for unanswered queries.")
    spent: float = Field(description="The units spent on answered queries.")
    priority: int = Field(description="Queries of a run with a higher priority are handed out first.")
    episodes: int | None = Field(description="The planned number of episodes; null if unknown.")
    episodes_done: int = Field(description="The number of reported episodes.")
    success_rate: float | None = Field(
        description="The success rate over the trailing 100 test episodes, 0 to 1; null before the first."
    )
    open_queries: int = Field(description="The number of unanswered queries.")
    gold_rate: float = Field(description="The share of gold queries among an annotator's queries, 0 to 0.5.")
    second_answers: SecondShare = 0
    result: dict[str, Json] | None = Field(description="The learner's report at the end of the run.")
    created_at: float = Field(description="When the run was created, in seconds since the epoch.")
    finished_at: float | None = Field(description="When the run finished, in seconds since the epoch.")


RunSort = Literal["newest", "name", "algorithm", "episodes", "success", "cost"]


class RunList(Message):
    """One page of runs, sent by the server."""

    runs: list[Run]
    total: int = Field(description="The number of runs on all pages.")


class Attempt(Message):
    """A segment from whose outcome a subgoal's Q-function learns."""

    subgoal: Name
    reached: bool = Field(description="Whether the segment ended at the subgoal.")


class EpisodeResult(Message):
    """The result of one episode, sent by the learner.

    Sending it again changes nothing, if all fields except `seconds` are the same.
    """

    episode: int = Field(ge=0, le=2**31 - 1, description="The number of the episode, from 0.")
    warm_start: bool = Field(description="Whether the episode was a demonstration instead of a rollout.")
    train_success: bool | None = Field(description="Whether the training rollout succeeded; null for a demonstration.")
    test_success: bool | None = Field(
        description="Whether the test rollout on an unseen instance succeeded; null if there was none."
    )
    train_steps: int = Field(ge=0, description="The learner's steps in the training rollout.")
    test_steps: int = Field(ge=0, description="The learner's steps in the test rollout.")
    reward: float = Field(
        default=0, allow_inf_nan=False, description="The sum of the environment's rewards in the training rollout."
    )
    attempts: list[Attempt] = Field(
        default_factory=list, max_length=10_000, description="The attempts at subgoals, where Q-functions learn them."
    )
    hi_labels: int = Field(ge=0, description="The size of D_HI after the episode.")
    lo_labels: int = Field(ge=0, description="The size of all D_g together (flat learner: of D) after the episode.")
    seconds: float = Field(
        ge=0, allow_inf_nan=False, description="The learner's wall time for the episode, in seconds."
    )


class EpisodeList(Message):
    """Results of episodes, in their order, sent by the learner."""

    episodes: list[EpisodeResult] = Field(min_length=1, max_length=10_000)


class Curves(Message):
    """The curves of a run as columns with one row per reported episode, sent by the server.

    Sums are cumulative and include the episode of the row.
    """

    episode: list[int] = Field(description="The number of the episode, from 0.")
    success_rate: list[float | None] = Field(
        description="The success rate over the trailing 100 test episodes (fewer at the start), 0 to 1."
    )
    test_success: list[bool | None] = Field(description="Whether the test rollout succeeded; null if there was none.")
    cost: list[float] = Field(description="The total cost, in units.")
    lo_cost: list[float] = Field(description="The cost of LO labels (actions and terminations), in units.")
    seconds: list[float] = Field(description="The annotators' time from lease to answer, in seconds.")
    active_seconds: list[float] = Field(description="The annotators' working time without idle time, in seconds.")
    cost_by_kind: dict[Kind, list[float]] = Field(description="The cost by kind of query, in units.")
    hi_labels: list[int] = Field(description="The size of D_HI.")
    lo_samples: list[int] = Field(description="The number of LO-level steps in training rollouts.")
    learner_seconds: list[float] = Field(description="The learner's wall time, in seconds.")
    reward: list[float | None] = Field(
        description="The mean reward of the trailing 100 training rollouts (fewer at the start); null before the first."
    )
    reached: dict[Name, list[float]] = Field(
        description="By subgoal that a Q-function learns, how many of the trailing 100 attempts reached it, 0 to 1. "
        "Attempts that were not made yet count as failed."
    )


class Milestone(Message):
    """The first time that the success rate over 100 test episodes reached a level."""

    episode: int = Field(description="The number of the episode, from 0.")
    cost: float = Field(description="The total cost up to and including this episode, in units.")


class CostOfKind(Message):
    """The sums of the ledger for one kind of query."""

    queries: int = Field(description="The number of charged answers, without refunded ones.")
    units: float = Field(description="The cost, in units.")
    lo_units: float = Field(description="The part of `units` for LO labels: actions and terminations.")
    seconds: float = Field(description="The time from lease to answer, in seconds.")
    active_seconds: float = Field(description="The annotators' working time without idle time, in seconds.")


class Costs(Message):
    """The sums of a run's ledger, sent by the server."""

    total: float = Field(description="The total cost, in units.")
    lo_total: float = Field(description="The cost of LO labels (actions and terminations), in units.")
    seconds: float = Field(description="The annotators' time from lease to answer, in seconds.")
    active_seconds: float = Field(description="The annotators' working time without idle time, in seconds.")
    by_kind: dict[Kind, CostOfKind]
    reserved: float = Field(description="The units reserved for unanswered queries.")
    budget: float | None = Field(description="The highest total cost of the run, in units; null for no limit.")
    tests: int = Field(description="The number of test rollouts. A level counts as reached from the 100th on.")
    first_at: dict[str, Milestone | None] = Field(
        description='By success level ("0.8", "0.9", "0.95", "0.99"): when it was first reached; null if it was not.'
    )


SuccessLevel = Literal["0.8", "0.9", "0.95", "0.99"]


class ForecastRange(Message):
    """A forecast amount: the median of all possible futures, and the range that holds the middle 80 % of them.

    Null: so many futures do not reach the target that the amount has no end.
    """

    low: float | None = Field(description="In a tenth of the futures it is less.")
    median: float | None = Field(description="In half of the futures it is less.")
    high: float | None = Field(description="In a tenth of the futures it is more.")


class Forecast(Message):
    """When a run will reach a success rate over 100 test episodes, sent by the server.

    Exactly one of `reached`, `too_early` and `more_units` is set.
    """

    target: SuccessLevel = Field(description="The success rate.")
    reached: Milestone | None = Field(description="When the run reached the target; null if it has not yet.")
    too_early: str | None = Field(description="Why there is no forecast yet, as a sentence; null if there is one.")
    more_units: ForecastRange | None = Field(description="How many more units the run needs.")
    more_seconds: ForecastRange | None = Field(
        description="The annotators' working time for these units, at the pace of the last answers by people; null if "
        "there were none."
    )
    missed: float | None = Field(description="The share of futures in which the run does not reach the target, 0 to 1.")
    same_configuration: int = Field(description="The number of finished runs used that differ only by their seed.")
    other_configurations: int = Field(
        description="The number of other finished runs used, of the domain and algorithm."
    )


class RunDeletion(Message):
    """What the deletion of a run deleted, or would delete, sent by the server. The counts include its gold queries."""

    run: str = Field(description="The id of the run.")
    dry_run: bool = Field(description="Whether nothing was deleted, because the request only asked.")
    queries: int = Field(description="Queries that lose their content.")
    answers: int = Field(description="Answers that lose their content; their costs and times stay.")
    gold: int = Field(description="Known answers of gold queries.")
    reasons: int = Field(description="Assignments with a reason or the name of a browser tab.")
    comments: int = Field(description="Comments on queries.")
    events: int = Field(description="Events.")
    episodes: int = Field(description="Results of episodes.")
    messages: int = Field(description="Delivered or given up webhook messages.")
    frames: int = Field(description="Pictures that no other run shows.")
    frame_bytes: int = Field(description="The size of these pictures.")
    kept_entries: int = Field(description="Entries of the ledger; they stay.")
    kept_units: float = Field(description="The sum of these entries: what the run has spent, in units.")


class Event(Message):
    """One change of a run, a server-sent event."""

    id: int = Field(description="The cursor: a client that reconnects continues after this id.")
    run: str = Field(description="The id of the run.")
    event: Literal["asked", "answered", "retracted", "used", "cancelled", "episode", "run"]
    at: float = Field(description="When it happened, in seconds since the epoch.")
    data: dict[str, Json]
