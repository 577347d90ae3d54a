"""The ledger and the accounts of runs. Only this module changes them. Amounts are whole micro-units."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import bindparam, insert, update

from waypost.prices import MICRO, Cost, to_units
from waypost_server import errors
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import ledger, runs
from waypost_server.db.transaction import Tx

CEILING = 10**12 * MICRO  # the budget of a run without one, so that sums stay well within 64 bits


@dataclass(frozen=True)
class Account:
    """The account of a run whose row is locked until the end of the transaction."""

    run: str
    budget: int | None
    spent: int
    reserved: int

    @property
    def free(self) -> int:
        """The units that can still be reserved."""
        return (CEILING if self.budget is None else self.budget) - self.spent - self.reserved


@dataclass(frozen=True)
class Entry:
    """The content of one entry of the ledger."""

    run: str
    query: int
    answer: int
    kind: str
    episode: int
    cost: Cost
    seconds: float
    active_seconds: float


_INSERT = insert(ledger)
_WRITE = Prepared(_INSERT, [column.name for column in ledger.columns if not column.primary_key])
_CHANGE = Prepared(
    update(runs)
    .where(runs.c.id == bindparam("run"))
    .values(spent=runs.c.spent + bindparam("more_spent"), reserved=runs.c.reserved + bindparam("more_reserved"))
)


def reserve(tx: Tx, account: Account, amount: int) -> None:
    """Reserve units for new queries.

    Raises:
        BudgetExhausted: the budget has too few units left.
    """
    if amount > account.free:
        raise errors.BudgetExhausted(
            f"This needs {to_units(amount):g} units, but only {to_units(account.free):g} of the run's budget are free "
            f"({to_units(account.spent):g} spent, {to_units(account.reserved):g} reserved)."
        )
    _change(tx, account.run, 0, amount)


def release(tx: Tx, run: str, amount: int) -> None:
    """Release the units reserved for queries that will not be answered."""
    _change(tx, run, 0, -amount)


def charge(tx: Tx, entry: Entry, reserved: int) -> None:
    """Charge an answer and release the units reserved for it."""
    # The account first, as in a refund: its row is locked before the sums that the ledger's trigger changes.
    _change(tx, entry.run, entry.cost.units, -reserved)
    _write(tx, "charge", entry, 1)


def refund(tx: Tx, entry: Entry, account: Account, reserved: int) -> None:
    """Refund an answer and reserve units for its query again.

    Raises:
        BudgetExhausted: the budget has too few units left to have the query answered again.
    """
    if reserved - entry.cost.units > account.free:
        raise errors.BudgetExhausted("The run's budget has too few units left to have this query answered again.")
    _write(tx, "refund", entry, -1)
    _change(tx, entry.run, -entry.cost.units, reserved)


def restore(tx: Tx, run: str, entries: Sequence[Mapping[str, Any]]) -> None:
    """Insert the entries of an imported run as they were booked, and add them to the units that the run has spent.

    Args:
        tx: the transaction.
        run: the run's id.
        entries: rows of the ledger, in the order of their booking.
    """
    tx.conn.execute(_INSERT, entries)
    _change(tx, run, sum(int(entry["units"]) for entry in entries), 0)


def _write(tx: Tx, kind: str, entry: Entry, sign: int) -> None:
    row = {
        "run_id": entry.run,
        "query_id": entry.query,
        "answer_id": entry.answer,
        "entry": kind,
        "kind": entry.kind,
        "episode": entry.episode,
        "units": sign * entry.cost.units,
        "lo_units": sign * entry.cost.lo,
        "seconds": sign * entry.seconds,
        "active_seconds": sign * entry.active_seconds,
        "created_at": tx.now,
    }
    _WRITE.run(tx.conn, row)
    tx.count("units", kind, entry.cost.units)
    units = sign * to_units(entry.cost.units)
    tx.trace(kind, entry.run, entry.episode, query=entry.query, answer=entry.answer, units=units)


def _change(tx: Tx, run: str, spent: int, reserved: int) -> None:
    _CHANGE.run(tx.conn, {"run": run, "more_spent": spent, "more_reserved": reserved})
