"""The streams of randomness of a run.

Each stream is seeded by the run's seed, the stream and a number. So draws in one stream never change those in another.
"""

TRAIN = 0  # choices in training rollouts
TEST = 1  # choices in test rollouts
TRAIN_ORDER = 2  # order of the training instances
TEST_ORDER = 3  # order of the test instances
VARIATION = 4  # changes of a training instance each time it is drawn
MONITORING = 5  # which episodes are inspected under sampled monitoring
SEGMENT = 6  # the one segment of a rollout that hg-Stagger asks about
