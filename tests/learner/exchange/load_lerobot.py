"""Loads an export with LeRobot's own loader, takes a training step on it, and prints what it found as JSON.

It runs in the environment of `scripts/lerobot-venv`: python load_lerobot.py REPO_ID FOLDER
"""

import json
import sys

import torch
from lerobot.datasets import LeRobotDataset

dataset = LeRobotDataset(sys.argv[1], root=sys.argv[2])
frames = [dataset[place] for place in range(len(dataset))]


def column(name: str) -> list[object]:
    """One value of each frame."""
    return [one[name] if isinstance(one[name], str) else one[name].tolist() for one in frames]


batch = next(iter(torch.utils.data.DataLoader(dataset, batch_size=16, collate_fn=list)))
states = torch.stack([one["observation.state"] for one in batch])
actions = torch.stack([one["action"] for one in batch])
torch.manual_seed(0)
network = torch.nn.Linear(states.shape[1], actions.shape[1])
optimizer = torch.optim.SGD(network.parameters(), lr=0.1)
before = torch.nn.functional.cross_entropy(network(states), actions)
before.backward()
optimizer.step()
after = torch.nn.functional.cross_entropy(network(states), actions)

names = [name for name in dataset.features if not name.startswith("language")]
found = {name: column(name) for name in names}
found |= {"language": [one["language_persistent"] for one in frames], "losses": [before.item(), after.item()]}
print(json.dumps(found))
