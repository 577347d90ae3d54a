"""Names of policies and of their data buffers."""

PolicyKey = int
"""Names a policy and its data buffer: pi_g and D_g have the key g, and these two have keys of their own."""
META: PolicyKey = -1
FLAT: PolicyKey = -2
