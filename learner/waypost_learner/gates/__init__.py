"""Gates of hg-gated: which choices of a rollout a learner doubts, so that only these are asked about."""

from waypost_learner.gates.aim import Aim
from waypost_learner.gates.gate import Gate, GateSpec
from waypost_learner.gates.lazy import Lazy
from waypost_learner.gates.thrifty import Thrifty

GATES: dict[str, type[Gate]] = {"aim": Aim, "lazy": Lazy, "thrifty": Thrifty}


def make_gate(spec: GateSpec, seed: int) -> Gate:
    """Return the gate that a preset names; the seed fixes the initial weights of its networks."""
    return GATES[spec.kind](spec.share, seed)
