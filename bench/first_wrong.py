"""What runs would have cost with clicks on the first wrong step: `python bench/first_wrong.py RUN... --store FILE`.

One click, at the price of an inspection, says that all before a place was right; the rest is then labeled at its own
price. Labels, and so the whole run, would be the same, so its answers need only be priced again: a Label_HI of n
subgoals costs 1, or 1 and n less those before the first wrong one; a Label_LO costs less those before it, as its
Inspect_LO was the click. Prints a table; asserts nothing.
"""

import argparse
from pathlib import Path

from person import answered

from waypost import wire
from waypost_learner.remote.embedded import embedded


def kept(query: wire.Query) -> int:
    """Return how many labels of an answer one click would have given, beyond its own price."""
    segments = [] if query.ask.kind == "hier_demo" else query.ask.segments
    match query.answer:
        case wire.LabelHiAnswer(subgoals=subgoals):
            before = _before([segment.subgoal for segment in segments], subgoals)
            return before - 1
        case wire.LabelLoAnswer(actions=actions, terminations=terminations):
            before = _before(segments[0].actions, actions)
            return min(before, terminations.index(True) if True in terminations else before)
    return 0


def _before(own: list[str] | list[str | None], labels: list[str] | list[str | None]) -> int:
    """Return how many of the learner's own choices come before the first that was not right."""
    return next((place for place, (a, b) in enumerate(zip(own, labels, strict=True)) if a != b), len(labels))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="*", metavar="RUN")
    parser.add_argument("--store", type=Path, default=Path("waypost.db"))
    arguments = parser.parse_args()
    if not arguments.runs:
        parser.exit(0, "Give runs that are in the store; without one there is nothing to count.\n")
    print("| run | 95 % at | with clicks | 99 % at | with clicks | in all | with clicks |")
    print("|---|---|---|---|---|---|---|")
    with embedded(arguments.store) as connection:
        for run in arguments.runs:
            queries = answered(connection.learner, run)
            costs = connection.learner.costs(run)
            cells = []
            for milestone in (costs.first_at["0.95"], costs.first_at["0.99"]):
                if milestone is None:
                    cells += ["never", "never"]
                    continue
                saved = sum(kept(query) for query in queries if query.ask.episode <= milestone.episode)
                cells += [f"{milestone.cost:,.0f}", f"{milestone.cost - saved:,.0f}"]
            cells += [f"{costs.total:,.0f}", f"{costs.total - sum(map(kept, queries)):,.0f}"]
            print(f"| {run} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
