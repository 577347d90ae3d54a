"""The ledger's sums by run, episode and kind of query, which a trigger keeps, so that curves read no entries."""

import sqlalchemy as sa
from alembic import op

revision = "0018"
down_revision = "0017"

ADD = """
INSERT INTO ledger_sums (run_id, episode, kind, queries, units, lo_units, seconds, active_seconds)
VALUES (
    new.run_id, new.episode, new.kind, CASE new.entry WHEN 'charge' THEN 1 ELSE -1 END,
    new.units, new.lo_units, new.seconds, new.active_seconds
)
ON CONFLICT (run_id, episode, kind) DO UPDATE SET
    queries = ledger_sums.queries + excluded.queries,
    units = ledger_sums.units + excluded.units,
    lo_units = ledger_sums.lo_units + excluded.lo_units,
    seconds = ledger_sums.seconds + excluded.seconds,
    active_seconds = ledger_sums.active_seconds + excluded.active_seconds;
"""


def upgrade() -> None:
    """Create the table, sum the entries that there are, and create the trigger."""
    op.create_table(
        "ledger_sums",
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("episode", sa.Integer(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("queries", sa.Integer(), nullable=False),
        sa.Column("units", sa.BigInteger(), nullable=False),
        sa.Column("lo_units", sa.BigInteger(), nullable=False),
        sa.Column("seconds", sa.Float(), nullable=False),
        sa.Column("active_seconds", sa.Float(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_ledger_sums_run_id"),
        sa.PrimaryKeyConstraint("run_id", "episode", "kind", name="pk_ledger_sums"),
        sqlite_with_rowid=False,
    )
    op.execute(
        "INSERT INTO ledger_sums (run_id, episode, kind, queries, units, lo_units, seconds, active_seconds) "
        "SELECT run_id, episode, kind, sum(CASE entry WHEN 'charge' THEN 1 ELSE -1 END), sum(units), sum(lo_units), "
        "sum(seconds), sum(active_seconds) FROM ledger GROUP BY run_id, episode, kind"
    )
    if op.get_bind().dialect.name == "postgresql":
        op.execute(
            "CREATE FUNCTION add_to_ledger_sums() RETURNS trigger LANGUAGE plpgsql AS "
            f"$$ BEGIN {ADD} RETURN NULL; END $$"
        )
        op.execute(
            "CREATE TRIGGER ledger_summed AFTER INSERT ON ledger FOR EACH ROW EXECUTE FUNCTION add_to_ledger_sums()"
        )
    else:
        op.execute(f"CREATE TRIGGER ledger_summed AFTER INSERT ON ledger BEGIN {ADD} END")
