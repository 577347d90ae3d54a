"""LeRobotDataset v3: one frame per step, subgoals as persistent language rows, corrections as `intervention`.

LeRobot writes the frames. Its recorder refuses language columns, so they are added to its files afterwards, as in
LeRobot's own annotation pipeline.
"""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import datasets
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from lerobot.datasets import LANGUAGE_EVENTS, LANGUAGE_PERSISTENT, LeRobotDataset
from lerobot.datasets.language import language_feature_info
from numpy.typing import NDArray

from waypost import wire
from waypost.domains import Domain
from waypost_learner.exchange.replay import Replayer
from waypost_learner.exchange.steps import DESCRIPTION, UNSAID, Steps, steps_of

FPS = 10  # nominal: a step of an environment has no duration
STATE = ("segment", "subgoal", "expert_subgoal", "expert_action")  # about the state and the action of a frame
NEXT = ("expert_termination", "inspect_lo", "inspect_full")  # about the state after the action
AMOUNTS = ("units", "seconds", "active_seconds")  # booked at the state after the action

_LIST = "\n".join(
    [
        *(f"- `{name}`: {DESCRIPTION[name]}." for name in ("run_episode", "demonstrated", *STATE)),
        *(f"- `{name}_by`: {DESCRIPTION[f'{name}_by']}." for name in ("expert_subgoal", "expert_action")),
        *(f"- `next.{name}`: {DESCRIPTION[name]}. It is about the next state." for name in (*NEXT, *AMOUNTS)),
        f"- `next.annotator`: {DESCRIPTION['annotator']}. It is about the next state.",
    ]
)
FIELDS = f"""\
`LeRobotDataset("waypost/RUN", root=FOLDER)` loads the dataset: FOLDER is the folder `dataset` in this folder. One
LeRobot episode is one rollout of the learner or one demonstration. One frame is one step; {FPS} frames per second are
nominal. Episodes of the run without queries are not in it. Observations are flat vectors.

- `action`: the action to imitate, one-hot: the expert's if the expert gave one, else the action that was carried out.
- `executed_action`: the number of the action that was carried out.
- `intervention`: whether the expert's action differs from the one that was carried out. The expert gave it
  afterwards, so the next frame follows `executed_action`.
- `language_persistent`: one row of style `subtask` for each segment: its subgoal, from the segment's first frame on.
{_LIST}"""

_ROW = pa.struct(
    {
        "role": pa.string(),
        "content": pa.string(),
        "style": pa.string(),
        "timestamp": pa.float32(),
        "camera": pa.string(),
        "tool_calls": pa.list_(pa.string()),
    }
)
_EVENT = pa.struct([field for field in _ROW if field.name != "timestamp"])


def write(records: Iterable[wire.Record], folder: Path) -> None:
    """Write the episodes of a run as a LeRobotDataset in the folder `dataset`.

    Raises:
        ValueError: the paths of the run cannot be replayed.
    """
    datasets.disable_progress_bars()  # LeRobot shows one for each episode
    stream = iter(records)
    first = next(stream)
    assert isinstance(first, wire.RunRecord)
    replayer, root = Replayer(first.run), folder / "dataset"
    domain = replayer.domain
    dataset = LeRobotDataset.create(
        f"waypost/{first.run.id}", FPS, features_of(domain), root=root, robot_type=domain.name, use_videos=False
    )
    for _, replays in replayer.episodes(stream):
        for replay in replays:
            steps = steps_of(domain, replay)
            for place in range(len(steps.actions)):
                dataset.add_frame(_frame(domain, steps, place))
            dataset.save_episode()
    dataset.finalize()
    if domain.subgoals:
        for file in sorted(root.glob("data/*/*.parquet")):
            _add_language(file, domain.subgoals)
        _declare_language(root)


def features_of(domain: Domain) -> dict[str, dict[str, Any]]:
    """Return the features of a frame, as LeRobot declares them."""
    n = int(np.prod(domain.observation_shape))
    return {
        "observation.state": _feature("float32", n),
        "action": _feature("float32", len(domain.actions)) | {"names": list(domain.actions)},
        **{name: _feature("int64") for name in ("executed_action", "run_episode", *STATE)},
        **{name: _feature("bool") for name in ("demonstrated", "intervention", "next.done")},
        **{f"next.{name}": _feature("int64") for name in NEXT},
        **{f"next.{name}": _feature("float64") for name in AMOUNTS},
        "next.reward": _feature("float32"),
        **{name: _feature("string") for name in ("expert_subgoal_by", "expert_action_by", "next.annotator")},
    }


def _feature(dtype: str, n: int = 1) -> dict[str, Any]:
    return {"dtype": dtype, "shape": (n,), "names": None}


def _frame(domain: Domain, steps: Steps, place: int) -> dict[str, Any]:
    """Return the frame of one step: a state, its action, and what is known of the next state."""
    infos, executed = steps.infos, int(steps.actions[place])
    said = int(infos["expert_action"][place])
    imitated = executed if said == UNSAID else said
    last = place == len(steps.actions) - 1
    return {
        "observation.state": steps.observations[place].ravel(),
        "action": np.eye(len(domain.actions), dtype=np.float32)[imitated],
        "executed_action": _whole(executed),
        "intervention": _truth(imitated != executed),
        "demonstrated": _truth(infos["demonstrated"][place]),
        "next.done": _truth(last),
        "next.reward": np.array([steps.rewards[place]], np.float32),
        **{name: _whole(infos[name][place]) for name in ("run_episode", *STATE)},
        **{f"next.{name}": _whole(infos[name][place + 1]) for name in NEXT},
        **{f"next.{name}": np.array([infos[name][place + 1]], np.float64) for name in AMOUNTS},
        **{name: infos[name][place] for name in ("expert_subgoal_by", "expert_action_by")},
        "next.annotator": infos["annotator"][place + 1],
        "task": f"{domain.name}: carry out the whole task",
    }


def _whole(value: Any) -> NDArray[np.int64]:
    return np.array([value], np.int64)


def _truth(value: Any) -> NDArray[np.bool_]:
    return np.array([value], np.bool_)


# --- language columns


def _add_language(file: Path, subgoals: tuple[str, ...]) -> None:
    """Add both language columns to a data file. It has one row group per episode, so memory does not grow."""
    complete = file.with_suffix(".complete")
    with pq.ParquetFile(file) as episodes:
        schema = episodes.schema_arrow.remove_metadata()
        schema = schema.append(pa.field(LANGUAGE_PERSISTENT, pa.list_(_ROW)))
        schema = schema.append(pa.field(LANGUAGE_EVENTS, pa.list_(_EVENT)))
        with pq.ParquetWriter(complete, schema) as out:
            for number in range(episodes.num_row_groups):
                table = episodes.read_row_group(number)
                rows = _subtasks(table, subgoals)
                persistent = pa.array([rows] * len(table), pa.list_(_ROW))
                events = pa.array([[]] * len(table), pa.list_(_EVENT))
                out.write_table(pa.Table.from_arrays([*table.columns, persistent, events], schema=schema))
    complete.replace(file)


def _subtasks(table: pa.Table, subgoals: tuple[str, ...]) -> list[dict[str, Any]]:
    """Return one row for each segment of an episode; a flat episode has none."""
    columns = (table.column(name).to_pylist() for name in ("segment", "subgoal", "timestamp"))
    starts = {segment: (subgoal, at) for segment, subgoal, at in reversed(list(zip(*columns, strict=True)))}
    return [
        {"role": "assistant", "content": subgoals[subgoal].replace("_", " "), "style": "subtask", "timestamp": at}
        for _, (subgoal, at) in sorted(starts.items())
        if subgoal != UNSAID
    ]


def _declare_language(root: Path) -> None:
    path = root / "meta" / "info.json"
    info = json.loads(path.read_text(encoding="utf-8"))
    info["features"] |= language_feature_info()
    path.write_text(json.dumps(info, indent=4) + "\n", encoding="utf-8")
