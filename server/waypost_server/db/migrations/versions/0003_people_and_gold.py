"""Deactivation of users, last use of credentials, and gold queries."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"

ROW_ID = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add columns to users, credentials and runs, and the tables of gold queries."""
    op.add_column("users", sa.Column("deactivated_at", sa.Float(), nullable=True))
    op.add_column("credentials", sa.Column("last_used_at", sa.Float(), nullable=True))
    # As SQL: both databases accept a constraint with a new column, and SQLite then needs no copy of the table.
    op.execute(
        "ALTER TABLE runs ADD COLUMN gold_rate FLOAT DEFAULT 0 NOT NULL "
        "CONSTRAINT ck_runs_gold_rate CHECK (gold_rate >= 0 AND gold_rate <= 0.5)"
    )
    op.execute("ALTER TABLE runs ADD COLUMN gold_of TEXT CONSTRAINT fk_runs_gold_of REFERENCES runs (id)")
    op.create_index("uq_runs_gold_of", "runs", ["gold_of"], unique=True)
    op.create_table(
        "gold",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("ask", sa.Text(), nullable=False),
        sa.Column("accepted", sa.Text(), nullable=False),
        sa.Column("digest", sa.Text(), nullable=False),
        sa.Column("query_id", ROW_ID, nullable=True),
        sa.Column("author_id", ROW_ID, nullable=True),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.Column("retired_at", sa.Float(), nullable=True),
        sa.CheckConstraint(
            "kind IN ('hier_demo', 'inspect_full', 'label_hi', 'inspect_lo', 'label_lo', 'label_full')",
            name="ck_gold_kind",
        ),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_gold_run_id"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_gold_query_id"),
        sa.ForeignKeyConstraint(["author_id"], ["users.id"], name="fk_gold_author_id"),
        sa.PrimaryKeyConstraint("id", name="pk_gold"),
        sa.UniqueConstraint("run_id", "digest", name="uq_gold_run_id_digest"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "probes",
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("gold_id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("n_labels", sa.Integer(), nullable=True),
        sa.Column("n_right", sa.Integer(), nullable=True),
        sa.CheckConstraint("(n_labels IS NULL) = (n_right IS NULL)", name="ck_probes_scored"),
        sa.CheckConstraint("n_right >= 0 AND n_right <= n_labels", name="ck_probes_right_of_labels"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_probes_query_id"),
        sa.ForeignKeyConstraint(["gold_id"], ["gold.id"], name="fk_probes_gold_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_probes_user_id"),
        sa.PrimaryKeyConstraint("query_id", name="pk_probes"),
    )
    op.create_index("ix_probes_user", "probes", ["user_id", "gold_id"])
    op.create_index("ix_probes_gold", "probes", ["gold_id"])
    op.create_table(
        "gold_streams",
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("handed", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_gold_streams_user_id"),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_gold_streams_run_id"),
        sa.PrimaryKeyConstraint("user_id", "run_id", name="pk_gold_streams"),
    )
