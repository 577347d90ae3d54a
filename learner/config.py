"""What fixes a run: with the answers, these values determine every query and every weight."""

from dataclasses import dataclass


@dataclass(frozen=True)
class TrainConfig:
    """The values of `waypost train`."""

    algorithm: str
    domain: str = "maze"
    instances: str = "random"
    preset: str = "paper"
    seed: int = 0
    episodes: int = 1_000
    in_flight: int = 1  # episodes open at once; 1 is the paper's loop
    warm_start: int | None = None  # demonstrations before questions; the preset's number unless given
