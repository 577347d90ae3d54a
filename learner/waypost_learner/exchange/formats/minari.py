"""Minari: the learner's rollouts and the demonstrations as episodes, in HDF5, with what the expert said at each step.

Minari's Arrow format writes infos per step but fails to read them, so the format is always HDF5.
"""

import re
from collections.abc import Iterable, Iterator
from importlib.metadata import version
from pathlib import Path

import numpy as np
from minari.data_collector import EpisodeBuffer
from minari.dataset.minari_storage import MinariStorage

from waypost import wire
from waypost_learner.exchange.replay import Replayer
from waypost_learner.exchange.steps import DESCRIPTION, Steps, steps_of

_LIST = "\n".join(f"- `{name}`: {meaning}." for name, meaning in DESCRIPTION.items())
FIELDS = f"""\
`MINARI_DATASETS_PATH=FOLDER` and `minari.load_dataset(NAME)` load the dataset: FOLDER is this folder, and NAME is the
folder in it. One Minari episode is one rollout of the learner or one demonstration. Episodes of the run without
queries are not in it. Each episode has T actions, T rewards and T + 1 observations, and the following `infos` with
T + 1 entries, one per state:

{_LIST}"""


def write(records: Iterable[wire.Record], folder: Path) -> None:
    """Write the episodes of a run as a Minari dataset in a folder of its own.

    Raises:
        ValueError: the paths of the run cannot be replayed.
    """
    stream = iter(records)
    first = next(stream)
    assert isinstance(first, wire.RunRecord)
    run, replayer = first.run, Replayer(first.run)
    env = replayer.domain.make_env()
    name = dataset_id(run)
    (folder / name).mkdir()
    storage = MinariStorage.new(
        (folder / name / "data").resolve(),  # with a relative path, Minari does not find its own file
        observation_space=env.observation_space,
        action_space=env.action_space,
        data_format="hdf5",
        jpeg_encoding=False,  # JPEG would change pictures
    )
    storage.update_metadata(
        {
            "dataset_id": name,
            "algorithm_name": run.algorithm,
            "description": f"Run {run.id} of Waypost: {run.name}. README.md describes the fields.",
            "subgoals": list(run.vocabulary.subgoals),
            "actions": list(run.vocabulary.actions),
            "minari_version": version("minari"),
        }
    )
    storage.update_episodes(_buffers(replayer, stream))


def dataset_id(run: wire.Run) -> str:
    """Return the name of a run's Minari dataset."""
    return f"waypost-{re.sub(r'[^-_a-zA-Z0-9]', '-', run.vocabulary.domain)}-{run.id}-v0"


def _buffers(replayer: Replayer, records: Iterator[wire.Record]) -> Iterator[EpisodeBuffer]:
    for _, replays in replayer.episodes(records):
        for replay in replays:
            yield _buffer(steps_of(replayer.domain, replay))


def _buffer(steps: Steps) -> EpisodeBuffer:
    last = np.arange(len(steps.actions)) == len(steps.actions) - 1
    return EpisodeBuffer(
        observations=steps.observations,
        actions=steps.actions,
        rewards=steps.rewards,
        terminations=last & steps.terminated,
        truncations=last & (not steps.terminated),
        infos=steps.infos,
    )
