"""Implements the halving algorithm (Shalev-Shwartz 2012; Le et al. 2018, section 4.2) on finite policy classes.

It "maintains a version space over policies, acts by a majority decision, and when it makes a mistake, it removes all
the erring policies from the version space". With more than two choices, it takes the choice with most votes. If this
choice is wrong, the correct choice has at most as many votes. So each mistake leaves at most half of the version space,
and there are at most log2(size of the class) mistakes.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from waypost_learner.experiments.theory.classes import N_ACTIONS, Classes
from waypost_learner.policies.datasets import UNLABELED, Row

Observation = NDArray[np.float32]  # [2], the positions u and x


class VersionSpace(ABC):
    """The remaining policies of a class, which act by majority."""

    def __init__(self) -> None:
        self.mistakes = 0
        self.recount()

    def recount(self) -> None:
        """Count the votes of the remaining policies for every place in the tables."""
        self.votes = self.count()  # [places.., choices], exact
        self.choices = self.votes.argmax(-1)  # [places..], the first choice with most votes

    @property
    def size(self) -> int:
        """The number of remaining policies. Each has one vote in every place, so the votes of one place are enough."""
        return int(self.votes.reshape(-1, self.votes.shape[-1])[0].sum())

    @abstractmethod
    def count(self) -> NDArray[np.float64]:
        """Return the number of remaining policies that take each choice, [places.., choices]."""

    @abstractmethod
    def place(self, observation: Observation) -> tuple[int, ...]:
        """Return the index of a state in the tables."""

    @abstractmethod
    def remove_erring(self, place: tuple[int, ...], choice: int) -> None:
        """Remove the policies that do not take the expert's choice."""

    def choose(self, observation: Observation) -> int:
        """Return the choice of the majority."""
        return int(self.choices[self.place(observation)])

    def learn(self, rows: Iterable[Row]) -> None:
        """Learn from labels, one after the other."""
        for row in rows:
            if row.choice not in (UNLABELED, self.choose(row.observation)):
                self.mistakes += 1
                self.remove_erring(self.place(row.observation), row.choice)
                self.recount()


class Simple(VersionSpace):
    """A class of tables over the current position x: M for mu, or Pi_LO for one pi_g."""

    def __init__(self, tables: NDArray[np.int64], n_choices: int) -> None:
        self.tables = tables  # [N, positions]
        self.left = np.ones(len(tables), bool)  # [N]
        self._n_choices = n_choices
        super().__init__()

    def count(self) -> NDArray[np.float64]:
        """Return the votes, [x, choices]."""
        takes = self.tables[self.left, :, None] == np.arange(self._n_choices)
        votes: NDArray[np.float64] = takes.sum(axis=0, dtype=np.float64)
        return votes

    def place(self, observation: Observation) -> tuple[int, ...]:
        """Return x."""
        return (int(observation[1]),)

    def remove_erring(self, place: tuple[int, ...], choice: int) -> None:
        """Remove the policies that do not take the expert's choice."""
        self.left &= self.tables[:, place[0]] == choice


class Product(VersionSpace):
    """The class Pi_FULL = {(mu, {pi_g})} of flat policies, which act by pi_{mu(u)}(x).

    The votes are exact although the class is never enumerated. For a fixed mu, a label at (u, x) restricts only the
    subpolicy of g = mu(u). So the remaining policies with this mu are always a product of sets, one per subgoal.
    `left[mu, g]` marks the remaining subpolicies for g. The number of policies is the sum over mu of the products over
    g of these counts.

    Raises:
        ValueError: the class has more policies than floating-point numbers can count exactly.
    """

    def __init__(self, classes: Classes) -> None:
        n_mu, n_pi, n_subgoals = len(classes.mu), len(classes.pi), len(classes.pi_star)
        if n_mu * n_pi**n_subgoals > 2**53:
            raise ValueError(f"{n_mu} times {n_pi} to the power of {n_subgoals} policies are too many to count exactly")
        self._mu = classes.mu  # [|M|, positions]
        self._takes = np.moveaxis(classes.pi[..., None] == np.arange(N_ACTIONS), 0, 1).astype(float)  # [x, |Pi_LO|, a]
        self.left = np.ones((n_mu, n_subgoals, n_pi), bool)
        super().__init__()

    def count(self) -> NDArray[np.float64]:
        """Return the votes, [u, x, actions]."""
        n_left = self.left.sum(axis=2).astype(float)  # [|M|, |G|]
        acting = np.zeros((self._mu.shape[1], self.left.shape[2]))  # [u, |Pi_LO|], full policies that act by each pi
        for g in range(self.left.shape[1]):
            with_each = np.delete(n_left, g, axis=1).prod(axis=1)[:, None] * self.left[:, g]  # [|M|, |Pi_LO|]
            acting += (self._mu == g).T.astype(float) @ with_each
        return np.moveaxis(acting @ self._takes, 0, 1)

    def place(self, observation: Observation) -> tuple[int, ...]:
        """Return u and x."""
        return int(observation[0]), int(observation[1])

    def remove_erring(self, place: tuple[int, ...], choice: int) -> None:
        """Remove the policies that do not take the expert's action."""
        u, x = place
        self.left[np.arange(len(self.left)), self._mu[:, u]] &= self._takes[x, :, choice] > 0
