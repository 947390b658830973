"""Where to drive next in order to be localized (Goyal, Krishna, Bhuvanagiri).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.active.belief import Belief as Belief
    from ial.active.belief import Groups as Groups
    from ial.active.decision import Decision as Decision
    from ial.active.decision import Planner as Planner
    from ial.active.direction_choice import Weights as Weights
    from ial.active.exploration import ExplorationStep as ExplorationStep
    from ial.active.exploration import explore as explore
    from ial.active.knowledge import Knowledge as Knowledge
    from ial.active.planners.entropy import EntropyPlanner as EntropyPlanner
    from ial.active.planners.entropy import TargetPlanner as TargetPlanner
    from ial.active.planners.hops import Hops as Hops
    from ial.active.planners.nearest_frontier import NearestFrontierPlanner as NearestFrontierPlanner
    from ial.active.planners.random_walk import RandomPlanner as RandomPlanner
    from ial.active.planners.route import Route as Route
    from ial.active.planners.two_stage import Options as Options
    from ial.active.planners.two_stage import TwoStagePlanner as TwoStagePlanner
    from ial.active.robot import Drive as Drive
    from ial.active.robot import Driven as Driven
    from ial.active.robot import Robot as Robot
    from ial.active.simulated_robot import Errors as Errors
    from ial.active.simulated_robot import SimulatedRobot as SimulatedRobot
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "belief": ("Belief", "Groups"),
            "decision": ("Decision", "Planner"),
            "direction_choice": ("Weights",),
            "exploration": ("ExplorationStep", "explore"),
            "knowledge": ("Knowledge",),
            "planners.entropy": ("EntropyPlanner", "TargetPlanner"),
            "planners.hops": ("Hops",),
            "planners.nearest_frontier": ("NearestFrontierPlanner",),
            "planners.random_walk": ("RandomPlanner",),
            "planners.route": ("Route",),
            "planners.two_stage": ("Options", "TwoStagePlanner"),
            "robot": ("Drive", "Driven", "Robot"),
            "simulated_robot": ("Errors", "SimulatedRobot"),
        },
    )
