"""`Planning`: the planner of `ial explore`, as its options say."""

from dataclasses import dataclass

from ial.active.belief import Belief
from ial.active.decision import Planner
from ial.active.direction_choice import Weights
from ial.active.planners.entropy import EntropyPlanner, TargetPlanner
from ial.active.planners.hops import Hops
from ial.active.planners.nearest_frontier import NearestFrontierPlanner
from ial.active.planners.random_walk import RandomPlanner
from ial.active.planners.route import Route
from ial.active.planners.two_stage import Options, TwoStagePlanner
from ial.cli.active.options import PlannerName
from ial.errors import ConfigError

HOPS = Hops()
"""How every planner gets on: no drive is longer, so none takes longer than one of that length."""

_ROUTE = Route(hops=HOPS)


@dataclass(frozen=True)
class Planning:
    """What chooses.

    Parameters
    ----------
    name
        Which planner.
    alpha, beta
        As in `Weights`; its defaults where None.
    raw
        As in `Weights`.
    guaranteed
        As in `Options`.
    seed
        What others than `direction` draw from.

    Raises
    ------
    ConfigError
        If a weight is negative, or one is given that this planner does not have.
    """

    name: PlannerName
    alpha: float | None = None
    beta: float | None = None
    raw: bool = False
    guaranteed: bool = False
    seed: int = 0

    def __post_init__(self) -> None:
        given = {"--alpha": self.alpha is not None, "--beta": self.beta is not None, "--raw": self.raw, "--guaranteed": self.guaranteed}
        foreign = [option for option, said in given.items() if said]
        if foreign and self.name != "direction":
            raise ConfigError(f"{', '.join(foreign)}: not an option of the planner {self.name}; leave it out, or take --planner direction")
        self._weights()

    def planner(self, belief: Belief) -> Planner[Belief]:
        """Return the planner of one run."""
        if self.name == "direction":
            return TwoStagePlanner(belief, Options(weights=self._weights(), guaranteed=self.guaranteed, route=_ROUTE))
        if self.name == "entropy":
            return EntropyPlanner(belief, HOPS.hop_m / 2.0, seed=self.seed)
        if self.name == "target":
            return TargetPlanner(belief, seed=self.seed, route=_ROUTE)
        return RandomPlanner(self.seed, HOPS) if self.name == "random" else NearestFrontierPlanner(belief, _ROUTE)

    def _weights(self) -> Weights:
        usual = Weights()
        alpha = usual.alpha if self.alpha is None else self.alpha
        return Weights(alpha, usual.beta if self.beta is None else self.beta, raw=self.raw)
