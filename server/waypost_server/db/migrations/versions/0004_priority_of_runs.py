"""The priority of runs, and indexes for the tables of a run's queries and ledger."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """Add the priority to runs and to their queries, and index the next query by both."""
    op.add_column("runs", sa.Column("priority", sa.Integer(), nullable=False, server_default=sa.text("0")))
    op.add_column("queries", sa.Column("run_priority", sa.Integer(), nullable=False, server_default=sa.text("0")))
    op.drop_index("ix_queries_next", table_name="queries")
    op.create_index(
        "ix_queries_next",
        "queries",
        [sa.literal_column("run_priority DESC"), sa.literal_column("priority DESC"), "id"],
        sqlite_where=sa.text("state = 'open'"),
        postgresql_where=sa.text("state = 'open'"),
    )
    op.create_index("ix_queries_run", "queries", ["run_id", "id"])
    op.create_index("ix_ledger_run_id", "ledger", ["run_id", "id"])
