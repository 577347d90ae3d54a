"""The tables. Types and constraints define every state that the store can be in.

Amounts are whole micro-units, so that sums are exact.
"""

from sqlalchemy import (
    BigInteger,
    Boolean,
    CheckConstraint,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    Table,
    Text,
    UniqueConstraint,
    false,
    literal_column,
    or_,
    text,
)

from waypost.wire import KINDS

metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "ck": "ck_%(table_name)s_%(constraint_name)s",
    }
)

RowId = BigInteger().with_variant(Integer, "sqlite")


def one_of(column: str, *values: str) -> CheckConstraint:
    """Return the constraint that a column has one of these values."""
    words = ", ".join(f"'{value}'" for value in values)
    return CheckConstraint(f"{column} IN ({words})", name=column)


users = Table(
    "users",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("name", Text, nullable=False, unique=True),
    Column("role", Text, nullable=False),
    Column("created_at", Float, nullable=False),
    Column("deactivated_at", Float),
    Column("erased_at", Float),  # when the user's personal data were deleted; the row stays, without a name
    # The size of the pictures that the user uploaded first: the sum over the user's rows of frames.
    Column("frame_bytes", BigInteger, nullable=False, server_default=text("0")),
    one_of("role", "admin", "learner", "annotator", "viewer"),
    CheckConstraint("frame_bytes >= 0", name="frame_bytes_not_negative"),
    CheckConstraint("erased_at IS NULL OR deactivated_at IS NOT NULL", name="erased_is_deactivated"),
    sqlite_autoincrement=True,
)

# Tokens, sessions and login codes. Only a SHA-256 of each secret is stored. The first use of a login code revokes it.
credentials = Table(
    "credentials",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    Column("kind", Text, nullable=False),
    Column("hash", Text, nullable=False, unique=True),
    Column("label", Text, nullable=False),
    Column("created_at", Float, nullable=False),
    Column("expires_at", Float),
    Column("revoked_at", Float),
    Column("last_used_at", Float),  # to the minute
    Column("scopes", Text),  # of a token: words with spaces between them; null: whatever its user may do
    one_of("kind", "api", "session", "login"),
    sqlite_autoincrement=True,
)

# Who a user is at an OpenID provider: the SHA-256 of issuer and subject. Rows of erased users stay and keep them out.
identities = Table(
    "identities",
    metadata,
    Column("hash", Text, primary_key=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False, index=True),
    Column("created_at", Float, nullable=False),
    CheckConstraint("length(hash) = 64", name="hash"),
)

runs = Table(
    "runs",
    metadata,
    Column("number", RowId, primary_key=True),
    Column("id", Text, nullable=False, unique=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False, index=True),
    Column("name", Text, nullable=False),
    Column("algorithm", Text, nullable=False),
    Column("seed", BigInteger, nullable=False),
    Column("state", Text, nullable=False),
    Column("vocabulary", Text, nullable=False),
    Column("config", Text, nullable=False),
    Column("prices", Text, nullable=False),
    Column("budget", BigInteger),
    Column("spent", BigInteger, nullable=False),
    Column("reserved", BigInteger, nullable=False),
    Column("episodes", Integer),
    Column("priority", Integer, nullable=False, server_default=text("0")),
    Column("result", Text),
    Column("created_at", Float, nullable=False),
    Column("finished_at", Float),
    # The share of an annotator's queries in this run that are gold.
    Column("gold_rate", Float, nullable=False, server_default=text("0")),
    # Set in a shadow run: the run whose gold queries are answered here. That run does not include its shadow's rows.
    Column("gold_of", Text, ForeignKey("runs.id")),
    # The share of the run's queries that somebody else answers once more, in the shadow.
    Column("second_answers", Float, nullable=False, server_default=text("0")),
    # When the run's content was deleted. Its account stays, and the numbers of its answers and its ledger.
    Column("deleted_at", Float),
    one_of("state", "running", "paused", "finished"),
    CheckConstraint("gold_rate >= 0 AND gold_rate <= 0.5", name="gold_rate"),
    CheckConstraint("second_answers >= 0 AND second_answers <= 1", name="second_answers"),
    CheckConstraint("spent >= 0 AND reserved >= 0", name="money_not_negative"),
    CheckConstraint("budget IS NULL OR spent + reserved <= budget", name="budget_not_overspent"),
    CheckConstraint("(state = 'finished') = (finished_at IS NOT NULL)", name="finished_at"),
    CheckConstraint("deleted_at IS NULL OR state = 'finished'", name="deleted_is_finished"),
    Index("uq_runs_gold_of", "gold_of", unique=True),
    sqlite_autoincrement=True,
)

queries = Table(
    "queries",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("episode", Integer, nullable=False),
    Column("ordinal", Integer, nullable=False),
    Column("kind", Text, nullable=False),
    Column("state", Text, nullable=False),
    Column("priority", Integer, nullable=False),
    # A copy of the run's priority, so that one index finds the next query without reading runs.
    Column("run_priority", Integer, nullable=False, server_default=text("0")),
    Column("ask", Text, nullable=False),
    Column("digest", Text, nullable=False),
    Column("reserve", BigInteger, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("answer_id", RowId, ForeignKey("answers.id", use_alter=True), unique=True),
    Column("used", Boolean, nullable=False),
    Column("created_at", Float, nullable=False),
    # The user who gave the last answer in this episode before the query was asked; leasing then reads no answers.
    Column("follows_user_id", RowId, ForeignKey("users.id")),
    # Whether the answer that counts differs from the learner's suggestion; null if one of the two is missing.
    Column("differs", Boolean),
    one_of("kind", *KINDS),
    # open -> leased -> answered | cancelled; leased -> open: released or expired; answered -> leased: retracted.
    one_of("state", "open", "leased", "answered", "cancelled"),
    CheckConstraint("(state = 'answered') = (answer_id IS NOT NULL)", name="answered"),
    CheckConstraint("NOT used OR state = 'answered'", name="used_is_answered"),
    CheckConstraint("differs IS NULL OR state = 'answered'", name="differs_is_answered"),
    CheckConstraint("reserve >= 0 AND revision >= 0", name="not_negative"),
    UniqueConstraint("run_id", "episode", "ordinal"),
    sqlite_autoincrement=True,
)
# Each has the order in which queries are leased: from any run, from one run, and from one episode (follow-ups).
_open = text("state = 'open'")
_in_order = (queries.c.run_priority.desc(), queries.c.priority.desc(), queries.c.id)
Index("ix_queries_next", *_in_order, sqlite_where=_open, postgresql_where=_open)
Index("ix_queries_run_next", queries.c.run_id, *_in_order, sqlite_where=_open, postgresql_where=_open)
Index(
    "ix_queries_episode_next",
    queries.c.run_id,
    queries.c.episode,
    *_in_order,
    sqlite_where=_open,
    postgresql_where=_open,
)
Index("ix_queries_run_state", queries.c.run_id, queries.c.state, queries.c.episode)
Index("ix_queries_run", queries.c.run_id, queries.c.id)
DIFFERS = queries.c.differs.is_(True)  # as the partial index says it
Index("ix_queries_differs", queries.c.run_id, queries.c.id, sqlite_where=DIFFERS, postgresql_where=DIFFERS)

assignments = Table(
    "assignments",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("query_id", RowId, ForeignKey("queries.id"), nullable=False, index=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    # The fencing token of one lease. Without its owner's login nobody can use it, so it is stored in clear text.
    Column("token", Text, nullable=False),
    Column("state", Text, nullable=False),
    Column("deferring", Boolean, nullable=False),
    # The assignment whose answer also asked for this one.
    Column("after_id", RowId, ForeignKey("assignments.id"), index=True),
    Column("reason", Text),
    Column("tab", Text),  # the name of the browser tab that asked for it, if the request gave one
    Column("leased_at", Float, nullable=False),
    Column("expires_at", Float, nullable=False),
    Column("ended_at", Float),
    one_of("state", "live", "answered", "skipped", "released", "expired", "cancelled"),
    CheckConstraint("(state = 'live') = (ended_at IS NULL)", name="ended_at"),
    sqlite_autoincrement=True,
)
_live = text("state = 'live'")
Index("uq_assignments_live", assignments.c.query_id, unique=True, sqlite_where=_live, postgresql_where=_live)
Index("ix_assignments_expiry", assignments.c.expires_at, sqlite_where=_live, postgresql_where=_live)
Index("ix_assignments_user_live", assignments.c.user_id, sqlite_where=_live, postgresql_where=_live)

# Literals rather than bound values, so that the databases use the partial indexes above.
IS_OPEN = queries.c.state == literal_column("'open'")
IS_UNANSWERED = or_(IS_OPEN, queries.c.state == literal_column("'leased'"))
IS_LIVE = assignments.c.state == literal_column("'live'")

# Immutable (enforced by a trigger), but what an answer says goes with its run when that is deleted. The answer that
# counts is queries.answer_id; a late answer has no revision.
answers = Table(
    "answers",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("query_id", RowId, ForeignKey("queries.id"), nullable=False),
    Column("assignment_id", RowId, ForeignKey("assignments.id"), nullable=False, unique=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    Column("content", Text, nullable=False),
    Column("digest", Text, nullable=False),
    Column("idempotency_key", Text),
    Column("revision", Integer),
    Column("units", BigInteger, nullable=False),
    Column("seconds", Float, nullable=False),
    Column("active_seconds", Float, nullable=False),
    Column("created_at", Float, nullable=False),
    UniqueConstraint("query_id", "revision"),
    UniqueConstraint("user_id", "idempotency_key"),
    CheckConstraint("revision IS NOT NULL OR units = 0", name="late_is_free"),
    Index("ix_answers_run", "run_id", "id"),
    Index("ix_answers_user", "user_id", "id"),
    sqlite_autoincrement=True,
)

# Append-only (enforced by a trigger): every charge and every refund.
ledger = Table(
    "ledger",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("query_id", RowId, ForeignKey("queries.id"), nullable=False),
    Column("answer_id", RowId, ForeignKey("answers.id"), nullable=False),
    Column("entry", Text, nullable=False),
    Column("kind", Text, nullable=False),
    Column("episode", Integer, nullable=False),
    Column("units", BigInteger, nullable=False),
    Column("lo_units", BigInteger, nullable=False),
    Column("seconds", Float, nullable=False),
    Column("active_seconds", Float, nullable=False),
    Column("created_at", Float, nullable=False),
    one_of("entry", "charge", "refund"),
    one_of("kind", *KINDS),
    UniqueConstraint("answer_id", "entry"),
    CheckConstraint(
        "(entry = 'charge' AND lo_units >= 0 AND units >= lo_units) OR "
        "(entry = 'refund' AND lo_units <= 0 AND units <= lo_units)",
        name="sign",
    ),
    Index("ix_ledger_run", "run_id", "episode", "kind"),
    Index("ix_ledger_run_id", "run_id", "id"),
    sqlite_autoincrement=True,
)

# The sums of the ledger, of which a trigger adds up each entry. So nobody waits until a million entries are read.
ledger_sums = Table(
    "ledger_sums",
    metadata,
    Column("run_id", Text, ForeignKey("runs.id"), primary_key=True),
    Column("episode", Integer, primary_key=True),
    Column("kind", Text, primary_key=True),
    Column("queries", Integer, nullable=False),  # charges less refunds
    Column("units", BigInteger, nullable=False),
    Column("lo_units", BigInteger, nullable=False),
    Column("seconds", Float, nullable=False),
    Column("active_seconds", Float, nullable=False),
    sqlite_with_rowid=False,
)

# Append-only (enforced by a trigger): what reviewers wrote about queries. They go only with the
# run or with the data of their author.
comments = Table(
    "comments",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("query_id", RowId, ForeignKey("queries.id"), nullable=False),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    Column("text", Text, nullable=False),
    Column("answer_id", RowId, ForeignKey("answers.id"), unique=True),  # the answer that was sent back with it
    Column("created_at", Float, nullable=False),
    CheckConstraint("length(text) BETWEEN 1 AND 2000", name="length"),
    Index("ix_comments_query", "query_id", "id"),
    sqlite_autoincrement=True,
)

skips = Table(
    "skips",
    metadata,
    Column("query_id", RowId, ForeignKey("queries.id"), primary_key=True),
    Column("user_id", RowId, ForeignKey("users.id"), primary_key=True),
)

# Browser tabs that were closed. They get no new leases.
closed_tabs = Table(
    "departures",
    metadata,
    Column("user_id", RowId, ForeignKey("users.id"), primary_key=True),
    Column("tab", Text, primary_key=True),
    Column("at", Float, nullable=False),
)

# The last request for a query by each user, so that a deferring bot can leave queries to people. Null means any.
presence = Table(
    "presence",
    metadata,
    Column("user_id", RowId, ForeignKey("users.id"), primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id")),
    Column("kinds", Text),
    Column("asked_at", Float, nullable=False, index=True),
)

# Each annotator's active seconds since their last answer.
active_time = Table(
    "activity",
    metadata,
    Column("user_id", RowId, ForeignKey("users.id"), primary_key=True),
    Column("active_seconds", Float, nullable=False),
    Column("signalled_at", Float, nullable=False),
    CheckConstraint("active_seconds >= 0", name="not_negative"),
)

# Pictures of states, identified by the SHA-256 of the file. Never changed; deleted with the last run that shows them.
frames = Table(
    "frames",
    metadata,
    Column("hash", Text, primary_key=True),
    Column("png", LargeBinary, nullable=False),
    Column("created_at", Float, nullable=False),
    Column("pinned", Boolean, nullable=False, server_default=false()),  # practice queries show it, so it stays
    Column("user_id", RowId, ForeignKey("users.id"), index=True),  # who uploaded it; null: counts for nobody's quota
)

# The frames that the queries, answers and gold queries of a run show.
frame_uses = Table(
    "frame_uses",
    metadata,
    Column("run_id", Text, ForeignKey("runs.id"), primary_key=True),
    Column("hash", Text, ForeignKey("frames.hash"), primary_key=True, index=True),
)

episodes = Table(
    "episodes",
    metadata,
    Column("run_id", Text, ForeignKey("runs.id"), primary_key=True),
    Column("episode", Integer, primary_key=True),
    Column("test_success", Boolean),
    Column("result", Text, nullable=False),
    Column("created_at", Float, nullable=False),
)

events = Table(
    "events",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("event", Text, nullable=False),
    Column("data", Text, nullable=False),
    Column("created_at", Float, nullable=False),
    one_of("event", "asked", "answered", "retracted", "used", "cancelled", "episode", "run"),
    Index("ix_events_run", "run_id", "id"),
    sqlite_autoincrement=True,
)

# Gold queries: queries of a run with known answers.
gold = Table(
    "gold",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("kind", Text, nullable=False),
    Column("ask", Text, nullable=False),
    Column("accepted", Text, nullable=False),
    Column("digest", Text, nullable=False),
    # The query it was made from, and that query's annotator, who never gets this gold query.
    Column("query_id", RowId, ForeignKey("queries.id")),
    Column("author_id", RowId, ForeignKey("users.id")),
    Column("created_at", Float, nullable=False),
    Column("retired_at", Float),
    one_of("kind", *KINDS),
    UniqueConstraint("run_id", "digest"),
    sqlite_autoincrement=True,
)

# Practice queries of a run's domain, which its learner sent, with the right answers.
practices = Table(
    "practices",
    metadata,
    Column("run_id", Text, ForeignKey("runs.id"), primary_key=True),
    Column("content", Text, nullable=False),
)

# What the policies of a later episode would answer to a query, as the learner sent it. The answer that it used stays.
predictions = Table(
    "predictions",
    metadata,
    Column("query_id", RowId, ForeignKey("queries.id"), primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False, index=True),
    Column("episode", Integer, nullable=False),
    Column("content", Text, nullable=False),
    Column("differs", Boolean, nullable=False),  # from the answer
)

# One showing of a gold query to one annotator: a query in the run's shadow, and how many labels were right.
gold_showings = Table(
    "probes",
    metadata,
    Column("query_id", RowId, ForeignKey("queries.id"), primary_key=True),
    Column("gold_id", RowId, ForeignKey("gold.id"), nullable=False),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    Column("n_labels", Integer),
    Column("n_right", Integer),
    CheckConstraint("(n_labels IS NULL) = (n_right IS NULL)", name="scored"),
    CheckConstraint("n_right >= 0 AND n_right <= n_labels", name="right_of_labels"),
    Index("ix_probes_user", "user_id", "gold_id"),
    Index("ix_probes_gold", "gold_id"),
)

# The queries of runs that somebody else answers once more, and their copies in the shadow, once they are handed out.
second_answers = Table(
    "second_answers",
    metadata,
    Column("of_query_id", RowId, ForeignKey("queries.id"), primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), nullable=False),
    Column("query_id", RowId, ForeignKey("queries.id"), unique=True),
    Column("done", Boolean, nullable=False),
    CheckConstraint("NOT done OR query_id IS NOT NULL", name="done_has_query"),
)
IS_WAITING = second_answers.c.done.is_(False)  # as the partial index says it
Index(
    "ix_second_answers_waiting",
    second_answers.c.run_id,
    second_answers.c.of_query_id,
    sqlite_where=IS_WAITING,
    postgresql_where=IS_WAITING,
)

# How many queries of a run an annotator has got while the run had a gold rate.
gold_streams = Table(
    "gold_streams",
    metadata,
    Column("user_id", RowId, ForeignKey("users.id"), primary_key=True),
    Column("run_id", Text, ForeignKey("runs.id"), primary_key=True),
    Column("handed", Integer, nullable=False),
)

# Addresses to which an administrator has answers and states of runs announced.
webhooks = Table(
    "webhooks",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("user_id", RowId, ForeignKey("users.id"), nullable=False),
    Column("url", Text, nullable=False),
    Column("topics", Text, nullable=False),
    Column("note", Text, nullable=False),
    Column("secret", Text, nullable=False),  # in clear text, because every message is signed with it
    Column("active", Boolean, nullable=False),
    Column("off_reason", Text),
    # Attempts that failed since the last success; all deliveries of the webhook wait until `resumes_at`.
    Column("failures", Integer, nullable=False),
    Column("failing_since", Float),
    Column("resumes_at", Float, nullable=False),
    # The server process that delivers now. Others leave the webhook alone until the claim expires.
    Column("claim", Text),
    Column("claimed_until", Float),
    Column("created_at", Float, nullable=False),
    CheckConstraint("off_reason IS NULL OR NOT active", name="off_reason"),
    CheckConstraint("failures >= 0 AND (failures = 0) = (failing_since IS NULL)", name="failing_since"),
    CheckConstraint("(claim IS NULL) = (claimed_until IS NULL)", name="claim"),
    sqlite_autoincrement=True,
)

# One message to one webhook, written in the transaction of the change that it announces.
deliveries = Table(
    "deliveries",
    metadata,
    Column("id", RowId, primary_key=True),
    Column("webhook_id", RowId, ForeignKey("webhooks.id"), nullable=False),
    Column("message", Text, nullable=False, unique=True),
    Column("type", Text, nullable=False),
    Column("run_id", Text, ForeignKey("runs.id")),
    Column("body", Text, nullable=False),
    # pending -> delivered | given_up; given_up or delivered -> pending: an administrator asked for it again.
    Column("state", Text, nullable=False),
    Column("attempts", Integer, nullable=False),
    Column("status", Integer),
    Column("reason", Text),
    Column("created_at", Float, nullable=False),
    Column("queued_at", Float, nullable=False),  # when it was last made pending
    Column("next_at", Float, nullable=False),
    Column("ended_at", Float),
    one_of("state", "pending", "delivered", "given_up"),
    CheckConstraint("(state = 'pending') = (ended_at IS NULL)", name="ended_at"),
    CheckConstraint("attempts >= 0", name="attempts"),
    Index("ix_deliveries_webhook", "webhook_id", "id"),
    sqlite_autoincrement=True,
)
IS_PENDING = deliveries.c.state == literal_column("'pending'")
_pending = text("state = 'pending'")
Index(
    "ix_deliveries_pending",
    deliveries.c.webhook_id,
    deliveries.c.id,
    sqlite_where=_pending,
    postgresql_where=_pending,
)

# One row of the audit log (`db.audit`), never changed. `user_id` refers to users, but without a foreign key: its check
# would wait for a lock on the user's row while everybody else waits for the end of the chain.
audit = Table(
    "audit",
    metadata,
    Column("number", RowId, primary_key=True, autoincrement=False),  # 1, 2, 3, ...: without gaps, unlike a sequence's
    Column("at", Text, nullable=False),  # ISO 8601 in UTC: a text, because languages write fractions in different ways
    Column("user_id", RowId),
    Column("actor", Text, nullable=False),
    Column("address", Text),
    Column("action", Text, nullable=False),
    Column("object", Text),
    Column("details", Text, nullable=False),
    Column("previous", Text, nullable=False, unique=True),  # two rows cannot follow the same row
    Column("hash", Text, nullable=False),
    CheckConstraint("number >= 1", name="number"),
    CheckConstraint("length(previous) = 64 AND length(hash) = 64", name="hash"),
)
