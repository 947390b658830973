"""`CompassModel`: a robot with a compass as a constraint problem over its places on the boundary."""

from ial.compass.primitive import Direction, primitive
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import Polygon
from ial.membership.model import Model


class CompassModel(Model[InformationState, Direction, None]):
    """Sets of places, exactly; a motion is a direction, and there is no reading.

    Only motions make a set smaller: two places can lead to one. So a set is never empty, and nothing is ever rejected. The first set is
    the boundary, and stands for the whole polygon: the first motion leads from both to the same places, see `Sequence`.

    Parameters
    ----------
    polygon
        The environment.

    Examples
    --------
    >>> from ial.maps import Polygon
    >>> from ial.membership import SetMembershipFilter
    >>> robot = SetMembershipFilter(CompassModel(Polygon(((0, 0), (4, 0), (4, 3), (0, 3)))))
    >>> for direction in ((1, 0), (0, 1)):
    ...     robot.update(direction, None)
    >>> robot.states
    <InformationState of 0 pieces and 1 points>
    """

    def __init__(self, polygon: Polygon) -> None:
        self.polygon = polygon
        self._transition = Transition(Shooter(polygon))

    def __repr__(self) -> str:
        return f"CompassModel({self.polygon!r})"

    def universe(self) -> InformationState:
        """Return the whole boundary."""
        return InformationState.boundary(self._transition.shooter)

    def predict(self, states: InformationState, motion: Direction) -> InformationState:
        """Return exactly the places to which a motion leads.

        Raises
        ------
        ConfigError
            If the motion is given in floats, or is (0, 0).
        """
        return self._transition(states, primitive(*motion))

    def step(self, states: InformationState, motion: Direction, reading: None) -> InformationState:
        """Return exactly the places to which a motion leads; the reading says nothing."""
        return self.predict(states, motion)

    def unite(self, allowed: InformationState, predicted: InformationState) -> InformationState:
        """Return the union."""
        return InformationState.of(self._transition.shooter, (*allowed.pieces, *predicted.pieces), (*allowed.points, *predicted.points))

    def empty(self, states: InformationState) -> bool:
        """Return whether no place is left."""
        return not states.pieces and not states.points
