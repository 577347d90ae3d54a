"""One network for all policies, which plans by spreading fields over pictures, and is told nothing of the domain."""
