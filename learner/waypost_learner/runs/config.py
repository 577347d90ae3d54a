"""What fixes a run (with the answers, these values determine every query and every weight), and where one stands."""

from dataclasses import dataclass


@dataclass(frozen=True)
class TrainConfig:
    """The values of `waypost train`."""

    algorithm: str
    domain: str = "maze"
    instances: str = "random"
    preset: str = "lean"
    seed: int = 0
    episodes: int = 1_000
    in_flight: int = 1  # episodes open at once; 1 is the paper's loop
    warm_start: int | None = None  # demonstrations before questions; the preset's number unless given
    redraw: bool = False  # draw training instances until one fails, as the authors counted episodes
    head_start: float | None = None  # this share of an optimal trajectory is carried out before the learner begins
    values: str | None = None  # other values than the preset's: "relabeling=false train_hi.batch=32"


@dataclass(frozen=True)
class Progress:
    """Where a run stands, between two episodes."""

    episodes: int = 0  # applied
    draws: int = 0  # training instances drawn; more than episodes where they are drawn until one fails
    passes: int = 0  # inspections of whole episodes passed in a row


START = Progress()
"""Where a run begins."""
