"""Indexes for the next query of one run, and of one episode."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"

ORDER: tuple[str | sa.ColumnElement[Any], ...] = (
    sa.literal_column("run_priority DESC"),
    sa.literal_column("priority DESC"),
    "id",
)


def upgrade() -> None:
    """Index the open queries of each run, and of each episode, in the order in which they are leased.

    Without the second index, SQLite would look for an episode's queries with the first, among all of the run's.
    """
    is_open = sa.text("state = 'open'")
    for name, columns in (("run", ("run_id",)), ("episode", ("run_id", "episode"))):
        op.create_index(
            f"ix_queries_{name}_next", "queries", [*columns, *ORDER], sqlite_where=is_open, postgresql_where=is_open
        )
