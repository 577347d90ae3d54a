"""The database's clock, so that all server processes share one time."""

from typing import Any

from sqlalchemy import Float
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement

DAY = 86_400.0  # seconds


class clock(FunctionElement[float]):  # noqa: N801 - a SQL function
    """The database's time: seconds since the epoch."""

    inherit_cache = True
    type = Float()


@compiles(clock, "sqlite")
def _sqlite_clock(*_: Any, **_options: Any) -> str:
    return "((julianday('now') - 2440587.5) * 86400.0)"


@compiles(clock, "postgresql")
def _postgresql_clock(*_: Any, **_options: Any) -> str:
    return "CAST(extract(epoch FROM clock_timestamp()) AS double precision)"
