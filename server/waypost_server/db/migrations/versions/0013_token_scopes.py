"""Scopes of tokens."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"


def upgrade() -> None:
    """Add the column. Tokens of older versions have no scopes, so they may do what their user may."""
    op.add_column("credentials", sa.Column("scopes", sa.Text(), nullable=True))
