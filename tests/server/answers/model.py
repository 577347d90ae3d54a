"""The server against a small pure model, through HTTP: any sequence of calls leaves both in the same state.

The model knows runs' budgets, queries' states and what each answer cost. After every step the run's account, the
ledger and every query must be as the model has them.
"""

from collections import Counter
from dataclasses import dataclass, field
from itertools import count

from hypothesis import HealthCheck, seed, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from tests.server.kit import Json, Service, query, right_answer

PRICE = {"inspect_full": 1, "label_lo": 3, "label_hi": 1, "label_full": 2, "hier_demo": 4}
RESERVE = PRICE | {"hier_demo": 10}
BUDGET = 40
_numbers = count()  # all examples share a server, which remembers pages that have gone


@dataclass
class ModelQuery:
    """One query as the model has it."""

    id: int
    kind: str
    state: str = "open"
    used: bool = False
    assignment: Json | None = None
    holder: int = 0
    page: str = ""  # of the holder
    skipped_by: set[int] = field(default_factory=set)


class Model(RuleBasedStateMachine):
    """Calls chosen at random, each with what the model expects of it."""

    service: Service
    seen: Counter[str]

    @initialize(kinds=st.lists(st.sampled_from(sorted(PRICE)), min_size=3, max_size=5))
    def start(self, kinds: list[str]) -> None:
        self.people = [self.service.annotator, self.service.admin]
        self.run = self.service.learner.create_run(budget=BUDGET)
        self.queries: list[ModelQuery] = []
        self.state = "running"
        self.pages = [f"page-{next(_numbers)}" for _ in self.people]
        for kind in kinds:
            self.ask(kind)

    def those(self, *states: str) -> list[ModelQuery]:
        return [one for one in self.queries if one.state in states]

    @property
    def spent(self) -> int:
        return sum(PRICE[one.kind] for one in self.those("answered"))

    @property
    def reserved(self) -> int:
        return sum(RESERVE[one.kind] for one in self.those("open", "leased"))

    # --- the learner

    @rule(kind=st.sampled_from(sorted(PRICE)))
    def ask(self, kind: str) -> None:
        fits = self.spent + self.reserved + RESERVE[kind] <= BUDGET
        expect = 409 if self.state == "finished" else 200 if fits else 402
        reply = self.service.learner.ask(self.run, query(kind, ordinal=len(self.queries)), expect=expect)
        self.seen[f"asked {expect}"] += 1
        if expect == 200:
            self.queries.append(ModelQuery(reply[0]["id"], kind))

    @precondition(lambda self: self.queries)
    @rule(data=st.data())
    def ask_again(self, data: st.DataObject) -> None:
        place = data.draw(st.integers(0, len(self.queries) - 1))
        (same,) = self.service.learner.ask(self.run, query(self.queries[place].kind, ordinal=place))
        assert (same["id"], same["state"]) == (self.queries[place].id, self.queries[place].state)

    @precondition(lambda self: self.queries)
    @rule(data=st.data())
    def use(self, data: st.DataObject) -> None:
        one = data.draw(st.sampled_from(self.queries))
        self.service.learner.post(f"/queries/{one.id}/use", expect=200 if one.state == "answered" else 409)
        one.used = one.state == "answered"

    @rule(paused=st.booleans())
    def pause(self, paused: bool) -> None:
        wanted = "paused" if paused else "running"
        self.service.learner.patch(self.run, 409 if self.state == "finished" else 200, state=wanted)
        self.state = self.state if self.state == "finished" else wanted

    @precondition(lambda self: len(self.queries) > 5)
    @rule()
    def finish(self) -> None:
        self.service.learner.patch(self.run, state="finished")
        self.state = "finished"
        for one in self.those("open", "leased"):
            one.state = "cancelled"

    # --- the annotators

    @rule(who=st.integers(0, 1), kinds=st.none() | st.sets(st.sampled_from(sorted(PRICE)), min_size=1))
    def lease(self, who: int, kinds: set[str] | None) -> None:
        offered = [one for one in self.those("open") if who not in one.skipped_by and (not kinds or one.kind in kinds)]
        wish = {"run": self.run, "kinds": sorted(kinds) if kinds else None, "tab": self.pages[who]}
        if not offered or self.state != "running":
            self.people[who].lease(expect=204, **wish)
            return
        held = self.people[who].lease(**wish)
        assert held["query"]["id"] == offered[0].id, "the oldest first: there is one episode and one priority"
        offered[0].state, offered[0].assignment = "leased", held
        offered[0].holder, offered[0].page = who, self.pages[who]

    @precondition(lambda self: self.those("leased"))
    @rule(data=st.data(), times=st.integers(1, 2))
    def answer(self, data: st.DataObject, times: int) -> None:
        one = data.draw(st.sampled_from(self.those("leased")))
        assert one.assignment is not None
        content = right_answer(one.assignment["query"]["ask"])
        receipts = [self.people[one.holder].answer(one.assignment, content) for _ in range(times)]
        assert all(receipt == receipts[0] and receipt["units"] == PRICE[one.kind] for receipt in receipts)
        one.state = "answered"

    @rule(who=st.integers(0, 1))
    def lease_and_answer(self, who: int) -> None:
        self.lease(who, None)
        for one in self.those("leased")[:1]:
            assert one.assignment is not None
            self.people[one.holder].answer(one.assignment)
            one.state = "answered"

    @precondition(lambda self: self.those("cancelled", "answered"))
    @rule(data=st.data())
    def answer_otherwise(self, data: st.DataObject) -> None:
        one = data.draw(st.sampled_from(self.those("cancelled", "answered")))
        if one.assignment is None:
            return
        changed = right_answer(one.assignment["query"]["ask"])
        changed = {key: ("fail" if value == "pass" else value) for key, value in changed.items()}
        same = changed == right_answer(one.assignment["query"]["ask"])
        accepted = same and one.state == "answered"
        self.people[one.holder].answer(one.assignment, changed, expect=200 if accepted else 409)

    @precondition(lambda self: self.those("leased"))
    @rule(data=st.data(), skip=st.booleans())
    def release(self, data: st.DataObject, skip: bool) -> None:
        one = data.draw(st.sampled_from(self.those("leased")))
        assert one.assignment is not None
        self.people[1 - one.holder].release(one.assignment, expect=403)
        self.people[one.holder].release(one.assignment, skip=skip)
        one.state, one.assignment = "open", None
        one.skipped_by |= {one.holder} if skip else set()

    @rule(who=st.integers(0, 1), keep=st.booleans())
    def leave(self, who: int, keep: bool) -> None:
        held = [one for one in self.those("leased") if one.page == self.pages[who]]
        kept = held[:1] if keep else []
        self.people[who].leave(self.pages[who], *(one.assignment for one in kept if one.assignment))
        for one in held[len(kept) :]:
            one.state, one.assignment = "open", None
        self.people[who].lease(expect=204, run=self.run, tab=self.pages[who])
        self.pages[who] = f"page-{next(_numbers)}"
        self.seen["left holding some"] += len(held) > len(kept)

    @rule(who=st.integers(0, 1))
    def lease_and_leave(self, who: int) -> None:
        self.lease(who, None)
        self.leave(who, keep=False)

    @rule(who=st.integers(0, 1), used=st.booleans())
    def lease_answer_and_retract(self, who: int, used: bool) -> None:
        self.lease_and_answer(who)
        for one in self.those("answered")[-1:]:
            self._retract(one, used)

    @precondition(lambda self: self.those("answered"))
    @rule(data=st.data(), used=st.booleans())
    def retract(self, data: st.DataObject, used: bool) -> None:
        self._retract(data.draw(st.sampled_from(self.those("answered"))), used)

    def _retract(self, one: ModelQuery, used: bool) -> None:
        assert one.assignment is not None
        if used:
            self.service.learner.post(f"/queries/{one.id}/use")
            one.used = True
        fits = self.spent + self.reserved + RESERVE[one.kind] - PRICE[one.kind] <= BUDGET
        refused = 409 if one.used or self.state == "finished" else 200 if fits else 402
        again = self.people[one.holder].retract(one.assignment, expect=refused, tab=self.pages[one.holder])
        self.seen[f"retracted {refused}"] += 1
        if refused == 200:
            one.state, one.assignment, one.page = "leased", again, self.pages[one.holder]

    # --- what always holds

    @invariant()
    def the_account_is_the_models(self) -> None:
        run = self.service.learner.get(f"/runs/{self.run}")
        assert (run["spent"], run["reserved"], run["state"]) == (self.spent, self.reserved, self.state)
        assert run["spent"] + run["reserved"] <= BUDGET

    @invariant()
    def the_ledger_is_answers_times_cost(self) -> None:
        costs = self.service.learner.costs(self.run)
        assert costs["total"] == self.spent
        for kind, price in PRICE.items():
            n = len([one for one in self.those("answered") if one.kind == kind])
            assert (costs["by_kind"][kind]["queries"], costs["by_kind"][kind]["units"]) == (n, n * price)

    @invariant()
    def every_query_is_as_the_model_has_it(self) -> None:
        found = self.service.learner.get(f"/runs/{self.run}/queries", params={"limit": 500})["queries"]
        assert [(one["id"], one["state"], one["used"]) for one in reversed(found)] == [
            (one.id, one.state, one.used) for one in self.queries
        ]


def run_schedules(service: Service, many: int, steps: int, chosen_by: int | None = None) -> Counter[str]:
    """Run sequences of calls, all against one service, whose `follow_up_seconds` must be 0: the model has no clock.

    Args:
        many: how many sequences.
        steps: how many calls one has at most.
        chosen_by: the seed; without one, they are the same each time.

    Returns:
        How often some of the rarer calls were made.

    Raises:
        AssertionError: server and model differ; Hypothesis prints the shortest sequence that it found.
    """
    seen: Counter[str] = Counter()
    machine: type[Model] = type("Machine", (Model,), {"service": service, "seen": seen})
    how = settings(
        max_examples=many,
        stateful_step_count=steps,
        deadline=None,
        database=None,
        derandomize=chosen_by is None,
        suppress_health_check=list(HealthCheck),
    )
    run_state_machine_as_test(machine if chosen_by is None else seed(chosen_by)(machine), settings=how)
    return seen
