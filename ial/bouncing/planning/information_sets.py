"""`InformationSets`: everything that a robot may know at one moment, for all places where it can have started."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.graph import LabelledGraph


@dataclass(frozen=True, eq=False)
class InformationSets:
    """Several sets of vertices; the robot is in one of them, which its observations tell.

    Parameters
    ----------
    starts
        Set i is ``members[starts[i] : starts[i + 1]]``, int64 of shape (sets + 1,).
    members
        Vertices, int32.
    weights
        From how many first configurations the robot can have come to each member, with this knowledge; int64 of the same shape.
    elapsed
        The most observations that lead to each set, int64 of shape (sets,).
    """

    starts: npt.NDArray[np.int64]
    members: npt.NDArray[np.int32]
    weights: npt.NDArray[np.int64]
    elapsed: npt.NDArray[np.int64]

    def __repr__(self) -> str:
        return f"<InformationSets: {len(self)}>"

    @classmethod
    def everything(cls, graph: LabelledGraph) -> "InformationSets":
        """Return the one set of a robot that knows nothing."""
        count = len(graph)
        weights = np.ones(count, dtype=np.int64) if graph.weights is None else graph.weights.astype(np.int64)
        return cls(np.array([0, count]), np.arange(count, dtype=np.int32), weights, np.zeros(1, dtype=np.int64))

    @classmethod
    def united(
        cls,
        starts: npt.NDArray[np.int64],
        members: npt.NDArray[np.int32],
        counts: npt.NDArray[np.int64],
        elapsed: npt.NDArray[np.int64],
    ) -> "InformationSets":
        """Return sets of which equal ones are taken together: what happens next does not depend on how a set was reached."""
        numbers: dict[bytes, int] = {}
        sets: list[npt.NDArray[np.int32]] = []
        weights: list[npt.NDArray[np.int64]] = []
        latest: list[int] = []
        bounds = starts.tolist()
        for number, observed in enumerate(elapsed.tolist()):
            chosen = slice(bounds[number], bounds[number + 1])
            order = np.argsort(members[chosen])
            held, weight = members[chosen][order], counts[chosen][order]
            at = numbers.setdefault(held.tobytes(), len(sets))
            if at == len(sets):
                sets.append(held)
                weights.append(weight)
                latest.append(observed)
            else:
                weights[at] = weights[at] + weight
                latest[at] = max(latest[at], observed)
        sizes = [len(each) for each in sets]
        return cls(np.concatenate([[0], np.cumsum(sizes)]), np.concatenate(sets), np.concatenate(weights), np.array(latest))

    def __len__(self) -> int:
        return len(self.elapsed)

    def uncertainty(self, graph: LabelledGraph) -> npt.NDArray[np.int64]:
        """Return how many configurations each set stands for, int64 of shape (sets,)."""
        if graph.weights is None:
            return np.diff(self.starts)
        return np.add.reduceat(graph.weights[self.members].astype(np.int64), self.starts[:-1])

    def mean(self, graph: LabelledGraph) -> Fraction:
        """Return the uncertainty that a robot ends with on average, if all first configurations are equally likely."""
        weights = np.add.reduceat(self.weights, self.starts[:-1])
        return Fraction(int(weights @ self.uncertainty(graph)), int(weights.sum()))
