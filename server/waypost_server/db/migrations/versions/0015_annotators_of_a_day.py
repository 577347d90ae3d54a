"""An index that finds the annotators of the last day."""

from alembic import op

revision = "0015"
down_revision = "0014"


def upgrade() -> None:
    """Create the index."""
    op.create_index("ix_presence_asked_at", "presence", ["asked_at"])
