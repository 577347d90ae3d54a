"""Stores the results of episodes that the learner reports."""

from collections.abc import Sequence

from sqlalchemy import insert, select

from waypost import wire
from waypost_server import errors
from waypost_server.db import canonical
from waypost_server.db.tables import episodes
from waypost_server.db.transaction import Tx
from waypost_server.runs import events
from waypost_server.runs import service as runs


def report(tx: Tx, run: str, results: Sequence[wire.EpisodeResult], user: int) -> wire.Run:
    """Store results. Reporting an episode again changes nothing, even if its duration differs.

    Raises:
        Forbidden: the user may not change the run.
        DifferentContent: an episode was reported before with another result.
        RunFinished: a finished run reports a new episode.
    """
    row = runs.lock_own(tx, run, user)
    numbers = [result.episode for result in results]
    stored = select(episodes.c.episode, episodes.c.result).where(
        episodes.c.run_id == run, episodes.c.episode.in_(numbers)
    )
    known = {found.episode: wire.EpisodeResult.model_validate_json(found.result) for found in tx.conn.execute(stored)}
    for result in results:
        if result.episode in known:
            # A learner that was killed repeats its last episodes, and their durations differ.
            if known[result.episode].model_copy(update={"seconds": result.seconds}) != result:
                raise errors.DifferentContent(f"Episode {result.episode} was reported before, with another result.")
            continue
        if row.state == "finished":
            raise errors.RunFinished("The run is finished, so it cannot report new episodes.")
        known[result.episode] = result
        _insert(tx, run, result)
    return runs.view(tx, run)


def _insert(tx: Tx, run: str, result: wire.EpisodeResult) -> None:
    tx.conn.execute(
        insert(episodes).values(
            run_id=run,
            episode=result.episode,
            test_success=result.test_success,
            result=canonical.text(result.model_dump(mode="json")),
            created_at=tx.now,
        )
    )
    data = {"episode": result.episode, "train_success": result.train_success, "test_success": result.test_success}
    events.add(tx, run, "episode", data)
