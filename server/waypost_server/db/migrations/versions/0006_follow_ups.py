"""The user whose answer a query follows in its episode."""

from alembic import op

revision = "0006"
down_revision = "0005"


def upgrade() -> None:
    """Add the column. Queries that are open now follow nobody."""
    # As SQL: both databases accept a constraint with a new column, and SQLite then needs no copy of the table.
    op.execute(
        "ALTER TABLE queries ADD COLUMN follows_user_id "
        + ("INTEGER" if op.get_bind().dialect.name == "sqlite" else "BIGINT")
        + " CONSTRAINT fk_queries_follows_user_id REFERENCES users (id)"
    )
