"""Which of a domain's declarations a learner uses: the values of a preset on symmetries, views and relabeling."""

from dataclasses import dataclass


@dataclass(frozen=True)
class DomainUse:
    """What a learner uses of the symmetries and the structure that a domain declares (`waypost.domain`).

    Values on declarations that a domain does not have, have no effect there.
    """

    symmetries: bool = False  # whether each label is also learned from in every symmetry of the domain
    tied: bool = False  # whether subgoals that are equal up to a symmetry share one network; needs `symmetries`
    views: bool = False  # whether policies are given the domain's views instead of whole observations
    planning: int | None = None  # features of each place for networks that plan over a view; no planning if None
    relabeling: bool = False  # whether labels and demonstrations are also learned from as labels for other tasks

    def __post_init__(self) -> None:
        """Refuse values that contradict each other.

        Raises:
            ValueError: one value needs another; the message says which and what to write.
        """
        if self.tied and not self.symmetries:
            raise ValueError(
                "tied=true needs symmetries=true, so that the shared network learns each subgoal's labels; "
                "write tied=false too"
            )
        if self.planning is not None and not self.views:
            raise ValueError(
                f"planning={self.planning} needs views=true, because networks plan over the places of a view; "
                "write planning=null too"
            )
        if self.planning is not None and self.planning < 1:
            raise ValueError(f"planning={self.planning} is no number of features; write 1 or more, or null")


NOTHING_DECLARED = DomainUse()
"""Uses no declaration of a domain, as the paper."""
