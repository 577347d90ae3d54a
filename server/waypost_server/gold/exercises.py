"""The practice queries of one domain, with their known answers: they are checked, shown and marked."""

from collections.abc import Iterator, Sequence

from waypost import wire
from waypost_server import errors
from waypost_server.gold import scoring
from waypost_server.queries import checks, frame_uses


class Exercises:
    """The practice queries and worked examples of one domain. The ids of the queries are numbers from `first`."""

    def __init__(self, vocabulary: wire.Vocabulary, content: wire.PracticePut, first: int = 0) -> None:
        self._vocabulary = vocabulary
        self._names = checks.Names.of(vocabulary)
        self._content = content
        self.ids = range(first, first + len(content.exercises))

    def check(self, at: errors.Location) -> None:
        """Refuse queries, known answers and demonstrations that do not fit the vocabulary.

        Raises:
            Unprocessable: naming the field below `at`.
        """
        for place, one in enumerate(self._content.exercises):
            here: errors.Location = [*at, "exercises", place]
            checks.check_ask(one.ask, self._names, [*here, "ask"])
            scoring.check(one.ask, one.known, self._names, [*here, "known"])
        for place, shown in enumerate(self._content.demonstrations):
            self._check_shown(shown, [*at, "demonstrations", place])

    def _check_shown(self, one: wire.WorkedDemonstration, at: errors.Location) -> None:
        checks.check_ask(one.ask, self._names, [*at, "ask"])
        checks.check_answer(checks.Outline.of(one.ask), one.answer, self._names, [*at, "answer"])
        if one.answer.replay is None or not one.answer.replay.states:
            raise errors.Unprocessable([*at, "answer", "replay"], "has no states, so there is nothing to show")

    def frames(self) -> Iterator[str]:
        """Yield the hashes of all pictures."""
        yield from frame_uses.of_asks(one.ask for one in self._content.exercises)
        for one in self._content.demonstrations:
            yield from (*frame_uses.of_asks([one.ask]), *frame_uses.of_answer(one.answer))

    def questions(self, domains: Sequence[str] = ()) -> wire.Practice:
        """Return the queries without their known answers, except those of the examples."""
        exercises = zip(self.ids, self._content.exercises, strict=True)
        return wire.Practice(
            vocabulary=self._vocabulary,
            queries=[wire.PracticeQuery(id=n, ask=one.ask) for n, one in exercises],
            examples=self._examples(),
            demonstrations=self._content.demonstrations,
            domains=list(domains),
        )

    def _examples(self) -> list[wire.WorkedExample]:
        """Return a worked example of each kind of which a query is left to answer."""
        by_kind: dict[wire.Kind, list[int]] = {}
        for place, one in enumerate(self._content.exercises):
            by_kind.setdefault(one.ask.kind, []).append(place)
        return [self._example(places[-1]) for places in by_kind.values() if len(places) > 1]

    def _example(self, place: int) -> wire.WorkedExample:
        one = self._content.exercises[place]
        feedback = wire.Feedback(marks=scoring.solved(one.known), reasons=one.reasons, is_right=True)
        return wire.WorkedExample(query=self.ids[place], feedback=feedback)

    def mark(self, query: int, answer: wire.Answer) -> wire.Feedback:
        """Score an answer to one of the queries.

        Raises:
            Unprocessable: the answer does not fit the query.
        """
        one = self._content.exercises[self.ids.index(query)]
        checks.check_answer(checks.Outline.of(one.ask), answer, self._names, ["body", "answer"])
        marks = scoring.marks(one.known, answer)
        return wire.Feedback(marks=marks, reasons=one.reasons, is_right=all(mark.is_right for mark in marks))
