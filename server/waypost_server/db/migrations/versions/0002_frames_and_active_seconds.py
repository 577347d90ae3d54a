"""Frames, and active seconds in addition to raw seconds."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"

ROW_ID = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
IDLE_SECONDS = 30.0  # the default when this migration was written


def upgrade() -> None:
    """Add the tables and columns. Earlier answers have no signs of activity; their seconds count up to the cap."""
    op.create_table(
        "activity",
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("active_seconds", sa.Float(), nullable=False),
        sa.Column("signalled_at", sa.Float(), nullable=False),
        sa.CheckConstraint("active_seconds >= 0", name="ck_activity_not_negative"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_activity_user_id"),
        sa.PrimaryKeyConstraint("user_id", name="pk_activity"),
    )
    op.create_table(
        "frames",
        sa.Column("hash", sa.Text(), nullable=False),
        sa.Column("png", sa.LargeBinary(), nullable=False),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.PrimaryKeyConstraint("hash", name="pk_frames"),
    )
    for table in ("answers", "ledger"):
        op.add_column(table, sa.Column("active_seconds", sa.Float(), nullable=False, server_default="0"))
        _fill(table)


def _fill(table: str) -> None:
    """Fill the new column. The trigger that keeps the table append-only is off meanwhile."""
    most = IDLE_SECONDS
    fill = (
        f"UPDATE {table} SET active_seconds = CASE WHEN seconds > {most} THEN {most} "  # noqa: S608 (our names and number)
        f"WHEN seconds < -{most} THEN -{most} ELSE seconds END"
    )
    if op.get_bind().dialect.name == "postgresql":
        op.execute(f"ALTER TABLE {table} DISABLE TRIGGER {table}_append_only")
        op.execute(fill)
        op.execute(f"ALTER TABLE {table} ENABLE TRIGGER {table}_append_only")
    else:
        op.execute(f"DROP TRIGGER {table}_no_update")
        op.execute(fill)
        op.execute(
            f"CREATE TRIGGER {table}_no_update BEFORE UPDATE ON {table} "
            f"BEGIN SELECT RAISE(ABORT, '{table} is append-only'); END"
        )
