"""SQL functions, in the words of each database: its clock, so that all server processes share one time, and JSON."""

from typing import Any

from sqlalchemy import BigInteger, Float, String, literal
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.elements import ColumnElement
from sqlalchemy.sql.functions import FunctionElement

DAY = 86_400.0  # seconds


class clock(FunctionElement[float]):  # noqa: N801 - a SQL function
    """The database's time when the statement begins: seconds since the epoch."""

    inherit_cache = True
    type = Float()


@compiles(clock, "sqlite")
def _sqlite_clock(*_: Any, **_options: Any) -> str:
    return "((julianday('now') - 2440587.5) * 86400.0)"


@compiles(clock, "postgresql")
def _postgresql_clock(*_: Any, **_options: Any) -> str:
    # Of the statement, not of the moment: so an index can find the rows before or after it.
    return "CAST(extract(epoch FROM statement_timestamp()) AS double precision)"


class by_value(FunctionElement[int]):  # noqa: N801 - a SQL function
    """A number for conditions and sorting, by whose index SQLite will not look for rows.

    SQLite does not know how many rows there are. So it may go through very many by the index of a number, to save the
    sorting, where another condition finds the few. PostgreSQL knows, and decides by itself.
    """

    inherit_cache = True
    type = BigInteger()


@compiles(by_value, "sqlite")
def _sqlite_by_value(element: by_value, compiler: Any, **options: Any) -> str:
    return f"({compiler.process(element.clauses, **options)} + 0)"


@compiles(by_value, "postgresql")
def _postgresql_by_value(element: by_value, compiler: Any, **options: Any) -> str:
    return str(compiler.process(element.clauses, **options))


class json_text(FunctionElement[str]):  # noqa: N801 - a SQL function
    """The field of a JSON object with this name, as text; null if there is none."""

    inherit_cache = True
    type = String()

    def __init__(self, column: ColumnElement[str], field: str) -> None:
        super().__init__(column, literal(field))


@compiles(json_text, "sqlite")
def _sqlite_json_text(element: json_text, compiler: Any, **options: Any) -> str:
    column, field = (compiler.process(part, **options) for part in element.clauses)
    return f"json_extract({column}, '$.' || {field})"


@compiles(json_text, "postgresql")
def _postgresql_json_text(element: json_text, compiler: Any, **options: Any) -> str:
    column, field = (compiler.process(part, **options) for part in element.clauses)
    return f"(CAST({column} AS json) ->> CAST({field} AS text))"
