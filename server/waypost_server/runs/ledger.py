"""Money: whole micro-units inside, units on the wire, and the only code that changes a run's account."""

from dataclasses import dataclass

from sqlalchemy import bindparam, insert, update

from waypost.prices import MICRO, Cost, to_units
from waypost_server import errors
from waypost_server.db.engine import Tx
from waypost_server.db.tables import ledger, runs

CEILING = 10**12 * MICRO  # what a run without a budget may cost: sums stay well inside 64 bits


@dataclass(frozen=True)
class Account:
    """A run's account, its row locked until the end of the unit of work."""

    run: str
    budget: int | None
    spent: int
    reserved: int

    @property
    def free(self) -> int:
        """What may still be reserved."""
        return (CEILING if self.budget is None else self.budget) - self.spent - self.reserved


@dataclass(frozen=True)
class Entry:
    """What a line of the ledger is about."""

    run: str
    query: int
    answer: int
    kind: str
    episode: int
    cost: Cost
    seconds: float
    active_seconds: float


_INSERT = insert(ledger)
_CHANGE = (
    update(runs)
    .where(runs.c.id == bindparam("run"))
    .values(spent=runs.c.spent + bindparam("more_spent"), reserved=runs.c.reserved + bindparam("more_reserved"))
)


def reserve(tx: Tx, account: Account, amount: int) -> None:
    """Hold units for queries asked.

    Raises:
        BudgetExhausted: if they do not fit what is left of the budget.
    """
    if amount > account.free:
        raise errors.BudgetExhausted(
            f"This needs {to_units(amount):g} units, and {to_units(account.free):g} of the run's budget are free "
            f"({to_units(account.spent):g} spent, {to_units(account.reserved):g} reserved)."
        )
    _change(tx, account.run, 0, amount)


def release(tx: Tx, run: str, amount: int) -> None:
    """Let go of units held for queries that will not be answered."""
    _change(tx, run, 0, -amount)


def charge(tx: Tx, entry: Entry, reserved: int) -> None:
    """Charge an answer and settle what was reserved for it."""
    _write(tx, "charge", entry, 1)
    _change(tx, entry.run, entry.cost.units, -reserved)


def refund(tx: Tx, entry: Entry, account: Account, reserved: int) -> None:
    """Take the charge of an answer back and hold its query's reserve again.

    Raises:
        BudgetExhausted: if the reserve no longer fits, the difference being spent elsewhere.
    """
    if reserved - entry.cost.units > account.free:
        raise errors.BudgetExhausted("The run's budget has no room left to have this answered again.")
    _write(tx, "refund", entry, -1)
    _change(tx, entry.run, -entry.cost.units, reserved)


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
    tx.conn.execute(_INSERT, row)


def _change(tx: Tx, run: str, spent: int, reserved: int) -> None:
    tx.conn.execute(_CHANGE, {"run": run, "more_spent": spent, "more_reserved": reserved})
