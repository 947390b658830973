"""`Problem`: variables, their domains, and constraints on them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.family import Member, members_of
from ial.contractors.combinators.trivial_sets import WholeSpace
from ial.contractors.expressions.constraint import Constraint, ConstraintFamily
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.mean_value import mean_value
from ial.contractors.intervals.interval import Interval
from ial.contractors.paving.paver import pave
from ial.contractors.paving.paving import Paving
from ial.contractors.solving.conflict import conflict
from ial.contractors.solving.propagation import Propagation
from ial.contractors.space import Space

Domains = Mapping[Any, Any] | Sequence[Any] | Boxes


class Problem(CheckedContractor):
    """A constraint satisfaction problem: the points of a box that satisfy all of several constraints.

    It is itself a contractor, and can so be a part of other constraints.

    Parameters
    ----------
    variables
        What `variables` returned: all variables of one space.
    domains
        Where each variable lies: a mapping from variables or their names to intervals, pairs (lower, upper) or numbers, where those that
        are not named are unbounded; or one of these for each variable, in the order of declaration; or one box. By default all are
        unbounded.
    constraints
        Each a `Constraint`, or a contractor or family over all variables; `ial.contractors.where` makes one of a constraint on some of
        them.

    Raises
    ------
    TypeError
        If something is not a variable or not a contractor.
    ValueError
        If the variables are not those of one space, a domain is of an unknown variable, or a constraint is over another space.

    References
    ----------
    Guyonneau, Lagrange, Hardouin, Lucidarme: Guaranteed interval analysis localization for mobile robots, Advanced Robotics 28 (2014),
    section 3.1; the example is their equation 5.

    Examples
    --------
    >>> from math import inf
    >>> from ial.contractors import Interval, Problem, variables
    >>> x1, x2, x3 = variables("x1 x2 x3")
    >>> domains = {x1: Interval(7, inf), x2: Interval(-inf, 2), x3: Interval(-inf, 9)}
    >>> problem = Problem((x1, x2, x3), domains, [x1 == x2 + x3])
    >>> for name, domain in problem.propagate().items():
    ...     print(name, domain)
    x1 [7.0, 11.0]
    x2 [-2.0, 2.0]
    x3 [5.0, 9.0]
    """

    def __init__(self, variables: Any, domains: Domains | None = None, constraints: Iterable[Member] = ()) -> None:
        self.space: Space = _space(variables)
        self.dimension = self.space.dimension
        self.box = _box(domains, self.space)
        self.constraints = members_of(constraints)
        for constraint in self.constraints:
            _require_space(constraint, self.space)
        self._contractors = {id(constraint): _tightened(constraint) for constraint in self.constraints}
        self._propagation = self._propagated(self.constraints)

    def __repr__(self) -> str:
        return f"<Problem of {', '.join(self.space.names)}: {len(self.constraints)} constraints>"

    @property
    def domains(self) -> dict[str, Interval]:
        """The domain of each variable, by its name."""
        return self._named(self.box)

    def propagate(self, *, ratio: float = 0.001, max_rounds: int = 1000) -> dict[str, Interval]:
        """Return the domains, narrowed until no constraint narrows them by much: every solution lies in them.

        Parameters
        ----------
        ratio, max_rounds
            When to stop: see `Propagation`.

        Returns
        -------
        dict
            An interval for each variable, by its name. If there is provably no solution, all of them are empty.

        Raises
        ------
        ValueError
            If `ratio` or `max_rounds` is out of range.
        """
        return self._named(self._propagated(self.constraints, ratio, max_rounds).contract(self.box))

    def solve(self, precision: Any, **options: Any) -> Paving:
        """Return boxes that cover all solutions.

        Domains are bisected and propagated in turn. A variable that occurs several times in one constraint is also narrowed by the
        mean-value form of it, see `mean_value`.

        Parameters
        ----------
        precision
            The wanted width of the boxes: one number, or one for each variable. A variable that propagation leaves unbounded is bisected
            until `max_boxes` is reached.
        **options
            Those of `ial.contractors.pave`.

        Raises
        ------
        ValueError
            If an argument cannot be used.
        """
        return pave(self, self.box, precision, **options)

    def why_empty(self, precision: Any, **options: Any) -> tuple[Member, ...]:
        """Return constraints that contradict each other in these domains, of which none can be left out.

        `solve` with the same arguments proves that they have no common solution, and proves it of no set with one of them less. Other
        sets of constraints may be in conflict as well. If even the domains alone are empty, no constraint is needed and none is returned.

        Parameters
        ----------
        precision
            As for `solve`; a finer one may find smaller conflicts.
        **options
            Those of `ial.contractors.pave`. With `max_seconds` the answer may differ from run to run.

        Returns
        -------
        tuple
            Some of the `constraints`, in their order. A family counts as one.

        Raises
        ------
        ValueError
            If the problem is not proved empty at this precision.
        """
        explanation = conflict(self.constraints, self._propagated, self.box, precision, **options)
        if explanation is None:
            raise ValueError(
                f"at the precision {precision} the problem of {len(self.constraints)} constraints is not proved empty, and nothing is to "
                "be explained: solve(precision) shows where solutions may be; give a finer precision, or raise limits such as max_boxes"
            )
        return explanation

    def _narrow(self, boxes: Boxes) -> Boxes:
        return self._propagation.contract(boxes & self.box)

    def _propagated(self, constraints: Sequence[Member], ratio: float = 0.1, max_rounds: int = 100) -> Propagation:
        members = [self._contractors[id(constraint)] for constraint in constraints] or [WholeSpace(self.dimension)]
        return Propagation(*members, ratio=ratio, max_rounds=max_rounds)

    def _named(self, box: Boxes) -> dict[str, Interval]:
        sides = zip(box.lower[0].tolist(), box.upper[0].tolist(), strict=True)
        return {name: Interval.of_bounds(*side) for name, side in zip(self.space.names, sides, strict=True)}


def _space(variables: Any) -> Space:
    """Return the space of variables, given one by one or in arrays."""
    axes: list[int] = []
    spaces: set[Space] = set()
    for variable in _flat(variables):
        if not isinstance(variable, Expression) or variable.axis is None or variable.space is None:
            raise TypeError(f"{variable!r} stands among the variables of a problem; give what variables(...) returned")
        axes.append(variable.axis)
        spaces.add(variable.space)
    if len(spaces) != 1 or sorted(axes) != list(range(next(iter(spaces)).dimension)):
        names = ", ".join(" ".join(space.names) for space in spaces)
        raise ValueError(
            f"a problem is given {len(axes)} variables of {names or 'no space'}; give all variables of one variables(...) call, each once"
        )
    return spaces.pop()


def _flat(variables: Any) -> Iterator[Any]:
    if isinstance(variables, np.ndarray | tuple | list):
        for part in variables:
            yield from _flat(part)
    else:
        yield variables


def _box(domains: Domains | None, space: Space) -> Boxes:
    """Return the domains as one box."""
    if isinstance(domains, Boxes):
        if domains.lower.shape != (1, space.dimension):
            raise ValueError(f"the domains are {len(domains)} boxes of {domains.dimension} dimensions; give one box of {space.dimension}")
        return domains.where(~domains.empty)
    sides = [Interval.entire()] * space.dimension
    if isinstance(domains, Mapping):
        for variable, domain in domains.items():
            sides[_axis(variable, space)] = _interval(domain)
    elif domains is not None:
        sides = [_interval(domain) for domain in domains]
        if len(sides) != space.dimension:
            raise ValueError(f"{len(sides)} domains are given for {space.dimension} variables; give one for each: {' '.join(space.names)}")
    box = Boxes(np.array([[side.lower for side in sides]]), np.array([[side.upper for side in sides]]))
    return box.where(~box.empty)


def _interval(domain: Any) -> Interval:
    return domain if isinstance(domain, Interval) else Interval(*domain) if isinstance(domain, tuple) else Interval(domain)


def _axis(variable: Any, space: Space) -> int:
    if isinstance(variable, Expression) and variable.space == space and variable.axis is not None:
        return variable.axis
    if isinstance(variable, str) and variable in space.names:
        return space.names.index(variable)
    raise ValueError(f"a domain is given for {variable!r}, which is not a variable of the problem: {' '.join(space.names)}")


def _require_space(constraint: Member, space: Space) -> None:
    if getattr(constraint, "space", None) not in (None, space):
        raise ValueError(
            f"the constraint {constraint} is over other variables; declare all variables of a problem in one variables(...) call"
        )
    if constraint.dimension != space.dimension:
        raise ValueError(
            f"{type(constraint).__name__} is a constraint on {constraint.dimension} variables, the problem has {space.dimension}; "
            "where(constraint, axes, dimension) says which of them it is about"
        )


def _tightened(constraint: Member) -> Member:
    """Return a constraint with the mean-value form, where that narrows more and derivatives are known."""
    if not isinstance(constraint, Constraint) or isinstance(constraint, ConstraintFamily):
        return constraint
    try:
        return mean_value(constraint)
    except TypeError:
        return constraint
