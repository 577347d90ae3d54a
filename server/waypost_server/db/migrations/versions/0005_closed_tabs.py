"""The browser tab of an assignment, and closed tabs."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"

ROW_ID = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add the tab to assignments, and the table of closed tabs."""
    op.add_column("assignments", sa.Column("tab", sa.Text(), nullable=True))
    op.create_table(
        "departures",
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("tab", sa.Text(), nullable=False),
        sa.Column("at", sa.Float(), nullable=False),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_departures_user_id"),
        sa.PrimaryKeyConstraint("user_id", "tab", name="pk_departures"),
    )
