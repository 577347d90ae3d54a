"""Names of policies: mu, one pi_g per subgoal, or one flat policy. Each has one data buffer of the same name."""

from dataclasses import dataclass
from typing import Literal

from waypost.trajectory import Subgoal

_NUMBERS = {"hi": -1, "flat": -2}  # the numbers of policies without a subgoal


@dataclass(frozen=True)
class PolicyKey:
    """Names one policy and its data buffer.

    Args:
        level: "hi" for mu and D_HI, "lo" for pi_g and D_g, "flat" for a flat policy and its D.
        subgoal: g, for a policy of level "lo"; None for the others.

    Raises:
        ValueError: a "lo" policy without a subgoal, or another policy with one.
    """

    level: Literal["hi", "lo", "flat"]
    subgoal: Subgoal | None = None

    def __post_init__(self) -> None:
        if (self.level == "lo") != (self.subgoal is not None):
            raise ValueError(f"a policy of level {self.level!r} cannot have the subgoal {self.subgoal!r}")

    @property
    def number(self) -> int:
        """The number that stands for the policy in seeds and in checkpoints: g for pi_g, -1 for mu, -2 for flat."""
        return _NUMBERS[self.level] if self.subgoal is None else self.subgoal

    @classmethod
    def of_number(cls, number: int) -> "PolicyKey":
        """Return the key whose `number` this is."""
        return {-1: META, -2: FLAT}.get(number) or cls("lo", number)


META = PolicyKey("hi")
FLAT = PolicyKey("flat")


def pi(subgoal: Subgoal) -> PolicyKey:
    """Return the key of pi_g, the policy that pursues a subgoal."""
    return PolicyKey("lo", subgoal)
