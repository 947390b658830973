"""The set-membership localizer on occupancy grids: every pose that a map, the scans and stated error bounds allow.

Source: Guyonneau et al. 2014. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.lidar.atlas import Atlas as Atlas
    from ial.lidar.atlas import Whereabouts as Whereabouts
    from ial.lidar.configuration.config import Bounds as Bounds
    from ial.lidar.configuration.config import FreeSpace as FreeSpace
    from ial.lidar.configuration.config import LocalizedSize as LocalizedSize
    from ial.lidar.configuration.config import LocalizerConfig as LocalizerConfig
    from ial.lidar.configuration.config import Precision as Precision
    from ial.lidar.configuration.config_record import config_record as config_record
    from ial.lidar.configuration.config_record import config_yaml as config_yaml
    from ial.lidar.configuration.config_record import read_config as read_config
    from ial.lidar.estimate import Estimate as Estimate
    from ial.lidar.global_check import GlobalCheck as GlobalCheck
    from ial.lidar.hypothesis import Hypothesis as Hypothesis
    from ial.lidar.localizer import Localizer as Localizer
    from ial.lidar.pose_set import PoseSet as PoseSet
    from ial.lidar.run import localize as localize
    from ial.lidar.search.scan_contractor import ScanContractor as ScanContractor
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "atlas": ("Atlas", "Whereabouts"),
            "configuration.config": ("Bounds", "FreeSpace", "LocalizedSize", "LocalizerConfig", "Precision"),
            "configuration.config_record": ("config_record", "config_yaml", "read_config"),
            "estimate": ("Estimate",),
            "hypothesis": ("Hypothesis",),
            "global_check": ("GlobalCheck",),
            "localizer": ("Localizer",),
            "pose_set": ("PoseSet",),
            "run": ("localize",),
            "search.scan_contractor": ("ScanContractor",),
        },
    )
