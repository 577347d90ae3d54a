"""The agreement of annotators: Krippendorff's alpha over the queries that two of them answered, by kind of query."""

from collections.abc import Sequence

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.transaction import Tx
from waypost_server.gold import second

FEWEST = 10  # with fewer queries answered twice, alpha says nothing


def agreement(tx: Tx, run: str) -> wire.Agreement:
    """Return the agreement of the first and second answers of a run, and what the second ones cost."""
    found = second.pairs(tx, run)
    spent = second.spent(tx, run)
    kinds = [kind for kind in wire.KINDS if any(pair.kind == kind for pair in found)]
    return wire.Agreement(
        by_kind=[_of_kind(kind, [pair for pair in found if pair.kind == kind]) for kind in kinds],
        fewest=FEWEST,
        waiting=second.n_waiting(tx, run),
        units=to_units(int(spent.units)),
        active_seconds=float(spent.active_seconds),
    )


def _of_kind(kind: wire.Kind, found: Sequence[second.Pair]) -> wire.AgreementOfKind:
    labels = [label for pair in found for label in pair.labels]
    same = sum(one == other for one, other in labels)
    return wire.AgreementOfKind(
        kind=kind,
        queries=len(found),
        labels=len(labels),
        share=same / len(labels) if labels else None,
        alpha=alpha(labels) if len(found) >= FEWEST else None,
    )


def alpha(labels: Sequence[tuple[str, str]]) -> float | None:
    """Return Krippendorff's alpha of pairs of labels; None if all are the same label, because then it is undefined."""
    names = sorted({name for pair in labels for name in pair})
    if len(names) < 2:
        return None
    import krippendorff  # it imports numpy, which nothing else in the server needs

    numbers = {name: number for number, name in enumerate(names)}
    raters = [[numbers[pair[rater]] for pair in labels] for rater in (0, 1)]
    return float(krippendorff.alpha(reliability_data=raters, level_of_measurement="nominal"))
