"""The first schema."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None

ROW_ID = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
APPEND_ONLY = ("answers", "ledger", "events")


def upgrade() -> None:
    """Create all tables, and the triggers of the append-only tables."""
    op.create_table(
        "users",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("role", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint("role IN ('admin', 'learner', 'annotator', 'viewer')", name="ck_users_role"),
        sa.PrimaryKeyConstraint("id", name="pk_users"),
        sa.UniqueConstraint("name", name="uq_users_name"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "credentials",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("hash", sa.Text(), nullable=False),
        sa.Column("label", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.Column("expires_at", sa.Float(), nullable=True),
        sa.Column("revoked_at", sa.Float(), nullable=True),
        sa.CheckConstraint("kind IN ('api', 'session', 'login')", name="ck_credentials_kind"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_credentials_user_id"),
        sa.PrimaryKeyConstraint("id", name="pk_credentials"),
        sa.UniqueConstraint("hash", name="uq_credentials_hash"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "runs",
        sa.Column("number", ROW_ID, nullable=False),
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("algorithm", sa.Text(), nullable=False),
        sa.Column("seed", sa.BigInteger(), nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("vocabulary", sa.Text(), nullable=False),
        sa.Column("config", sa.Text(), nullable=False),
        sa.Column("prices", sa.Text(), nullable=False),
        sa.Column("budget", sa.BigInteger(), nullable=True),
        sa.Column("spent", sa.BigInteger(), nullable=False),
        sa.Column("reserved", sa.BigInteger(), nullable=False),
        sa.Column("episodes", sa.Integer(), nullable=True),
        sa.Column("result", sa.Text(), nullable=True),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.Column("finished_at", sa.Float(), nullable=True),
        sa.CheckConstraint("(state = 'finished') = (finished_at IS NOT NULL)", name="ck_runs_finished_at"),
        sa.CheckConstraint("state IN ('running', 'paused', 'finished')", name="ck_runs_state"),
        sa.CheckConstraint("budget IS NULL OR spent + reserved <= budget", name="ck_runs_budget_not_overspent"),
        sa.CheckConstraint("spent >= 0 AND reserved >= 0", name="ck_runs_money_not_negative"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_runs_user_id"),
        sa.PrimaryKeyConstraint("number", name="pk_runs"),
        sa.UniqueConstraint("id", name="uq_runs_id"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "episodes",
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("episode", sa.Integer(), nullable=False),
        sa.Column("test_success", sa.Boolean(), nullable=True),
        sa.Column("result", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_episodes_run_id"),
        sa.PrimaryKeyConstraint("run_id", "episode", name="pk_episodes"),
    )
    op.create_table(
        "events",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("event", sa.Text(), nullable=False),
        sa.Column("data", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint(
            "event IN ('asked', 'answered', 'retracted', 'used', 'cancelled', 'episode', 'run')", name="ck_events_event"
        ),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_events_run_id"),
        sa.PrimaryKeyConstraint("id", name="pk_events"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_events_run", "events", ["run_id", "id"], unique=False)

    op.create_table(
        "presence",
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=True),
        sa.Column("kinds", sa.Text(), nullable=True),
        sa.Column("asked_at", sa.Float(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_presence_run_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_presence_user_id"),
        sa.PrimaryKeyConstraint("user_id", name="pk_presence"),
    )
    op.create_table(
        "queries",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("episode", sa.Integer(), nullable=False),
        sa.Column("ordinal", sa.Integer(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("priority", sa.Integer(), nullable=False),
        sa.Column("ask", sa.Text(), nullable=False),
        sa.Column("digest", sa.Text(), nullable=False),
        sa.Column("reserve", sa.BigInteger(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.Column("answer_id", ROW_ID, nullable=True),
        sa.Column("used", sa.Boolean(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint("(state = 'answered') = (answer_id IS NOT NULL)", name="ck_queries_answered"),
        sa.CheckConstraint("NOT used OR state = 'answered'", name="ck_queries_used_is_answered"),
        sa.CheckConstraint(
            "kind IN ('hier_demo', 'inspect_full', 'label_hi', 'inspect_lo', 'label_lo', 'label_full')",
            name="ck_queries_kind",
        ),
        sa.CheckConstraint("state IN ('open', 'leased', 'answered', 'cancelled')", name="ck_queries_state"),
        sa.CheckConstraint("reserve >= 0 AND revision >= 0", name="ck_queries_not_negative"),
        sa.ForeignKeyConstraint(["answer_id"], ["answers.id"], name="fk_queries_answer_id", use_alter=True),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_queries_run_id"),
        sa.PrimaryKeyConstraint("id", name="pk_queries"),
        sa.UniqueConstraint("answer_id", name="uq_queries_answer_id"),
        sa.UniqueConstraint("run_id", "episode", "ordinal", name="uq_queries_run_id_episode_ordinal"),
        sqlite_autoincrement=True,
    )
    op.create_index(
        "ix_queries_next",
        "queries",
        [sa.literal_column("priority DESC"), "id"],
        unique=False,
        sqlite_where=sa.text("state = 'open'"),
        postgresql_where=sa.text("state = 'open'"),
    )
    op.create_index("ix_queries_run_state", "queries", ["run_id", "state", "episode"], unique=False)

    op.create_table(
        "assignments",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("token", sa.Text(), nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("deferring", sa.Boolean(), nullable=False),
        sa.Column("after_id", ROW_ID, nullable=True),
        sa.Column("reason", sa.Text(), nullable=True),
        sa.Column("leased_at", sa.Float(), nullable=False),
        sa.Column("expires_at", sa.Float(), nullable=False),
        sa.Column("ended_at", sa.Float(), nullable=True),
        sa.CheckConstraint("(state = 'live') = (ended_at IS NULL)", name="ck_assignments_ended_at"),
        sa.CheckConstraint(
            "state IN ('live', 'answered', 'skipped', 'released', 'expired', 'cancelled')", name="ck_assignments_state"
        ),
        sa.ForeignKeyConstraint(["after_id"], ["assignments.id"], name="fk_assignments_after_id"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_assignments_query_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_assignments_user_id"),
        sa.PrimaryKeyConstraint("id", name="pk_assignments"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_assignments_after_id", "assignments", ["after_id"], unique=False)
    op.create_index(
        "ix_assignments_expiry",
        "assignments",
        ["expires_at"],
        unique=False,
        sqlite_where=sa.text("state = 'live'"),
        postgresql_where=sa.text("state = 'live'"),
    )
    op.create_index("ix_assignments_query_id", "assignments", ["query_id"], unique=False)
    op.create_index(
        "ix_assignments_user_live",
        "assignments",
        ["user_id"],
        unique=False,
        sqlite_where=sa.text("state = 'live'"),
        postgresql_where=sa.text("state = 'live'"),
    )
    op.create_index(
        "uq_assignments_live",
        "assignments",
        ["query_id"],
        unique=True,
        sqlite_where=sa.text("state = 'live'"),
        postgresql_where=sa.text("state = 'live'"),
    )

    op.create_table(
        "skips",
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_skips_query_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_skips_user_id"),
        sa.PrimaryKeyConstraint("query_id", "user_id", name="pk_skips"),
    )
    op.create_table(
        "answers",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("assignment_id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("content", sa.Text(), nullable=False),
        sa.Column("digest", sa.Text(), nullable=False),
        sa.Column("idempotency_key", sa.Text(), nullable=True),
        sa.Column("revision", sa.Integer(), nullable=True),
        sa.Column("units", sa.BigInteger(), nullable=False),
        sa.Column("seconds", sa.Float(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint("revision IS NOT NULL OR units = 0", name="ck_answers_late_is_free"),
        sa.ForeignKeyConstraint(["assignment_id"], ["assignments.id"], name="fk_answers_assignment_id"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_answers_query_id"),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_answers_run_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_answers_user_id"),
        sa.PrimaryKeyConstraint("id", name="pk_answers"),
        sa.UniqueConstraint("assignment_id", name="uq_answers_assignment_id"),
        sa.UniqueConstraint("query_id", "revision", name="uq_answers_query_id_revision"),
        sa.UniqueConstraint("user_id", "idempotency_key", name="uq_answers_user_id_idempotency_key"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_answers_run", "answers", ["run_id", "id"], unique=False)
    op.create_index("ix_answers_user", "answers", ["user_id", "id"], unique=False)

    op.create_table(
        "ledger",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("answer_id", ROW_ID, nullable=False),
        sa.Column("entry", sa.Text(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("episode", sa.Integer(), nullable=False),
        sa.Column("units", sa.BigInteger(), nullable=False),
        sa.Column("lo_units", sa.BigInteger(), nullable=False),
        sa.Column("seconds", sa.Float(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint(
            "(entry = 'charge' AND lo_units >= 0 AND units >= lo_units) OR "
            "(entry = 'refund' AND lo_units <= 0 AND units <= lo_units)",
            name="ck_ledger_sign",
        ),
        sa.CheckConstraint("entry IN ('charge', 'refund')", name="ck_ledger_entry"),
        sa.CheckConstraint(
            "kind IN ('hier_demo', 'inspect_full', 'label_hi', 'inspect_lo', 'label_lo', 'label_full')",
            name="ck_ledger_kind",
        ),
        sa.ForeignKeyConstraint(["answer_id"], ["answers.id"], name="fk_ledger_answer_id"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_ledger_query_id"),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_ledger_run_id"),
        sa.PrimaryKeyConstraint("id", name="pk_ledger"),
        sa.UniqueConstraint("answer_id", "entry", name="uq_ledger_answer_id_entry"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_ledger_run", "ledger", ["run_id", "episode", "kind"], unique=False)
    if op.get_bind().dialect.name == "postgresql":
        # The two tables refer to each other. SQLite accepts a reference to a table that does not exist yet.
        op.create_foreign_key("fk_queries_answer_id", "queries", "answers", ["answer_id"], ["id"])
        refuse_changes_on_postgresql()
    else:
        refuse_changes_on_sqlite()


def refuse_changes_on_sqlite() -> None:
    """Answers, ledger and events are never changed."""
    for table in APPEND_ONLY:
        for verb in ("UPDATE", "DELETE"):
            op.execute(
                f"CREATE TRIGGER {table}_no_{verb.lower()} BEFORE {verb} ON {table} "
                f"BEGIN SELECT RAISE(ABORT, '{table} is append-only'); END"
            )


def refuse_changes_on_postgresql() -> None:
    """Answers, ledger and events are never changed."""
    op.execute(
        "CREATE FUNCTION refuse_change() RETURNS trigger LANGUAGE plpgsql AS "
        "$$ BEGIN RAISE EXCEPTION '% is append-only', TG_TABLE_NAME USING ERRCODE = 'integrity_constraint_violation'; "
        "END $$"
    )
    for table in APPEND_ONLY:
        op.execute(
            f"CREATE TRIGGER {table}_append_only BEFORE UPDATE OR DELETE ON {table} "
            "FOR EACH ROW EXECUTE FUNCTION refuse_change()"
        )
