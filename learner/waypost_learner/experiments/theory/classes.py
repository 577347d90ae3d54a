"""Draws the finite policy classes M and Pi_LO of the analysis (Le et al. 2018, section 4.2).

A policy is a table from positions to choices. Each class contains the expert's policies, so the task is realizable.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

N_POSITIONS = 64
N_ACTIONS = 2


@dataclass(frozen=True)
class Cell:
    """One setting of the analysis: horizons and sizes of the classes."""

    h_hi: int  # H_HI, segments in an episode
    h_lo: int  # H_LO, actions in a segment; at least 2
    n_mu: int  # |M|
    n_pi: int  # |Pi_LO|
    n_subgoals: int  # |G|; at least 2


@dataclass(frozen=True)
class Classes:
    """M and Pi_LO, and the expert's policies, which they contain."""

    mu: NDArray[np.int64]  # [|M|, N_POSITIONS], subgoals
    pi: NDArray[np.int64]  # [|Pi_LO|, N_POSITIONS], actions
    mu_star: NDArray[np.int64]  # [N_POSITIONS], a row of M
    pi_star: NDArray[np.int64]  # [|G|, N_POSITIONS], rows of Pi_LO

    @property
    def n_used(self) -> int:
        """|G_opt|, the number of subgoals that mu* uses."""
        return len(np.unique(self.mu_star))


def draw_classes(cell: Cell, rng: np.random.Generator) -> Classes:
    """Draw M, Pi_LO and the expert's policies from them.

    At each position, a policy takes one of two possible choices with equal probability. So when the majority errs,
    about half of the class errs: a mistake removes about as few policies as the analysis allows.
    """
    possible = np.array([rng.choice(cell.n_subgoals, 2, replace=False) for _ in range(N_POSITIONS)])
    mu = possible[np.arange(N_POSITIONS), rng.integers(2, size=(cell.n_mu, N_POSITIONS))]
    pi = rng.integers(N_ACTIONS, size=(cell.n_pi, N_POSITIONS))
    rows = rng.choice(cell.n_pi, cell.n_subgoals, replace=cell.n_pi < cell.n_subgoals)
    return Classes(mu, pi, mu_star=mu[rng.integers(cell.n_mu)], pi_star=pi[rows])
