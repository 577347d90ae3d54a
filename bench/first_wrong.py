"""Computes what runs cost if experts click on the first wrong step: `python bench/first_wrong.py RUN... --store FILE`.

One click marks all steps before it as correct and costs as much as an inspection. The expert then labels only the
remaining steps, at the usual price. The labels are the same, so the whole run is the same, and its answers only need
new prices. A Label_HI without a wrong subgoal costs 1; otherwise 1 plus the labels from the first wrong subgoal on. A
Label_LO costs the labels from the first wrong action on, because its Inspect_LO becomes the click. The script prints a
table and asserts nothing.
"""

import argparse
from pathlib import Path

from person import answered

from waypost import wire
from waypost_learner.remote.embedded import embedded


def kept(query: wire.Query) -> int:
    """Return how many units one click saves in this answer: the labels it replaces minus its own price."""
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
    """Return the number of the learner's choices before the first wrong one."""
    return next((place for place, (a, b) in enumerate(zip(own, labels, strict=True)) if a != b), len(labels))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="*", metavar="RUN")
    parser.add_argument("--store", type=Path, default=Path("waypost.db"))
    arguments = parser.parse_args()
    if not arguments.runs:
        parser.exit(0, "Nothing was counted. Give the ids of runs in the store.\n")
    print("| run | units to 95 % | with clicks | units to 99 % | with clicks | total units | with clicks |")
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
