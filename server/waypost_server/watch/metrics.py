"""Metrics in Prometheus' text format, computed from the store."""

from collections.abc import Iterable

from sqlalchemy import func, select

from waypost.prices import to_units
from waypost_server.db.tables import answers, assignments, deliveries, ledger, queries, runs, webhooks
from waypost_server.db.transaction import Tx


def text(tx: Tx) -> str:
    """Return every metric."""
    lines: list[str] = []
    asked = select(queries.c.state, func.count()).join(runs, runs.c.id == queries.c.run_id)
    by_state = tx.conn.execute(asked.where(runs.c.gold_of.is_(None)).group_by(queries.c.state)).all()
    lines += _metric("waypost_queries", "gauge", "Queries by state.", ((f'state="{s}"', n) for s, n in by_state))
    kept_runs = select(runs.c.state, func.count()).where(runs.c.gold_of.is_(None))
    by_run = tx.conn.execute(kept_runs.group_by(runs.c.state)).all()
    lines += _metric("waypost_runs", "gauge", "Runs by state.", ((f'state="{s}"', n) for s, n in by_run))
    ended = tx.conn.execute(select(assignments.c.state, func.count()).group_by(assignments.c.state)).all()
    lines += _metric("waypost_assignments", "gauge", "Assignments by state.", ((f'state="{s}"', n) for s, n in ended))
    given = tx.conn.execute(
        select(func.count().filter(answers.c.revision.is_not(None)), func.count().filter(answers.c.revision.is_(None)))
    ).one()
    kept = (('kind="counted"', given[0]), ('kind="late"', given[1]))
    lines += _metric("waypost_answers_total", "counter", "Answers stored.", kept)
    units = tx.conn.execute(select(ledger.c.kind, func.sum(ledger.c.units)).group_by(ledger.c.kind)).all()
    costs = ((f'kind="{kind}"', to_units(int(micro))) for kind, micro in units)
    lines += _metric("waypost_cost_units", "gauge", "Units in the ledger.", costs)
    messages = tx.conn.execute(select(deliveries.c.state, func.count()).group_by(deliveries.c.state)).all()
    lines += _metric(
        "waypost_webhook_messages",
        "gauge",
        "Kept webhook messages by state.",
        ((f'state="{s}"', n) for s, n in messages),
    )
    hooks = tx.conn.execute(select(webhooks.c.active, func.count()).group_by(webhooks.c.active)).all()
    states = ((f'state="{"on" if active else "off"}"', n) for active, n in hooks)
    lines += _metric("waypost_webhooks", "gauge", "Webhooks by state.", states)
    return "\n".join(lines) + "\n"


def _metric(name: str, kind: str, what: str, values: Iterable[tuple[str, float]]) -> list[str]:
    return [
        f"# HELP {name} {what}",
        f"# TYPE {name} {kind}",
        *(f"{name}{{{label}}} {value}" for label, value in values),
    ]
