"""Counts the records of a run while they stream by, for the data card."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from waypost import wire
from waypost.prices import to_micro, to_units


@dataclass
class KindTally:
    """The sums of one kind of query. Amounts are micro-units."""

    queries: int = 0
    answers: int = 0  # that count
    micro: int = 0  # charges less refunds
    seconds: float = 0.0
    active_seconds: float = 0.0

    @property
    def units(self) -> float:
        """The cost, in units."""
        return to_units(self.micro)


@dataclass
class Tally:
    """The sums of all records that were counted."""

    run: wire.Run | None = None
    kinds: dict[str, KindTally] = field(default_factory=lambda: defaultdict(KindTally))
    annotators: dict[str, int] = field(default_factory=dict)  # the number of answers that count, by annotator
    episodes: int = 0

    def count(self, records: Iterable[wire.Record]) -> Iterator[wire.Record]:
        """Yield the same records, and count each."""
        for record in records:
            match record:
                case wire.RunRecord():
                    self.run = record.run
                case wire.QueryRecord():
                    self._query(record)
                case wire.LedgerRecord():
                    self._entry(record)
                case wire.EpisodeRecord():
                    self.episodes += 1
            yield record

    def _query(self, record: wire.QueryRecord) -> None:
        kind = self.kinds[record.ask.kind]
        kind.queries += 1
        if record.answered is not None:
            kind.answers += 1
            name = record.answered.annotator
            self.annotators[name] = self.annotators.get(name, 0) + 1

    def _entry(self, record: wire.LedgerRecord) -> None:
        kind = self.kinds[record.kind]
        kind.micro += to_micro(record.units)
        kind.seconds += record.seconds
        kind.active_seconds += record.active_seconds
