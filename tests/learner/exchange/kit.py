"""What the tests of exports are written with: stores with a finished run, and the command line."""

from pathlib import Path
from typing import Any

from click.testing import Result
from tests.learner.kit import corridor, store
from typer.testing import CliRunner

from waypost import wire
from waypost_learner import cli
from waypost_learner.experts.bot import Bot
from waypost_learner.remote.connection import Connection
from waypost_learner.runs.training import train


def waypost(*arguments: str | Path) -> Result:
    """Run a command."""
    return CliRunner().invoke(cli.app, [str(one) for one in arguments])


def done(*arguments: str | Path) -> str:
    """Run a command that must succeed; return what it printed."""
    result = waypost(*arguments)
    assert result.exit_code == 0, result.output + repr(result.exception)
    return result.stdout


def refused(*arguments: str | Path) -> str:
    """Run a command that must be refused; return its one sentence."""
    result = waypost(*arguments)
    assert result.exit_code == 2, result.output + repr(result.exception)
    (sentence,) = result.stderr.splitlines()
    return sentence


def trained(folder: Path, **values: Any) -> dict[str, Any]:
    """Train a run in the store of a folder; return its summary."""
    with store(folder) as (connection, options):
        return train(corridor(**values), connection, options)


class AnsweredWhenAwaited:
    """A learner's client; a bot answers when the learner waits, as people would. Queries for people have pictures."""

    def __init__(self, connection: Connection) -> None:
        assert connection.annotator is not None
        self._client, self._bot = connection.learner, Bot(connection.annotator)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._client, name)

    def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
        self._bot.work(wait=0)
        return self._client.answers(run, after, wait)


def trained_with_pictures(folder: Path, **values: Any) -> dict[str, Any]:
    """The same, with pictures in the queries."""
    with store(folder) as (connection, options):
        client: Any = AnsweredWhenAwaited(connection)
        return train(corridor(**values), Connection(client, None), options)
