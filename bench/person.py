"""Estimates a person's work in a run until a success rate was reached, in keys, decisions and minutes.

Run `python bench/person.py RUN --store FILE`. For each answer in the store, the script counts the fewest keys that give
it in the web app (docs/annotator.md), and the decisions that it needs. Minutes are the time to watch plus a fixed
number of seconds per decision, both defined below. The script prints a table and asserts nothing.
"""

import argparse
from collections import Counter, defaultdict
from pathlib import Path

from waypost import wire
from waypost.client import Client
from waypost_learner.remote.embedded import embedded

WATCHING = 3.0  # seconds to watch a query, when the web app plays the episode at its normal speed
SECONDS: dict[wire.Kind, float] = {  # seconds per decision
    "hier_demo": 0.6,
    "inspect_full": 0.5,
    "inspect_lo": 0.5,
    "label_hi": 1.5,
    "label_lo": 1.0,
    "label_full": 1.0,
}


def effort(ask: wire.Ask, answer: wire.Answer) -> tuple[int, int]:
    """Return the number of keys and the number of decisions of an answer."""
    segments = [] if ask.kind == "hier_demo" else ask.segments
    match answer:
        case wire.InspectAnswer():
            return 1, 1
        case wire.LabelHiAnswer():
            own = [segment.subgoal for segment in segments]
            return _last_change(own, answer.subgoals) + 1, len(own)
        case wire.LabelLoAnswer():
            n = answer.terminations.index(True) + 1 if True in answer.terminations else len(answer.actions)
            ends_early = True in answer.terminations[:-1]
            return (n if ends_early else _last_change(segments[0].actions, answer.actions)) + 1, n
        case wire.LabelFullAnswer():
            own = [action for segment in segments for action in segment.actions]
            return _last_change(own, answer.actions) + 1, len(own)
        case wire.HierDemoAnswer():
            n = sum(len(segment.actions) for segment in answer.segments)
            return n + 2 * len(answer.segments) + 1, n + 2 * len(answer.segments)


def seconds_of(ask: wire.Ask, answer: wire.Answer) -> float:
    """Return the seconds that an answer takes: the time to watch, and a time per decision."""
    watching = 0 if ask.kind == "hier_demo" else WATCHING
    return watching + effort(ask, answer)[1] * SECONDS[ask.kind]


def work_of(query: wire.Query) -> tuple[int, int, float]:
    """Return the keys, the decisions and the minutes of an answered query."""
    assert query.answer is not None
    return *effort(query.ask, query.answer), seconds_of(query.ask, query.answer) / 60


def _last_change(own: list[str] | list[str | None], labels: list[str] | list[str | None]) -> int:
    """Return how many labels must be entered one by one; after these, one key keeps the learner's other choices."""
    changed = [place for place, (before, after) in enumerate(zip(own, labels, strict=True), 1) if before != after]
    return max(changed, default=0)


def answered(client: Client, run: str) -> list[wire.Query]:
    """Return the answered queries of a run, in the order of the answers."""
    queries: list[wire.Query] = []
    cursor = 0
    while (page := client.answers(run, cursor)).queries:
        queries, cursor = queries + page.queries, page.cursor
    return queries


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", nargs="?")
    parser.add_argument("--store", type=Path, default=Path("waypost.db"))
    parser.add_argument("--success", default="0.95", help="0.8, 0.9, 0.95 or 0.99")
    arguments = parser.parse_args()
    if arguments.run is None:
        parser.exit(0, "Nothing was counted. Give the id of a run in the store.\n")
    with embedded(arguments.store) as connection:
        milestone = connection.learner.costs(arguments.run).first_at[arguments.success]
        if milestone is None:
            parser.exit(1, f"The run never reached {arguments.success}.\n")
        queries = [one for one in answered(connection.learner, arguments.run) if one.ask.episode <= milestone.episode]
    keys, decisions = Counter[str](), Counter[str]()
    minutes: defaultdict[str, float] = defaultdict(float)
    for query in queries:
        n_keys, n_decisions, n_minutes = work_of(query)
        keys[query.ask.kind] += n_keys
        decisions[query.ask.kind] += n_decisions
        minutes[query.ask.kind] += n_minutes
    asked = Counter(query.ask.kind for query in queries)
    level = f"{float(arguments.success):.0%}"
    print(f"Success reached {level} in episode {milestone.episode}, after {milestone.cost:,.0f} units.\n")
    print("| query | asked | keys | decisions | minutes |")
    print("|---|---|---|---|---|")
    for kind in asked:
        print(f"| {kind} | {asked[kind]} | {keys[kind]} | {decisions[kind]} | {minutes[kind]:.1f} |")
    sums = (asked.total(), keys.total(), decisions.total())
    print(f"| all | {' | '.join(map(str, sums))} | {sum(minutes.values()):.1f} |")


if __name__ == "__main__":
    main()
