"""The one idea of every localizer here: start from all states, move them with the robot, keep those that the readings allow.

An empty set proves that some assumption is false: the robot was moved by hand, the map is another one, or an error bound was violated.
What does not depend on the robot is here: the filter and its recovery, several worlds at once, and readings of which some are wrong.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.membership.lapses import Lapses as Lapses
    from ial.membership.model import ContractingModel as ContractingModel
    from ial.membership.model import Model as Model
    from ial.membership.set_membership_filter import Recovery as Recovery
    from ial.membership.set_membership_filter import Rejection as Rejection
    from ial.membership.set_membership_filter import SetMembershipFilter as SetMembershipFilter
    from ial.membership.worlds import Worlds as Worlds
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "lapses": ("Lapses",),
            "model": ("ContractingModel", "Model"),
            "set_membership_filter": ("Recovery", "Rejection", "SetMembershipFilter"),
            "worlds": ("Worlds",),
        },
    )
