"""Defines the maze with both departures of the authors' experiments: the expert plans for slips, and lava lasts."""

from waypost_learner.domains.maze.lasting_lava import LastingLavaMazeDomain, LastingLavaOracle
from waypost_learner.domains.maze.slips import SlipOracle


class AsAuthorsOracle(LastingLavaOracle, SlipOracle):
    """The expert that plans for slips; in lava, it says how to leave it."""


class AsAuthorsMazeDomain(LastingLavaMazeDomain):
    """The maze of the authors' experiments: lava does not end an episode, and the expert plans for slips."""

    name = "maze-as-authors"

    def __init__(self) -> None:
        self.oracle = AsAuthorsOracle()
