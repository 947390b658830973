"""`DecisionTree`: the decisions of an exploration as a depth-first search: what led on from where, and what was left open."""

from dataclasses import dataclass, field

from ial.lidar.estimate import Status
from ial.results.active.leg import Leg


@dataclass
class Branching:
    """A decision that began something, with those that went on with it.

    Parameters
    ----------
    first
        Its number; 0 is the first look.
    stage
        What chose it.
    parent
        The index of the node from which it led on; None for the first look.
    lane
        Its row: that of its parent, or a new one if the robot drove back.
    drives
        How many drives it took.
    hypotheses, status
        What is known after the last of them.
    collisions
        How many of them ended early.
    left
        How many frontiers that were first known here are left at the end.
    """

    first: int
    stage: str
    parent: int | None
    lane: int
    drives: int = 0
    hypotheses: int = 0
    status: Status = "blind"
    collisions: int = 0
    left: int = 0


@dataclass
class DecisionTree:
    """The tree of an exploration.

    Parameters
    ----------
    nodes
        In the order of time.
    """

    nodes: list[Branching] = field(default_factory=list)
    _of_decision: list[int] = field(default_factory=list)  # the node of each decision, by its number

    def add(self, leg: Leg) -> None:
        """Take the next decision."""
        decision = leg.taken.decision
        if decision is None or not decision.goes_on or not self.nodes:
            self.nodes.append(self._begun(leg))
        node = self.nodes[-1]
        self._of_decision.append(len(self.nodes) - 1)
        node.drives += leg.drives
        node.hypotheses, node.status = leg.hypotheses, leg.estimate.status
        node.collisions += leg.taken.collided
        for each in self.nodes:
            each.left = 0
        for since in decision.open if decision is not None else ():
            self.nodes[self._before(since)].left += 1

    def _begun(self, leg: Leg) -> Branching:
        decision = leg.taken.decision
        if decision is None or not self.nodes:
            return Branching(leg.number, "first look", None, 0)
        since = decision.since if decision.stage == "backtrack" else None
        parent = len(self.nodes) - 1 if since is None else self._before(since)
        on = parent == len(self.nodes) - 1
        lane = self.nodes[parent].lane if on else 1 + max(each.lane for each in self.nodes)
        return Branching(leg.number, decision.stage, parent, lane)

    def _before(self, decision: int) -> int:
        """Return the node at the end of which a decision was made."""
        return self._of_decision[min(decision, len(self._of_decision)) - 1]
