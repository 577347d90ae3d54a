"""A SQL function that reads one field of a JSON text, in the words of each database."""

from typing import Any

from sqlalchemy import String, literal
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.elements import ColumnElement
from sqlalchemy.sql.functions import FunctionElement


class json_text(FunctionElement[str]):  # noqa: N801 - a SQL function
    """The field with this name, as text; null if there is none."""

    inherit_cache = True
    type = String()

    def __init__(self, column: ColumnElement[str], field: str) -> None:
        super().__init__(column, literal(field))


@compiles(json_text, "sqlite")
def _sqlite(element: json_text, compiler: Any, **options: Any) -> str:
    column, field = (compiler.process(part, **options) for part in element.clauses)
    return f"json_extract({column}, '$.' || {field})"


@compiles(json_text, "postgresql")
def _postgresql(element: json_text, compiler: Any, **options: Any) -> str:
    column, field = (compiler.process(part, **options) for part in element.clauses)
    return f"(CAST({column} AS json) ->> CAST({field} AS text))"
