"""Review: comments, whether an answer differs from the learner's suggestion, and second answers."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"

ROW_ID = sa.BigInteger().with_variant(sa.Integer(), "sqlite")


def upgrade() -> None:
    """Add the tables and columns. Answers of older versions are not compared with suggestions."""
    # As SQL: both databases accept a constraint with a new column, and SQLite then needs no copy of the table.
    op.execute(
        "ALTER TABLE queries ADD COLUMN differs BOOLEAN "
        "CONSTRAINT ck_queries_differs_is_answered CHECK (differs IS NULL OR state = 'answered')"
    )
    op.create_index(
        "ix_queries_differs",
        "queries",
        ["run_id", "id"],
        sqlite_where=sa.text("differs IS 1"),
        postgresql_where=sa.text("differs IS true"),
    )
    op.create_table(
        "comments",
        sa.Column("id", ROW_ID, nullable=False),
        sa.Column("query_id", ROW_ID, nullable=False),
        sa.Column("user_id", ROW_ID, nullable=False),
        sa.Column("text", sa.Text(), nullable=False),
        sa.Column("answer_id", ROW_ID, nullable=True),
        sa.Column("created_at", sa.Float(), nullable=False),
        sa.CheckConstraint("length(text) BETWEEN 1 AND 2000", name="ck_comments_length"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_comments_query_id"),
        sa.ForeignKeyConstraint(["user_id"], ["users.id"], name="fk_comments_user_id"),
        sa.ForeignKeyConstraint(["answer_id"], ["answers.id"], name="fk_comments_answer_id"),
        sa.PrimaryKeyConstraint("id", name="pk_comments"),
        sa.UniqueConstraint("answer_id", name="uq_comments_answer_id"),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_comments_query", "comments", ["query_id", "id"])
    refuse_changes()
    op.execute(
        "ALTER TABLE runs ADD COLUMN second_answers FLOAT DEFAULT 0 NOT NULL "
        "CONSTRAINT ck_runs_second_answers CHECK (second_answers >= 0 AND second_answers <= 1)"
    )
    op.create_table(
        "second_answers",
        sa.Column("of_query_id", ROW_ID, nullable=False),
        sa.Column("run_id", sa.Text(), nullable=False),
        sa.Column("query_id", ROW_ID, nullable=True),
        sa.Column("done", sa.Boolean(), nullable=False),
        sa.CheckConstraint("NOT done OR query_id IS NOT NULL", name="ck_second_answers_done_has_query"),
        sa.ForeignKeyConstraint(["of_query_id"], ["queries.id"], name="fk_second_answers_of_query_id"),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_second_answers_run_id"),
        sa.ForeignKeyConstraint(["query_id"], ["queries.id"], name="fk_second_answers_query_id"),
        sa.PrimaryKeyConstraint("of_query_id", name="pk_second_answers"),
        sa.UniqueConstraint("query_id", name="uq_second_answers_query_id"),
    )
    op.create_index(
        "ix_second_answers_waiting",
        "second_answers",
        ["run_id", "of_query_id"],
        sqlite_where=sa.text("done IS 0"),
        postgresql_where=sa.text("done IS false"),
    )


def refuse_changes() -> None:
    """Comments are never changed."""
    if op.get_bind().dialect.name == "postgresql":
        op.execute(
            "CREATE TRIGGER comments_append_only BEFORE UPDATE OR DELETE ON comments "
            "FOR EACH ROW EXECUTE FUNCTION refuse_change()"
        )
        return
    for verb in ("UPDATE", "DELETE"):
        op.execute(
            f"CREATE TRIGGER comments_no_{verb.lower()} BEFORE {verb} ON comments "
            "BEGIN SELECT RAISE(ABORT, 'comments is append-only'); END"
        )
