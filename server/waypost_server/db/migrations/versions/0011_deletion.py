"""Deletion of a run or of a person's data: what is deleted, which frames a run shows, and triggers that let both go."""

import json
from collections.abc import Iterator
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"

AT_ONCE = 500
# What an answer says can be removed once its run is deleted; nothing else of it can change.
CONTENT = ("content", "digest", "idempotency_key")
NUMBERS = ("id", "run_id", "query_id", "assignment_id", "user_id", "revision", "units", "seconds", "active_seconds")
KEPT = (*NUMBERS, "created_at")

RUN_IS_DELETED = "EXISTS (SELECT 1 FROM runs WHERE id = {run} AND deleted_at IS NOT NULL)"
COMMENT_MAY_GO = (
    "EXISTS (SELECT 1 FROM queries JOIN runs ON runs.id = queries.run_id "
    "WHERE queries.id = old.query_id AND runs.deleted_at IS NOT NULL) "
    "OR EXISTS (SELECT 1 FROM users WHERE id = old.user_id AND erased_at IS NOT NULL)"
)


def upgrade() -> None:
    """Add the columns and the table, and replace the triggers of answers, events and comments."""
    # As SQL: both databases accept a constraint with a new column, and SQLite then needs no copy of the table.
    op.execute(
        "ALTER TABLE runs ADD COLUMN deleted_at FLOAT "
        "CONSTRAINT ck_runs_deleted_is_finished CHECK (deleted_at IS NULL OR state = 'finished')"
    )
    op.execute(
        "ALTER TABLE users ADD COLUMN erased_at FLOAT "
        "CONSTRAINT ck_users_erased_is_deactivated CHECK (erased_at IS NULL OR deactivated_at IS NOT NULL)"
    )
    op.add_column("frames", sa.Column("pinned", sa.Boolean(), nullable=False, server_default=sa.false()))
    op.create_table(
        "frame_uses",
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("hash", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_frame_uses_run_id"),
        sa.ForeignKeyConstraint(["hash"], ["frames.hash"], name="fk_frame_uses_hash"),
        sa.PrimaryKeyConstraint("run_id", "hash", name="pk_frame_uses"),
    )
    op.create_index("ix_frame_uses_hash", "frame_uses", ["hash"])
    find_uses()
    if op.get_bind().dialect.name == "postgresql":
        let_go_on_postgresql()
    else:
        let_go_on_sqlite()


def find_uses() -> None:
    """Record which stored frames the queries, answers and gold queries of each run show."""
    conn = op.get_bind()
    uses = sa.table("frame_uses", sa.column("run_id"), sa.column("hash"))
    frames = sa.table("frames", sa.column("hash"))
    stored = set(conn.execute(sa.select(frames.c.hash)).scalars()) if shows_pictures(conn) else set()
    seen = {(run, frame) for run, frame in shown(conn) if frame in stored} if stored else set()
    rows = [{"run_id": run, "hash": frame} for run, frame in sorted(seen)]
    for first in range(0, len(rows), AT_ONCE):
        conn.execute(sa.insert(uses), rows[first : first + AT_ONCE])


def shows_pictures(conn: sa.Connection) -> bool:
    """Return whether the store has a frame: most have none, and then no text is read."""
    return conn.execute(sa.text("SELECT 1 FROM frames LIMIT 1")).first() is not None


def shown(conn: sa.Connection) -> Iterator[tuple[str, str]]:
    """Yield the runs and the frames that their texts name."""
    for table, column in (("queries", "ask"), ("answers", "content"), ("gold", "ask")):
        texts = f'SELECT run_id, {column} FROM {table} WHERE {column} LIKE \'%"frames":["%\''  # noqa: S608 (our names)
        found = conn.execute(sa.text(texts), execution_options={"yield_per": AT_ONCE})
        for run, text in found:
            for frame in frames_in(json.loads(text)):
                yield run, frame


def frames_in(value: Any) -> Iterator[str]:
    """Yield every frame that a JSON value names."""
    if isinstance(value, list):
        for one in value:
            yield from frames_in(one)
    elif isinstance(value, dict):
        for name, one in value.items():
            if name == "frames" and isinstance(one, list):
                yield from (frame for frame in one if isinstance(frame, str))
            else:
                yield from frames_in(one)


def let_go_on_sqlite() -> None:
    """Replace the triggers; the refusals and their words stay."""
    same = f"({', '.join(f'new.{name}' for name in KEPT)}) IS ({', '.join(f'old.{name}' for name in KEPT)})"
    gone = "new.content = '' AND new.digest = '' AND new.idempotency_key IS NULL"
    conditions = {
        ("answers", "update"): f"{gone} AND {same} AND {RUN_IS_DELETED.format(run='old.run_id')}",
        ("events", "delete"): RUN_IS_DELETED.format(run="old.run_id"),
        ("comments", "delete"): COMMENT_MAY_GO,
    }
    for (table, verb), condition in conditions.items():
        op.execute(f"DROP TRIGGER {table}_no_{verb}")
        op.execute(
            f"CREATE TRIGGER {table}_no_{verb} BEFORE {verb.upper()} ON {table} WHEN NOT ({condition}) "
            f"BEGIN SELECT RAISE(ABORT, '{table} is append-only'); END"
        )


def let_go_on_postgresql() -> None:
    """Replace the one function of the three tables' triggers by one function for each."""
    kept = ", ".join(f"'{name}'" for name in CONTENT)
    gone = "new.content = '' AND new.digest = '' AND new.idempotency_key IS NULL"
    same = f"to_jsonb(new) - ARRAY[{kept}] = to_jsonb(old) - ARRAY[{kept}]"
    conditions = {
        "answers": f"TG_OP = 'UPDATE' AND {gone} AND {same} AND {RUN_IS_DELETED.format(run='old.run_id')}",
        "events": f"TG_OP = 'DELETE' AND {RUN_IS_DELETED.format(run='old.run_id')}",
        "comments": f"TG_OP = 'DELETE' AND ({COMMENT_MAY_GO})",
    }
    for table, condition in conditions.items():
        op.execute(
            f"CREATE FUNCTION refuse_change_of_{table}() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
            f"IF {condition} THEN RETURN COALESCE(new, old); END IF; "
            "RAISE EXCEPTION '% is append-only', TG_TABLE_NAME USING ERRCODE = 'integrity_constraint_violation'; "
            "END $$"
        )
        op.execute(f"DROP TRIGGER {table}_append_only ON {table}")
        op.execute(
            f"CREATE TRIGGER {table}_append_only BEFORE UPDATE OR DELETE ON {table} "
            f"FOR EACH ROW EXECUTE FUNCTION refuse_change_of_{table}()"
        )
