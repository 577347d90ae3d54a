"""The list of runs, filtered, sorted and paginated by the database."""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import Select, func, or_, select
from sqlalchemy.sql.elements import ColumnElement

from waypost import wire
from waypost_server.db.functions import json_text
from waypost_server.db.tables import runs
from waypost_server.db.transaction import Tx
from waypost_server.runs.service import RUNS, of_row


@dataclass(frozen=True)
class Filter:
    """The filter, the order and the page of a list of runs."""

    text: str = ""
    state: wire.RunState | None = None
    ids: tuple[str, ...] = ()
    owner: int | None = None
    sort: wire.RunSort = "newest"
    descending: bool = True
    offset: int = 0
    limit: int = 200


def list_runs(tx: Tx, chosen: Filter) -> wire.RunList:
    """Return one page of runs, and the number of runs on all pages."""
    conditions = _conditions(chosen)
    total = tx.conn.execute(select(func.count()).select_from(runs).where(*conditions)).scalar_one()
    page = _sorted(RUNS.where(*conditions), chosen).limit(chosen.limit).offset(chosen.offset)
    return wire.RunList(runs=[of_row(row) for row in tx.conn.execute(page)], total=total)


def _conditions(chosen: Filter) -> list[ColumnElement[bool]]:
    conditions: list[ColumnElement[bool]] = [runs.c.gold_of.is_(None), runs.c.deleted_at.is_(None)]
    for word in chosen.text.lower().split():
        places = (runs.c.name, runs.c.algorithm, json_text(runs.c.vocabulary, "domain"), runs.c.id)
        conditions.append(or_(*(func.lower(place).contains(word, autoescape=True) for place in places)))
    if chosen.state is not None:
        conditions.append(runs.c.state == chosen.state)
    if chosen.ids:
        conditions.append(runs.c.id.in_(chosen.ids))
    if chosen.owner is not None:
        conditions.append(runs.c.user_id == chosen.owner)
    return conditions


def _sorted(statement: Select[Any], chosen: Filter) -> Select[Any]:
    """Sort by the chosen column, missing values last; among equal values, the newest run first."""
    columns = {
        "newest": runs.c.number,
        "name": func.lower(runs.c.name),
        "algorithm": func.lower(runs.c.algorithm),
        "episodes": statement.selected_columns.episodes_done,
        "success": statement.selected_columns.success_rate,
        "cost": runs.c.spent,
    }
    column = columns[chosen.sort]
    order = column.desc() if chosen.descending else column.asc()
    return statement.order_by(order.nulls_last(), runs.c.number.desc())
