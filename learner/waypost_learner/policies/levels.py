"""Defines which policies a learner has, and whether each level learns by imitation or by reinforcement."""

from dataclasses import dataclass

from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi


@dataclass(frozen=True)
class Levels:
    """A hierarchy of mu and pi_g, or one flat policy; each level learns by imitation or by reinforcement."""

    flat: bool = False  # one flat policy instead of mu and pi_g
    q_hi: bool = False  # mu is a Q-function
    q_lo: bool = False  # each pi_g, or the flat policy, is a Q-function; the domain then ends subgoals, not beta_g

    @property
    def reinforced(self) -> bool:
        """Whether any policy is a Q-function."""
        return self.q_hi or self.q_lo

    @property
    def imitating(self) -> bool:
        """Whether any policy imitates."""
        return not self.q_lo or not (self.q_hi or self.flat)

    def keys(self, n_subgoals: int) -> list[PolicyKey]:
        """Return the keys of all policies."""
        return [FLAT] if self.flat else [META, *map(pi, range(n_subgoals))]

    def is_q_function(self, key: PolicyKey) -> bool:
        """Return whether a policy is a Q-function."""
        return self.q_hi if key == META else self.q_lo


HIERARCHY = Levels()
"""The paper's hierarchy: mu and pi_g, all imitating."""
