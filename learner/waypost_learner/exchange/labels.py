"""Turns the answers about replayed paths into the labels that the paper's algorithms append to their data buffers."""

from collections.abc import Iterable

from waypost import wire
from waypost.domains import Domain
from waypost.trajectory import Subgoal
from waypost_learner.exchange.replay import Asked, Replay
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.remote.translation import Translator


def labels_of(domain: Domain, replays: Iterable[Replay]) -> Labels:
    """Return all labels of one episode: demonstrations, and the expert's HI, LO and full labels. Verdicts are none."""
    labels = Labels()
    for replay in replays:
        translator = Translator(domain, replay.instance)
        good = dict[int, Subgoal]()
        for asked in replay.asked:
            _append(labels, replay, asked, translator, good)
    return labels


def _append(labels: Labels, replay: Replay, asked: Asked, translator: Translator, good: dict[int, Subgoal]) -> None:
    """Append the labels of one answer. `good` collects the right subgoals, by the number of the segment."""
    held = asked.record.answered
    if held is None or held.answer is None:
        return
    path, content = replay.path[asked.first : asked.end], held.answer.content
    match content:
        case wire.HierDemoAnswer() if path[0].subgoal is None:
            labels.append_flat(path, path[0].actions)
        case wire.HierDemoAnswer():
            labels.append_demonstration(path)
        case wire.LabelHiAnswer():
            subgoals = [translator.domain.subgoals.index(name) for name in content.subgoals]
            good.update(enumerate(subgoals, asked.first))
            labels.append_hi(path, subgoals)
        case wire.LabelLoAnswer():
            lo = translator.answer(content)
            assert isinstance(lo, LoLabels)
            labels.append_lo(path[0], lo, right_subgoal=good.get(asked.first) == path[0].subgoal)
        case wire.LabelFullAnswer():
            labels.append_flat(path, [translator.domain.actions.index(name) for name in content.actions])
        case wire.InspectAnswer():
            pass
