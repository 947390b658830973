"""`CompassRobot`: a simulated robot that knows directions and feels walls, carried out exactly."""

from collections.abc import Sequence as Several
from typing import Any

from ial.compass.primitive import primitive
from ial.errors import MapError
from ial.maps.polygons.exact.rational import Rational, fraction, rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import ExactPoint, Polygon, common_denominator, scaled
from ial.maps.polygons.ring import side


class CompassRobot:
    """A point that drives in a direction of its compass until a wall stops it (O'Kane and LaValle 2007, section III).

    Parameters
    ----------
    polygon
        The environment.
    start
        Where it is at first, x and y in metres: inside or on a wall.

    Raises
    ------
    MapError
        If the start lies outside of the environment.

    Attributes
    ----------
    place
        Where it is, exactly. A real robot does not know that.

    Examples
    --------
    >>> from ial.maps import Polygon
    >>> robot = CompassRobot(Polygon(((0, 0), (4, 0), (4, 3), (0, 3))), (1, 1))
    >>> [str(number) for number in robot.drive(1, 3)]
    ['5/3', '3']
    """

    def __init__(self, polygon: Polygon, start: Several[Rational | int]) -> None:
        x, y = (fraction(rational(each)) for each in start)
        scale = common_denominator([*polygon.rings, ((x, y),)])
        sides = [side((int(x * scale), int(y * scale)), scaled(ring, scale)) for ring in polygon.rings]
        if sides[0] < 0 or any(each > 0 for each in sides[1:]):
            raise MapError(f"the start ({float(x):g}, {float(y):g}) lies outside of the environment; give a place inside or on a wall")
        self.place: ExactPoint = (x, y)
        self._shooter = Shooter(polygon)

    def __repr__(self) -> str:
        return f"<CompassRobot at ({float(self.place[0]):g}, {float(self.place[1]):g})>"

    def drive(self, x: Any, y: Any) -> ExactPoint:
        """Drive in a direction until a wall is there; return where that is.

        Raises
        ------
        ConfigError
            If the direction is given in floats, or is (0, 0).
        """
        stop = self._shooter.shoot(self.place, primitive(x, y))
        self.place = fraction(stop.x), fraction(stop.y)
        return self.place
