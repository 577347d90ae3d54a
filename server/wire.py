"""Every message that crosses HTTP, and nothing else: pydantic and the standard library only.

The server and the learner's client both import this module, and the page's TypeScript types are generated from it
(through the OpenAPI document), so there is one contract. Words are the paper's: a *segment* is one (s_h, g_h, tau_h),
a subgoal and the LO-level trajectory that carried it out (Le et al. 2018, section 3).

Subgoals and actions travel by name (a run declares both lists); states and instances travel as the domain's own JSON
view, which the server stores without looking inside. Times are seconds since the epoch; costs are units (the price
of one label, unless the run sets others).
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, JsonValue

Kind = Literal["hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full"]
Verdict = Literal["pass", "fail"]
RunState = Literal["running", "paused", "finished"]
QueryState = Literal["open", "leased", "answered", "cancelled"]
Role = Literal["admin", "learner", "annotator", "viewer"]

Name = Annotated[str, Field(min_length=1, max_length=100, pattern=r"^[^\x00-\x1f\x7f]+$")]
Note = Annotated[str, Field(max_length=500, pattern=r"^[^\x00]*$")]
GoldRate = Annotated[
    float, Field(ge=0, le=0.5, allow_inf_nan=False, description="Share of an annotator's queries that are gold.")
]
Units = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]
FrameHash = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$", description="The SHA-256 of a PNG, in hexadecimal.")]


class Message(BaseModel):
    """What all messages share: unknown fields and lax conversions (`"3"` for 3) are refused."""

    model_config = ConfigDict(extra="forbid", strict=True, json_schema_serialization_defaults_required=True)


# --- answers: what an annotator returns ----------------------------------------------------------------------------


class DemoSegment(Message):
    """One segment of a demonstration; its states follow from the actions."""

    subgoal: Name | None = Field(description="The subgoal carried out; null in a flat demonstration.")
    actions: list[Name] = Field(min_length=1, max_length=10_000)


class HierDemoAnswer(Message):
    """The expert's own trajectory: hierarchical, each segment ending where its subgoal is reached; or one flat one."""

    kind: Literal["hier_demo"]
    segments: list[DemoSegment] = Field(min_length=1, max_length=10_000)


class InspectAnswer(Message):
    """Pass or Fail, for Inspect_FULL and Inspect_LO."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict


class LabelHiAnswer(Message):
    """g*_1 .. g*_n: a good subgoal for each segment of the query."""

    kind: Literal["label_hi"]
    subgoals: list[Name] = Field(max_length=10_000)


class LabelLoAnswer(Message):
    """a*_1 .. a*_H and omega*_1 .. omega*_{H+1} of one segment with H actions.

    Labels count up to the first true termination. An action may be null only there and after it: the segment should
    have ended, so no action toward the subgoal is good.
    """

    kind: Literal["label_lo"]
    actions: list[Name | None] = Field(max_length=10_000)
    terminations: list[bool] = Field(max_length=10_001)


class LabelFullAnswer(Message):
    """a*_1 .. a*_H over the joined segments."""

    kind: Literal["label_full"]
    actions: list[Name] = Field(max_length=100_000)


Answer = Annotated[
    HierDemoAnswer | InspectAnswer | LabelHiAnswer | LabelLoAnswer | LabelFullAnswer,
    Field(discriminator="kind"),
]


# --- queries: what the learner asks ------------------------------------------------------------------------------


class Segment(Message):
    """One (s_h, g_h, tau_h) of the learner's hierarchical trajectory."""

    subgoal: Name | None = Field(description="The subgoal the learner pursued; null for a flat policy.")
    states: list[JsonValue] = Field(max_length=10_000, description="s_1 .. s_{H+1}, in the domain's JSON view.")
    actions: list[Name] = Field(max_length=10_000, description="a_1 .. a_H, one fewer than the states.")
    frames: list[FrameHash] = Field(
        default_factory=list,
        max_length=10_000,
        description="A picture of each state, uploaded before; none where the page draws the states itself. Pictures "
        "are not part of what is asked: asking again with others changes nothing.",
    )


class AskBase(Message):
    """What every query carries, whatever its kind."""

    episode: int = Field(ge=0, le=2**31 - 1, description="Which episode of the run asks.")
    ordinal: int = Field(ge=0, le=2**31 - 1, description="Which query of that episode this is, from 0.")
    question: str = Field(max_length=500, description="The question in words, for a person.")
    instance: JsonValue = Field(description="The environment instance, in the domain's JSON view.")
    context: list[Segment] = Field(
        default_factory=list, max_length=1_000, description="Segments that came before, shown but not asked about."
    )
    suggestion: Answer | None = Field(
        default=None,
        description="The learner's own choice, as an answer to this query; what it did, not what is right.",
    )


class AskHierDemo(AskBase):
    """HierDemo(s): carry out the task from state s and return the hierarchical trajectory, or a flat learner's."""

    kind: Literal["hier_demo"]
    state: JsonValue = Field(description="s, where the demonstration starts.")
    flat: bool = Field(default=False, description="Only actions are wanted: one segment without a subgoal.")
    max_segments: int = Field(ge=1, le=10_000, description="H_HI: a demonstration has at most so many segments.")
    max_actions: int = Field(ge=1, le=10_000, description="H_FULL: and at most so many actions in all.")


class AskInspectFull(AskBase):
    """Inspect_FULL(tau_FULL): was the overall goal accomplished?"""

    kind: Literal["inspect_full"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


class AskLabelHi(AskBase):
    """Label_HI(tau_HI): a good subgoal at the first state of each segment."""

    kind: Literal["label_hi"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


class AskInspectLo(AskBase):
    """Inspect_LO(tau; g): did this one segment accomplish its subgoal?"""

    kind: Literal["inspect_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1)


class AskLabelLo(AskBase):
    """Label_LO(tau; g): a good action at each state of this one segment, and where it should have ended."""

    kind: Literal["label_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1)


class AskLabelFull(AskBase):
    """Label_FULL(tau_FULL): a good action at each state of the full trajectory."""

    kind: Literal["label_full"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


Ask = Annotated[
    AskHierDemo | AskInspectFull | AskLabelHi | AskInspectLo | AskLabelLo | AskLabelFull,
    Field(discriminator="kind"),
]


class Query(Message):
    """A query as everybody sees it: what was asked, where it stands, and its answer once it has one."""

    id: int
    run: str
    state: QueryState
    priority: int
    created_at: float
    ask: Ask
    answer: Answer | None
    answer_id: int | None
    used: bool = Field(description="Whether the learner has used the answer; then it can be retracted no more.")
    annotator: str | None = Field(description="Who answered, or who holds it now.")
    units: float | None = Field(description="What the answer cost.")
    seconds: float | None = Field(description="From lease to answer, by the server's clock.")
    active_seconds: float | None = Field(description="The annotator's own time for it, without idle time.")


class Asked(Message):
    """The reply to `POST /runs/{id}/queries`: the queries in the order asked, old ones with their answers."""

    queries: list[Query]


class AskList(Message):
    """One or more queries of one run. Asking again with the same (episode, ordinal) and content changes nothing."""

    queries: list[Ask] = Field(min_length=1, max_length=1_000)
    priority: int = Field(default=0, ge=-1_000, le=1_000, description="Higher is handed out first.")


class QueryList(Message):
    """Queries of a run, newest first; `before` the last one's id goes on."""

    queries: list[Query]


class AnswerPage(Message):
    """Answers in the order they were given, after a cursor; `cursor` is where to go on."""

    queries: list[Query]
    cursor: int


# --- frames: pictures of states, where the page has no renderer -----------------------------------------------------


class Frame(Message):
    """A PNG and the hash that it goes by."""

    hash: FrameHash
    png: str = Field(min_length=1, max_length=2**23, pattern=r"^[A-Za-z0-9+/]+=*$", description="The file in base64.")


class FrameUpload(Message):
    """Frames to keep. Uploading one again changes nothing."""

    frames: list[Frame] = Field(min_length=1, max_length=1_000)


class FrameHashes(Message):
    """Frames by their hashes."""

    hashes: list[FrameHash] = Field(max_length=10_000)


# --- runs -----------------------------------------------------------------------------------------------------------


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


# --- curves and costs -----------------------------------------------------------------------------------------------


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


# --- watching: what whoever looks at a run leafs through ------------------------------------------------------------

AssignmentState = Literal["live", "answered", "skipped", "released", "expired", "cancelled"]
LedgerEntryKind = Literal["charge", "refund"]
ExportTable = Literal["curves", "ledger", "queries"]
ExportFormat = Literal["csv", "jsonl"]


class QueryRow(Message):
    """A query in a table: what was asked and what came of it, without the trajectory."""

    id: int
    episode: int
    ordinal: int
    kind: Kind
    state: QueryState
    priority: int
    question: str
    created_at: float
    answered_at: float | None
    answer: Answer | None
    used: bool
    annotator: str | None = Field(description="Who answered, or who holds it now.")
    units: float | None
    seconds: float | None
    skips: int = Field(description="How often it was skipped.")
    expiries: int = Field(description="How many of its leases ran out.")


class QueryPage(Message):
    """A page of a run's queries, newest first."""

    rows: list[QueryRow]
    total: int = Field(description="How many there are on all pages.")
    newest: int | None = Field(description="The newest of them on any page.")
    oldest: int | None = Field(description="The oldest of them on any page.")


class LedgerEntry(Message):
    """One line of the ledger: a charge, or a refund with its amounts below zero."""

    id: int
    at: float
    entry: LedgerEntryKind
    kind: Kind
    query: int
    episode: int
    ordinal: int
    annotator: str
    units: float
    lo_units: float
    seconds: float
    balance: float = Field(description="What the run had spent after this line.")


class LedgerPage(Message):
    """A page of a run's ledger, newest first, and the sums of all its pages."""

    entries: list[LedgerEntry]
    total: int = Field(description="How many lines there are on all pages.")
    newest: int | None = Field(description="The newest of them on any page.")
    oldest: int | None = Field(description="The oldest of them on any page.")
    units: float
    lo_units: float
    seconds: float
    spent: float = Field(description="What the run's account says; without a filter, `units` is the same.")


class PastAnswer(Message):
    """An answer as it was given; never changed."""

    id: int
    content: Answer
    at: float
    units: float = Field(description="What it was charged; 0 if it came too late.")
    seconds: float
    fate: Literal["counts", "retracted", "late"]


class PastAssignment(Message):
    """One time a query was handed out, and how that ended."""

    id: int
    annotator: str
    state: AssignmentState
    reason: str | None = Field(description="What was said when it was skipped or given back.")
    leased_at: float
    expires_at: float
    ended_at: float | None
    answer: PastAnswer | None


class QueryHistory(Message):
    """Everything that became of a query, oldest first, and its neighbors in its run."""

    assignments: list[PastAssignment]
    ledger: list[LedgerEntry]
    previous: int | None = Field(description="The query asked before it in the run, by episode and ordinal.")
    next: int | None


class Holding(Message):
    """A query somebody holds right now."""

    query: int
    run: str
    kind: Kind
    episode: int
    leased_at: float


class AtWork(Message):
    """An annotator who asked for work of late or holds a query."""

    annotator: str
    run: str | None = Field(description="The run asked for; null for any.")
    kinds: list[Kind] | None = Field(description="The kinds asked for; null for any.")
    seen_at: float
    holds: list[Holding]


class AtWorkList(Message):
    """Who is at work, the one seen last first."""

    annotators: list[AtWork]


class Change(Message):
    """Something changed in some run, as sent by server-sent events."""

    newest: int = Field(description="The newest event of any run.")


# --- assignments ----------------------------------------------------------------------------------------------------


class Lease(Message):
    """What an annotator is willing to take."""

    wait: float = Field(default=0, ge=0, le=60, allow_inf_nan=False, description="Wait so long for a query, seconds.")
    kinds: list[Kind] | None = Field(default=None, description="Only these kinds; null for all.")
    run: str | None = Field(default=None, description="Only this run; null for all.")
    defer: float = Field(
        default=0,
        ge=0,
        le=3_600,
        allow_inf_nan=False,
        description="Leave a query this many seconds to other annotators who are at work and take its kind. A bot that "
        "helps people sets it; nobody else need.",
    )
    ahead: bool = Field(
        default=False,
        description="To be answered after what the annotator holds already: only while enough queries are left for "
        "everybody else at work.",
    )


class Assignment(Message):
    """One query handed to one annotator under a lease. Only `token` and an unexpired lease can answer it."""

    id: int
    token: str
    query: Query
    run: Run
    leased_at: float
    expires_at: float
    lease_seconds: float


class AssignmentList(Message):
    """The caller's live assignments, oldest first: what a reloaded page goes on with."""

    assignments: list[Assignment]


class AnswerPost(Message):
    """An answer. Sending it again (same assignment, same content) returns the same receipt and costs nothing."""

    token: str = Field(max_length=200)
    answer: Answer
    next: Lease | None = Field(default=None, description="Lease the next query in the same call; null for none.")


class Receipt(Message):
    """The answer is on disk and charged."""

    query: int
    answer: int
    units: float
    seconds: float
    active_seconds: float
    next: Assignment | None


class TokenPost(Message):
    """Shows that the caller holds the lease."""

    token: str = Field(max_length=200)


class Renew(TokenPost):
    """A heartbeat."""

    active: bool = Field(
        default=False, description="The annotator did something since the last one: pressed, pointed, scrolled."
    )


class Release(Message):
    """Give a query back, unanswered."""

    token: str = Field(max_length=200)
    reason: Note = Field(default="", description='Why; "" when only making room for others.')
    skip: bool = Field(default=False, description="True: do not offer it to this annotator again.")


class Renewal(Message):
    """The lease after a heartbeat."""

    expires_at: float


# --- playing a demonstration: the messages of `WS /queries/{id}/play` ----------------------------------------------


class PlayTake(Message):
    """An annotator's first message: shows that it holds the query's live assignment."""

    type: Literal["take"]
    assignment: int = Field(ge=1, le=2**63 - 1)
    token: str = Field(max_length=200)


class PlayOffer(Message):
    """A learner's first message: it offers the query's environment."""

    type: Literal["offer"]


PlayHello = Annotated[PlayTake | PlayOffer, Field(discriminator="type")]


class PlayMoves(Message):
    """Annotator to learner: the whole demonstration as it stands, so that neither end must remember the other's past.

    What changed since the last message, and in which direction, is for the learner to see.
    """

    type: Literal["moves"]
    number: int = Field(ge=0, le=2**53 - 1, description="Counts these messages; the reply repeats it.")
    segments: list[DemoSegment] = Field(max_length=10_000, description="As in the answer; none before the first move.")
    known: int = Field(ge=0, le=10_001, description="States s_1 .. s_known need not be sent, the annotator has them.")


class PlayStates(Message):
    """Learner to annotator: what the environment made of the moves."""

    type: Literal["states"]
    number: int = Field(ge=0, le=2**53 - 1)
    known: int = Field(ge=0, le=10_001, description="How many states come before these.")
    states: list[JsonValue] = Field(
        max_length=10_001,
        description="The states after those, in the domain's JSON view, up to the episode's end.",
    )
    frames: list[FrameHash] = Field(
        default_factory=list,
        max_length=10_001,
        description="A picture of each of these, uploaded before; none where the page draws the states itself.",
    )
    ended: bool = Field(description="Whether the episode ended in the last state; actions after it have no state.")
    succeeded: bool = Field(description="Whether the whole task is accomplished in the last state.")


class PlayStage(Message):
    """Server to annotator: whether a learner offers the environment just now."""

    type: Literal["stage"]
    present: bool


# --- people ---------------------------------------------------------------------------------------------------------


class Login(Message):
    """A one-time code out of a login link."""

    code: str = Field(min_length=1, max_length=200)


class Me(Message):
    """Who is calling."""

    id: int
    name: str
    role: Role
    answers: int = Field(description="Answers that counted.")
    answers_today: int
    median_seconds: float | None
    units: float = Field(description="What these answers cost, in all runs.")


class UserCreate(Message):
    """A person or a program that may call."""

    name: Name
    role: Role


class UserPatch(Message):
    """What may change in a user; absent fields stay as they are."""

    role: Role | None = None
    active: bool | None = Field(
        default=None,
        description="False ends their sessions, tokens, links and leases; their answers stay.",
    )


class User(Message):
    """A user, without secrets."""

    id: int
    name: str
    role: Role
    created_at: float
    deactivated_at: float | None = Field(description="Since when they may not call; null while they may.")
    last_used_at: float | None = Field(description="When they last called, to the minute.")


class UserList(Message):
    """All users."""

    users: list[User]


class TokenCreate(Message):
    """An API token for the caller, or, made by an administrator, for any user."""

    user: int | None = Field(default=None, ge=1, le=2**63 - 1, description="Whose; null for the caller's own.")
    label: Note = ""


class NewToken(Message):
    """A token, shown once; the server keeps only its hash."""

    id: int
    token: str


class Token(Message):
    """A token that is good, without its secret."""

    id: int
    label: str
    created_at: float
    last_used_at: float | None = Field(description="To the minute; null if never.")


class TokenList(Message):
    """A user's tokens that are good, oldest first."""

    tokens: list[Token]


class Session(Message):
    """A browser that is signed in."""

    id: int
    created_at: float
    last_used_at: float | None
    expires_at: float
    current: bool = Field(description="Whether this is the session that asks.")


class SessionList(Message):
    """The caller's sessions, oldest first."""

    sessions: list[Session]


class LoginLinkCreate(Message):
    """How long a new login link is to be good."""

    seconds: float | None = Field(
        default=None, ge=60, le=7 * 86_400, allow_inf_nan=False, description="Null for the server's usual time."
    )


class LoginLink(Message):
    """A one-time login link's code, shown once."""

    code: str
    expires_at: float


class Tally(Message):
    """What answers come to. Gold queries are among them: they are work too, though no run pays for them."""

    answers: int
    units: float


class NumbersOfKind(Message):
    """An annotator's answers to one kind of query."""

    kind: Kind
    total: Tally
    median_seconds: float
    gold: int = Field(description="How many of them were to gold queries.")
    gold_right: int = Field(description="How many of those were right in every label.")
    agreement: float | None = Field(description="The share of right labels among those of gold queries.")


class Numbers(Message):
    """An annotator's own numbers, over all runs. Days are those of UTC."""

    user: int
    name: str
    total: Tally
    today: Tally
    week: Tally = Field(description="Today and the six days before.")
    gold: int
    agreement: float | None
    by_kind: list[NumbersOfKind] = Field(description="The kinds they have answered.")


class NumbersList(Message):
    """Everybody's numbers who ever answered, by name."""

    annotators: list[Numbers]


# --- gold queries and practice ---------------------------------------------------------------------------------------


class KnownVerdict(Message):
    """What an inspection should say."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict


Choices = Annotated[list[Name], Field(min_length=1, max_length=1_000)]


class KnownSubgoals(Message):
    """The subgoals that are right, for each segment."""

    kind: Literal["label_hi"]
    subgoals: list[Choices] = Field(max_length=10_000)


class KnownSegment(Message):
    """The actions that are right, for each state before the segment should end."""

    kind: Literal["label_lo"]
    actions: list[Choices] = Field(max_length=10_000)
    end: int | None = Field(ge=0, le=10_000, description="The state it should end in, from 0; null if in none of them.")


class KnownActions(Message):
    """The actions that are right, for each state of the full trajectory."""

    kind: Literal["label_full"]
    actions: list[Choices] = Field(max_length=100_000)


Known = Annotated[KnownVerdict | KnownSubgoals | KnownSegment | KnownActions, Field(discriminator="kind")]


class KnownAsk(Message):
    """A query and what is right: for each label all that is, where several choices are as good."""

    ask: Ask
    known: Known


class GoldPost(Message):
    """Queries to be gold in a run. What is gold already stays as it is."""

    answered: list[int] = Field(
        default_factory=list, max_length=1_000, description="Queries of this run; right is just what was answered."
    )
    known: list[KnownAsk] = Field(default_factory=list, max_length=1_000)


class Gold(Message):
    """A gold query, and what annotators made of it."""

    id: int
    kind: Kind
    question: str
    known: Known
    query: int | None = Field(description="The query it was marked from.")
    author: str | None = Field(description="Who answered that; it is never put to them.")
    answers: int
    agreement: float | None = Field(description="The share of right labels over all annotators.")
    created_at: float


class GoldList(Message):
    """The gold queries of a run, newest first."""

    gold: list[Gold]


class Mark(Message):
    """One label of an answer, beside what is right there."""

    place: int = Field(description="Which label, from 0; of a segment's actions and its end, which state.")
    given: str | None = Field(description='"(done)" and "(not done)" are the two labels of a segment\'s end.')
    right: list[str] = Field(description="All that is right there.")
    is_right: bool


class PracticeQuery(Message):
    """A query to practice on."""

    id: int
    ask: Ask


class Practice(Message):
    """Queries whose answers are known, in the order to meet them. Practicing stores nothing and costs nothing."""

    vocabulary: Vocabulary
    queries: list[PracticeQuery]


class PracticeAnswer(Message):
    """An answer given for practice."""

    answer: Answer


class Feedback(Message):
    """How good an answer was, label by label."""

    marks: list[Mark]
    reasons: list[str] = Field(description="Why, for each label.")
    is_right: bool = Field(description="Whether all of them are right.")


class Health(Message):
    """Alive, or ready to work."""

    status: Literal["ok"]
    version: str


class Problem(BaseModel):
    """RFC 9457: what was wrong and what to do about it."""

    type: str = Field(description="A stable name of the problem: `/problems/<name>`.")
    title: str
    status: int
    detail: str
    instance: str | None = None
    errors: list[dict[str, JsonValue]] | None = Field(default=None, description="For 422: each field at fault.")
