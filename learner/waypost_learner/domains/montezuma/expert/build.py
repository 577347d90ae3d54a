"""Compute the expert's table from the emulator: `waypost domain build montezuma`. It takes some minutes."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from waypost_learner.domains.montezuma import table
from waypost_learner.domains.montezuma.expert import collisions
from waypost_learner.domains.montezuma.expert.collisions import Deadly
from waypost_learner.domains.montezuma.expert.graph import Graph, explore
from waypost_learner.domains.montezuma.expert.planning import plan
from waypost_learner.domains.montezuma.game import Game

_KEPT_EVERY = 250  # nodes

Progress = Callable[[str, int, int], None]
"""Called with what is computed, how much of it is done, and how much is known to do."""


def build(file: Path, progress: Progress) -> None:
    """Compute the table and write it to a file.

    Beside the file, what was measured is kept until the end, so that an interrupted command continues there.
    """
    file.parent.mkdir(parents=True, exist_ok=True)  # not only after minutes
    kept_graph, kept_measured = (file.with_name(f"{file.name}.{part}.npz") for part in ("graph", "skull"))
    if kept_graph.exists():
        graph = _read_graph(kept_graph)
    else:
        graph = explore(lambda done, known: progress("states of the figure", done, known))
        _write_graph(kept_graph, graph)
    measured = _read_measured(kept_measured) if kept_measured.exists() else {}
    game = Game()
    for done, node in enumerate(graph.snapshots):
        if node not in measured:
            measured[node] = collisions.measure(graph, node, game)
            if (done + 1) % _KEPT_EVERY == 0:
                _write(kept_measured, nodes=np.array(list(measured)), deadly=np.array(list(measured.values())))
        progress("collisions with the skull", done + 1, len(graph.snapshots))
    table.write(file, plan(graph, collisions.everywhere(graph, measured)))
    kept_graph.unlink()
    kept_measured.unlink(missing_ok=True)


def _write_graph(file: Path, graph: Graph) -> None:
    snapshots = np.array([np.frombuffer(one, np.uint8) for one in graph.snapshots.values()])
    _write(
        file,
        nodes=graph.nodes,
        at_stair=graph.at_stair,
        after=graph.after,
        near_floor=np.array(list(graph.snapshots)),
        snapshots=snapshots,
    )


def _read_graph(file: Path) -> Graph:
    with np.load(file, allow_pickle=False) as found:
        snapshots = {
            int(node): one.tobytes() for node, one in zip(found["near_floor"], found["snapshots"], strict=True)
        }
        return Graph(found["nodes"], found["at_stair"], found["after"], snapshots)


def _read_measured(file: Path) -> dict[int, Deadly]:
    with np.load(file, allow_pickle=False) as found:
        return {int(node): deadly for node, deadly in zip(found["nodes"], found["deadly"], strict=True)}


def _write(file: Path, **arrays: np.ndarray) -> None:
    """Write arrays to a file at once, so that an interruption leaves no half of it."""
    temporary = file.with_suffix(".tmp.npz")
    np.savez(temporary, allow_pickle=False, **arrays)
    temporary.replace(file)
