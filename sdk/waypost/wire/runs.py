"""Runs, their curves and costs."""

from typing import Literal

from pydantic import Field, JsonValue

from waypost.wire.words import GoldRate, Kind, Message, Name, RunState, Units

__all__ = [
    "CostOfKind",
    "Costs",
    "Curves",
    "EpisodeList",
    "EpisodeResult",
    "Event",
    "Milestone",
    "Prices",
    "Run",
    "RunCreate",
    "RunList",
    "RunPatch",
    "RunSort",
    "Vocabulary",
]


class Prices(Message):
    """What one label costs, in units, to six decimals. The paper: Label = length of what is labeled, Inspect = 1."""

    subgoal: Units = Field(default=1.0, description="One HI label: a subgoal at a state.")
    action: Units = Field(default=1.0, description="One LO label: an action at a state.")
    termination: Units = Field(default=1.0, description="The termination label of a segment's last state.")
    inspect_full: Units = 1.0
    inspect_lo: Units = 1.0


class Vocabulary(Message):
    """A domain's names, in the order of its own numbering, and how the page draws it."""

    domain: Name
    subgoals: list[Name] = Field(max_length=1_000, description="Empty for a domain without subgoals.")
    actions: list[Name] = Field(min_length=1, max_length=1_000)
    renderer: Name = Field(description="Which of the page's renderers draws its instances and states.")


class RunCreate(Message):
    """What a learner says of itself before it asks."""

    name: Name
    algorithm: Name
    seed: int = Field(ge=0, le=2**63 - 1)
    vocabulary: Vocabulary
    config: dict[str, JsonValue] = Field(default_factory=dict, description="Every value that fixes the run.")
    prices: Prices = Field(default_factory=Prices)
    budget: Units | None = Field(default=None, description="Most units the run may ever cost; null for no limit.")
    episodes: int | None = Field(default=None, ge=1, le=10**9, description="How many episodes are planned.")


class RunPatch(Message):
    """What may change in a run; absent fields stay as they are, and a null budget lifts it."""

    name: Name | None = None
    state: RunState | None = None
    budget: Units | None = None
    priority: int | None = Field(
        default=None, ge=-1_000, le=1_000, description="Queries of a run with a higher one are handed out first."
    )
    result: dict[str, JsonValue] | None = Field(default=None, description="What the learner reports at its end.")
    gold_rate: GoldRate | None = None


class Run(Message):
    """A run and where its money is: `spent + reserved <= budget`, always."""

    id: str
    name: str
    algorithm: str
    seed: int
    state: RunState
    vocabulary: Vocabulary
    config: dict[str, JsonValue]
    prices: Prices
    budget: float | None
    reserved: float = Field(description="Units held for queries asked and not yet answered.")
    spent: float
    priority: int = Field(description="Queries of a run with a higher one are handed out first.")
    episodes: int | None
    episodes_done: int
    success_rate: float | None = Field(description="Over the trailing 100 test episodes; null before the first.")
    open_queries: int
    gold_rate: float
    result: dict[str, JsonValue] | None
    created_at: float
    finished_at: float | None


RunSort = Literal["newest", "name", "algorithm", "episodes", "success", "cost"]


class RunList(Message):
    """A page of runs."""

    runs: list[Run]
    total: int = Field(description="How many there are on all pages.")


class EpisodeResult(Message):
    """What one episode brought. Reporting it again, the seconds aside with the same content, changes nothing."""

    episode: int = Field(ge=0, le=2**31 - 1)
    warm_start: bool = Field(description="Whether this was a demonstration rather than a rollout.")
    train_success: bool | None = Field(description="Did the training rollout succeed? Null for a demonstration.")
    test_success: bool | None = Field(description="Did the test rollout on an unseen instance succeed?")
    train_steps: int = Field(ge=0)
    test_steps: int = Field(ge=0)
    hi_labels: int = Field(ge=0, description="Size of D_HI after the episode.")
    lo_labels: int = Field(ge=0, description="Size of all D_g (flat: of D) after the episode.")
    seconds: float = Field(ge=0, allow_inf_nan=False, description="The learner's wall time for the episode.")


class EpisodeList(Message):
    """Results to report, in episode order."""

    episodes: list[EpisodeResult] = Field(min_length=1, max_length=10_000)


class Curves(Message):
    """Columns of equal length, a row per reported episode; sums are cumulative up to and with that episode."""

    episode: list[int]
    success_rate: list[float | None] = Field(description="Over the trailing 100 test episodes (fewer at the start).")
    test_success: list[bool | None]
    cost: list[float]
    lo_cost: list[float] = Field(description="Units spent on LO labels: actions and terminations.")
    seconds: list[float] = Field(description="Annotators' seconds, from lease to answer.")
    active_seconds: list[float] = Field(description="Annotators' own time, without idle time.")
    cost_by_kind: dict[Kind, list[float]]
    hi_labels: list[int] = Field(description="Size of D_HI.")
    lo_samples: list[int] = Field(description="LO-level steps taken in training rollouts.")
    learner_seconds: list[float] = Field(description="The learner's wall time.")


class Milestone(Message):
    """When the success rate over 100 test episodes first reached a level."""

    episode: int
    cost: float


class CostOfKind(Message):
    """The ledger's sum for one kind of query."""

    queries: int
    units: float
    lo_units: float
    seconds: float
    active_seconds: float


class Costs(Message):
    """The ledger of a run."""

    total: float
    lo_total: float
    seconds: float
    active_seconds: float
    by_kind: dict[Kind, CostOfKind]
    reserved: float
    budget: float | None
    first_at: dict[str, Milestone | None] = Field(description='By success level: "0.8", "0.9", "0.95", "0.99".')


class Event(Message):
    """One change of a run, as sent by server-sent events; `id` is the cursor to go on from."""

    id: int
    run: str
    event: Literal["asked", "answered", "retracted", "used", "cancelled", "episode", "run"]
    at: float
    data: dict[str, JsonValue]
