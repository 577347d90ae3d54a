"""Whom a query follows: who answered its episode last when it was asked."""

from alembic import op

revision = "0006"
down_revision = "0005"


def upgrade() -> None:
    """Add the column; what is open now follows nobody."""
    # Spelled out: both databases take a constraint with a new column, and SQLite needs no copy of the table then.
    op.execute(
        "ALTER TABLE queries ADD COLUMN follows_user_id "
        + ("INTEGER" if op.get_bind().dialect.name == "sqlite" else "BIGINT")
        + " CONSTRAINT fk_queries_follows_user_id REFERENCES users (id)"
    )
