"""Quotas: who uploaded a picture, and how many bytes of pictures a user has."""

from alembic import op

revision = "0012"
down_revision = "0011"


def upgrade() -> None:
    """Add the columns and an index. Pictures of older versions belong to nobody and count for nobody."""
    # As SQL: both databases accept a constraint with a new column, and SQLite then needs no copy of the table.
    op.execute(
        "ALTER TABLE users ADD COLUMN frame_bytes BIGINT DEFAULT 0 NOT NULL "
        "CONSTRAINT ck_users_frame_bytes_not_negative CHECK (frame_bytes >= 0)"
    )
    row_id = "BIGINT" if op.get_bind().dialect.name == "postgresql" else "INTEGER"
    op.execute(f"ALTER TABLE frames ADD COLUMN user_id {row_id} CONSTRAINT fk_frames_user_id REFERENCES users (id)")
    op.create_index("ix_frames_user_id", "frames", ["user_id"])
    op.create_index("ix_runs_user_id", "runs", ["user_id"])
