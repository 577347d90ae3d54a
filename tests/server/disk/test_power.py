"""A power loss at any moment loses nothing that was acknowledged, and leaves a sound store."""

import os
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest
from tests.server.disk.disk import Call, File, Record
from tests.server.disk.images import Loss, Platter, losses
from tests.server.disk.recording import Recording

N_ANSWERS = 48
N_ANNOTATORS = 3
SEED = 20261126


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """A server that is killed after half of the answers, and another one that is stopped at the end."""
    recording = Recording(tmp_path_factory.mktemp("recording"))
    people = recording.fill(N_ANSWERS, N_ANNOTATORS)
    recording.answer_and_end(people, SEED, N_ANSWERS // N_ANNOTATORS)
    return recording


def test_what_was_acknowledged_before_a_power_loss_is_kept_and_charged_once(recording: Recording) -> None:
    assert (len(recording.told.acknowledged()), set(recording.told.statuses)) == (N_ANSWERS, {200, 201})
    assert recording.told.heads
    synced = {one.file for one in recording.disk.records() if one.call is Call.SYNC}
    assert synced == {File.STORE, File.WAL, File.FOLDER}
    assert recording.wrong(recording.losses(SEED, step=9)) == Counter()


def test_on_a_disk_that_ignores_the_syncs_of_the_log_answers_are_lost(recording: Recording) -> None:
    careless = recording.losses(SEED, step=12, without=(Call.SYNC, File.WAL))
    assert recording.wrong(careless)["lost"] > 0


def test_a_seed_decides_which_parts_of_unsynced_writes_are_left(recording: Recording) -> None:
    def images(seed: int) -> list[dict[File, bytes]]:
        return [loss.image for loss in islice(recording.losses(seed), 30)]

    assert images(1) == images(1)
    assert images(1) != images(2)


def test_a_power_loss_while_a_store_is_created_leaves_none_or_a_sound_one(tmp_path: Path) -> None:
    recording = Recording(tmp_path)
    command = [sys.executable, "-m", "waypost_server.cli", "migrate", "--database", recording.disk.url]
    environment = {**os.environ, **recording.disk.environment}
    subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
    assert {File.JOURNAL, File.WAL} <= {one.file for one in recording.disk.records()}
    assert recording.wrong(recording.losses(SEED, step=5)) == Counter()


def happened(*calls: tuple[Call, bytes]) -> list[Record]:
    """The record of calls on a log that exists; what is written begins at the start of the file."""
    return [Record(call, File.WAL, False, 1, 0, content, n) for n, (call, content) in enumerate(calls)]


def left(folder: Path, records: list[Record]) -> list[Loss]:
    """The power losses of a store whose log was empty before."""
    (folder / "store.db-wal").touch()
    return list(losses(Platter(folder / "store.db"), records, [], SEED))


def test_what_was_synced_is_left_and_of_the_rest_some_sectors(tmp_path: Path) -> None:
    old, new = b"o" * 51_200, b"n" * 51_200
    records = happened((Call.WRITE, old), (Call.SYNC, b""), (Call.WRITE, new), (Call.SYNC, b""))
    images = [loss.image[File.WAL] for loss in left(tmp_path, records)]
    assert (images[0], images[2], images[4]) == (b"", old, new)
    parts = {images[3][start : start + 512] for start in range(0, 51_200, 512)}
    assert parts == {old[:512], new[:512]}


@pytest.mark.parametrize(("failed", "last"), [(False, b"nld"), (True, b"n")])
def test_what_was_written_before_a_failed_sync_may_never_arrive(tmp_path: Path, failed: bool, last: bytes) -> None:
    records = happened((Call.WRITE, b"old"), (Call.SYNC, b""), (Call.WRITE, b"n"), (Call.SYNC, b""))
    records[1] = replace(records[1], failed=failed)
    assert left(tmp_path, records)[-1].image[File.WAL] == last
