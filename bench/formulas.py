"""The formulas that both toolkits are given, written once.

`t` is the module that has the functions, ial's or codac's; `x` is a vector of variables.
"""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class System:
    """Equations f(x) = 0 in a box, and how finely to pave their solutions."""

    name: str
    dimension: int
    side: tuple[float, float]
    precision: float


SYSTEMS = [
    System("bronstein", 3, (-100.0, 100.0), 1e-6),
    System("curve", 3, (-3.0, 3.0), 0.01),
    System("broyden", 6, (-100.0, 100.0), 1e-6),
    System("kinematics", 6, (0.0, 6.2832), 1e-3),
]


def disc(t: Any, x: Any) -> Any:
    """Return the squared distance from the origin."""
    return t.sqr(x[0]) + t.sqr(x[1])


def bronstein(t: Any, x: Any) -> list[Any]:
    """Return a sphere, a plane and a cubic surface: isolated solutions."""
    return [t.sqr(x[0]) + t.sqr(x[1]) + t.sqr(x[2]) - 36.0, x[0] + x[1] - x[2], x[0] * x[1] + t.sqr(x[2]) - 1.0]


def curve(t: Any, x: Any) -> list[Any]:
    """Return a sphere and a cylinder that touches its centre: the solutions are Viviani's curve."""
    return [t.sqr(x[0]) + t.sqr(x[1]) + t.sqr(x[2]) - 4.0, t.sqr(x[0] - 1.0) + t.sqr(x[1]) - 1.0]


def broyden(t: Any, x: Any) -> list[Any]:
    """Return Broyden's tridiagonal system (Moré, Garbow, Hillstrom 1981, no. 30) in six variables."""
    residuals = []
    for i in range(6):
        value = (3.0 - 2.0 * x[i]) * x[i] + 1.0
        value = value - x[i - 1] if i > 0 else value
        residuals.append(value - 2.0 * x[i + 1] if i < 5 else value)
    return residuals


def kinematics(t: Any, x: Any) -> list[Any]:
    """Return the inverse kinematics of an elbow manipulator (Van Hentenryck, McAllester, Kapur 1997, "Kin1")."""
    s, c = [t.sin(x[i]) for i in range(6)], [t.cos(x[i]) for i in range(6)]
    return [
        s[1] * c[4] * s[5] - s[2] * c[4] * s[5] - s[3] * c[4] * s[5] + c[1] * c[5] + c[2] * c[5] + c[3] * c[5] - 0.4077,
        c[0] * c[1] * s[4] + c[0] * c[2] * s[4] + c[0] * c[3] * s[4] + s[0] * c[4] - 1.9115,
        s[1] * s[4] + s[2] * s[4] + s[3] * s[4] - 1.9791,
        3.0 * c[0] * c[1] + 2.0 * c[0] * c[2] + c[0] * c[3] - 4.0616,
        3.0 * s[0] * c[1] + 2.0 * s[0] * c[2] + s[0] * c[3] - 1.7172,
        3.0 * s[1] + 2.0 * s[2] + s[3] - 3.9701,
    ]


def equations(name: str, t: Any, x: Any) -> list[Any]:
    """Return the left sides of a system's equations."""
    residuals: list[Any] = {"bronstein": bronstein, "curve": curve, "broyden": broyden, "kinematics": kinematics}[name](t, x)
    return residuals


def distance(t: Any, x: Any, beacon: Any) -> Any:
    """Return the distance from a beacon, or from each of several: an array of their x and one of their y."""
    return t.sqrt(t.sqr(x[0] - beacon[0]) + t.sqr(x[1] - beacon[1]))
