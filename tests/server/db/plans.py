"""The plans by which SQLite runs statements."""

from collections.abc import Callable
from typing import Any

import pytest
from sqlalchemy.engine.default import DefaultDialect


def plans(part: str, work: Callable[[], object]) -> list[str]:
    """Do some work; return the plan of each statement of SQLAlchemy with this part, a step of the plan in each line."""
    found: list[str] = []
    execute = DefaultDialect.do_execute

    def explaining(dialect: Any, cursor: Any, statement: str, parameters: Any, context: Any = None) -> None:
        if part in statement:
            cursor.execute(f"EXPLAIN QUERY PLAN {statement}", parameters)
            found.append("\n".join(row[3] for row in cursor.fetchall()))
        execute(dialect, cursor, statement, parameters, context)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(DefaultDialect, "do_execute", explaining)
        work()
    return found
