"""Defines which of a domain's declarations a learner uses: a preset's values for symmetries, views and relabeling."""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class DomainUse:
    """Which parts of a domain's declared symmetries and structure (`waypost.domains`) a learner uses.

    A value has no effect in a domain without the corresponding declaration.
    """

    symmetries: bool = False  # whether each label is also learned in every symmetry of the domain
    tied: bool = False  # whether subgoals that are equal up to a symmetry share one network; needs `symmetries`
    views: bool = False  # whether policies see the domain's views instead of whole observations
    # Whether policies see the domain's centered view; with `views`, only policies that imitate, for choosing actions.
    centered: bool = False
    crop: bool = False  # whether policies of subgoals see the domain's crop when they choose actions
    planning: int | None = None  # features of each place for networks that plan over a view; no planning if None
    relabeling: bool = False  # whether labels and demonstrations also give labels of other tasks

    def __post_init__(self) -> None:
        """Refuse values that contradict each other.

        Raises:
            ValueError: a value needs another value; the message names both and says what to write.
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

    @property
    def without_views(self) -> "DomainUse":
        """What is used where all policies see whole observations, as those that share a network do."""
        return replace(self, views=False, centered=False, crop=False, planning=None)


NOTHING_DECLARED = DomainUse()
"""Uses no declaration of a domain, like the paper."""
