"""Metrics in Prometheus' text format: what the store holds, and what this process has done since it started.

No statement reads a whole table that grows with answers: open queries, live leases and waiting messages have partial
indexes, and runs are few. All else is counted where it happens (`db.transaction`, `http.traffic`, `db.writers`).
"""

from collections.abc import Iterable, Iterator

from sqlalchemy import func, select

from waypost.prices import to_units
from waypost_server.db.tables import IS_LIVE, IS_OPEN, IS_PENDING, assignments, deliveries, queries, runs, webhooks
from waypost_server.db.transaction import Counts, Tx
from waypost_server.db.writers.load import Load
from waypost_server.http.traffic import Traffic

Sample = tuple[str, float]
"""Labels, as they are written, and a value."""


def of_store(tx: Tx) -> list[str]:
    """Return the metrics of what the store holds. All processes of one store return the same."""
    own = runs.c.gold_of.is_(None)
    states = select(runs.c.state, func.count())
    by_state = tx.conn.execute(states.where(own, runs.c.deleted_at.is_(None)).group_by(runs.c.state)).all()
    spent = tx.conn.execute(select(func.coalesce(func.sum(runs.c.spent), 0)).where(own)).scalar_one()
    # With the priority, so that SQLite takes the index of open queries, not one of all queries that has no priority.
    unleased = select(func.count(queries.c.run_priority), func.min(queries.c.id)).where(IS_OPEN)
    n_open, oldest = tx.conn.execute(unleased).one()
    asked_at = select(queries.c.created_at).where(queries.c.id == oldest)
    n_leased = tx.conn.execute(select(func.count()).select_from(assignments).where(IS_LIVE)).scalar_one()
    pending = tx.conn.execute(select(func.count()).select_from(deliveries).where(IS_PENDING)).scalar_one()
    hooks = tx.conn.execute(select(webhooks.c.active, func.count()).group_by(webhooks.c.active)).all()
    waiting = [("open", n_open), ("leased", n_leased)]
    on_or_off = [("on" if active else "off", n) for active, n in hooks]
    age = max(0.0, tx.now - tx.conn.execute(asked_at).scalar_one()) if n_open else 0.0
    return [
        *_metric("runs", "gauge", "Runs by state.", ((f'state="{row[0]}"', row[1]) for row in by_state)),
        *_metric("cost_units", "gauge", "Units that all runs have spent.", [("", to_units(int(spent)))]),
        *_metric("queries", "gauge", "Queries without an answer, by state.", _labeled("state", waiting)),
        *_metric("queue_age_seconds", "gauge", "The age of the oldest open query; 0 if there is none.", [("", age)]),
        *_metric("webhook_messages", "gauge", "Webhook messages that wait.", [('state="pending"', pending)]),
        *_metric("webhooks", "gauge", "Webhooks by state.", _labeled("state", on_or_off)),
    ]


def of_process(counts: Counts, load: Load, traffic: Traffic) -> list[str]:
    """Return the metrics of this process. They begin at 0 when it starts."""
    units = [(_label("entry", entry), to_units(micro)) for entry, micro in counts.of("units", "charge", "refund")]
    ended = counts.of("leases", "expired", "released", "skipped")
    answered = counts.of("answers", "counted", "late")
    sent = counts.of("messages", "delivered", "failed", "given_up")
    requests = sorted(traffic.requests.items())
    by_status = [(f'operation="{name}",status="{status}"', n) for (name, status), n in requests]
    return [
        *_metric("answers_total", "counter", "Answers stored.", ((_label("kind", one), n) for one, n in answered)),
        *_metric("units_total", "counter", "Units charged and refunded.", units),
        *_metric("leases_total", "counter", "Leases granted.", (("", n) for _, n in counts.of("leases", "granted"))),
        *_metric("leases_ended_total", "counter", "Leases that ended unanswered.", _labeled("how", ended)),
        *_metric("webhook_attempts_total", "counter", "Webhook calls by outcome.", _labeled("outcome", sent)),
        *_metric("writer_waiting", "gauge", "Changes that wait for their commit.", [("", load.waiting)]),
        *_metric("writer_commits_total", "counter", "Commits.", [("", load.commits)]),
        *_metric("writer_transactions_total", "counter", "Changes in these commits.", [("", load.transactions)]),
        *_metric("writer_largest_batch", "gauge", "The most changes that one commit had.", [("", load.largest)]),
        *_metric("requests_total", "counter", "Requests by operation and class of status.", by_status),
        *_metric("request_seconds", "histogram", "Time to the head of the reply, by operation.", _latencies(traffic)),
    ]


def _latencies(traffic: Traffic) -> Iterator[Sample]:
    for name, seconds in sorted(traffic.seconds.items()):
        buckets = traffic.at_most(name)
        for bound, n in buckets:
            yield f'_bucket{{operation="{name}",le="{bound}"}}', n
        yield f'_sum{{operation="{name}"}}', seconds
        yield f'_count{{operation="{name}"}}', buckets[-1][1]


def _labeled(name: str, samples: Iterable[tuple[str, int]]) -> Iterator[Sample]:
    for value, n in samples:
        yield _label(name, value), n


def _label(name: str, value: str) -> str:
    return f'{name}="{value}"'


def _metric(name: str, kind: str, what: str, samples: Iterable[Sample]) -> list[str]:
    """Return the lines of a metric. The labels of a histogram come with the ends of its names and their braces."""
    full = f"waypost_{name}"
    lines = [f"# HELP {full} {what}", f"# TYPE {full} {kind}"]
    for labels, value in samples:
        braced = labels if not labels or labels.startswith("_") else f"{{{labels}}}"
        lines.append(f"{full}{braced} {value}")
    return lines
