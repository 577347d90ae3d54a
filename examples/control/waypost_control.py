"""The upright pendulum: a domain with continuous torques, which are made discrete.

The environment is Gymnasium's `Pendulum-v1`. The task is to swing the pendulum up and to hold it upright for a second.
"""

import math
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
from numpy.typing import NDArray

import waypost

TORQUES = {"clockwise_2": -2.0, "clockwise_1": -1.0, "none": 0.0, "counter_1": 1.0, "counter_2": 2.0}
SIGNS = {"swing_clockwise": -1, "swing_counter": 1}  # of the speed; positive is counterclockwise
REPEAT = 2  # time steps of 0.05 seconds for which an action holds its torque
HOLD = 10  # actions, which last one second
GRAVITY, STRENGTH = 15.0, 3.0  # rad/s² for each unit of sin(angle), and of torque, in Pendulum-v1
RATE = math.sqrt(GRAVITY)  # 1/s, how fast an upright pendulum falls: the unstable eigenvalue

State = dict[str, Any]


class Holding(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Repeats each action, counts how long the pendulum is held upright, and ends the episode after a second of it."""

    held = 0  # actions
    turned = False  # whether the pendulum turned back during the last action

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Start at a random angle and speed."""
        self.held, self.turned = 0, False
        return self.env.reset(seed=seed, options=options)

    def step(self, action: Any) -> tuple[Any, SupportsFloat, bool, bool, dict[str, Any]]:
        """Apply a torque for a tenth of a second. The reward is the environment's own, of the last time step."""
        truncated, (_, before) = False, angle_and_speed(self)
        for _ in range(REPEAT):
            if not truncated:
                observation, reward, _, truncated, info = self.env.step(np.array(action, np.float32))
        angle, speed = angle_and_speed(self)
        self.turned = before * speed < 0
        self.held = self.held + 1 if abs(angle) < 0.2 and abs(speed) < 1 else 0
        return observation, reward, self.held == HOLD, truncated, info


def angle_and_speed(env: Any) -> tuple[float, float]:
    """Return the angle from upright, in radians from -pi to pi, and its change per second; both counterclockwise."""
    angle, speed = env.unwrapped.state
    return math.remainder(angle, 2 * math.pi), float(speed)


def view(env: Any) -> State:
    """Return what experts see of the environment's state."""
    angle, speed = angle_and_speed(env)
    return {"angle": round(angle, 4), "speed": round(speed, 4), "turned": env.turned, "held": env.held}


def observe(observation: Any) -> NDArray[np.float32]:
    """Return cos and sin of the angle, and the speed divided by its largest value, 8."""
    return np.asarray(observation / [1, 1, 8], np.float32)


# --- the expert: energy control to swing up, and linear feedback to hold (Åström and Furuta 2000)


def catchable(state: State) -> bool:
    """Return whether the torque is strong enough to stop the fall. The linear model's exact limit is 2 / 5."""
    return bool(abs(state["angle"]) < 0.6 and abs(state["angle"] + state["speed"] / RATE) < 0.3)


def good_subgoals(state: State) -> list[str]:
    """Hold the pendulum where it can be caught; elsewhere swing on in the direction in which it moves."""
    if succeeded(state):
        return []
    if catchable(state):
        return ["hold"]
    return [swing for swing, sign in SIGNS.items() if sign * state["speed"] >= 0]


def reached(origin: State, state: State, subgoal: str) -> bool:
    """A swing ends where the pendulum turns back or can be caught; holding ends after a second."""
    del origin
    if subgoal == "hold":
        return succeeded(state)
    return catchable(state) or bool(state["turned"] and SIGNS[subgoal] * state["speed"] < 0)


def good_actions(origin: State, state: State, subgoal: str) -> list[str]:
    """Return the torque nearest to the controller's."""
    if succeeded(state) or reached(origin, state, subgoal):
        return []
    angle, speed = state["angle"], state["speed"]
    if subgoal == "hold":
        wanted = -8 * angle - 2 * speed
    else:
        energy = speed**2 / 2 + GRAVITY * (math.cos(angle) - 1)  # relative to resting upright
        wanted = -2 * energy * SIGNS[subgoal]
    return [min(TORQUES, key=lambda name: abs(TORQUES[name] - wanted))]


def succeeded(state: State) -> bool:
    """Return whether the pendulum was held upright for a second."""
    return bool(state["held"] == HOLD)


upright_pendulum = waypost.domain(
    lambda: Holding(gymnasium.make("Pendulum-v1", render_mode="rgb_array")),
    name="upright-pendulum",
    subgoals=[*SIGNS, "hold"],
    actions={name: [torque] for name, torque in TORQUES.items()},
    horizons=(30, 15, 100),
    observe=observe,
    state=view,
    succeeded=succeeded,
    reached=reached,
    good_subgoals=good_subgoals,
    good_actions=good_actions,
)
