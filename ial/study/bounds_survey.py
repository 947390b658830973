"""`BoundsSurvey`: which bounds a recording keeps, so that a user can choose them."""

import dataclasses
import math
from fractions import Fraction
from typing import Any

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.datasets.recording import Step
from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose, wrap
from ial.study.blocked_rays import blocked_rays
from ial.study.failures import Failures
from ial.study.good_beams import good_beams
from ial.study.motion_fit import RecordedStep, fitted
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams, in_grid

TOTALS_M = (0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3)
"""Sums of range error and map error that are tried."""

OUTLIERS = (0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3)
"""Shares of bad beams that are allowed."""

QUANTILES = (0.5, 0.9, 0.95, 0.98, 0.99)

TYPICAL_OUTLIERS, TYPICAL_SCANS = 0.1, 0.95
"""The suggested total leaves at most this share of the beams bad, in at least this share of the scans."""

_HELD = 0.99  # of scans and steps, by what is suggested


class BoundsSurvey:
    """Collects, scan by scan, how far readings and odometry are from what a reference pose and the map say.

    Parameters
    ----------
    grid
        The map.
    config
        What is suggested starts from here.
    """

    def __init__(self, grid: OccupancyGrid, config: LocalizerConfig) -> None:
        self.grid = grid
        self.config = config
        self.failures = Failures(grid)
        self._obstacles = Obstacles(grid)
        self._bad: list[float] = []
        self._shares: list[FloatArray] = []
        self._distances: list[FloatArray] = []
        self._translation: list[float] = []
        self._rotation: list[float] = []
        self._steps: list[RecordedStep] = []
        self._kept: list[bool] = []
        self._previous: Pose | None = None

    def __repr__(self) -> str:
        return f"<BoundsSurvey of {self.scans} scans and {len(self._steps)} steps>"

    def add(self, step: Step, pose: Pose | None, *, beams: bool = True) -> None:
        """Take a scan and ``T_map_base`` of a reference, None where there is none; `beams` says whether its beams count, too.

        Bounds of motion that hold from each scan to the next hold over scans that are left out, since steps are composed. The reverse is
        not so: a long step leaves so much room that what is added for each scan looks superfluous.
        """
        if pose is not None:
            if beams:
                at = self.grid.pose_to_grid(pose)
                self._add_beams(UsedBeams.of(step.scan, self.config), np.array([[at.x, at.y, at.theta]]))
            if self._previous is not None and step.motion is not None:
                self._add_motion(step, self._previous.inverse() @ pose)
        self._previous = pose

    def _add_beams(self, beams: UsedBeams, pose: FloatArray) -> None:
        hits = len(beams.readings)
        if not hits:
            return
        ends = in_grid(pose, beams.ends[None], np.zeros((1, hits)))[0][0]
        distance = self._obstacles.distances(ends)
        self._distances.append(distance.astype(np.float32))
        self._shares.append(np.array([np.mean(distance > total) for total in TOTALS_M]))
        bad = np.zeros(len(beams), dtype=np.bool_)
        bad[:hits] = ~good_beams(beams, pose, self._obstacles)[0]
        failures = self.failures
        failures.count(failures.ended, ends[bad[:hits]])
        blocked = beams.rays[blocked_rays(beams, pose, self._obstacles)[0]]
        laser, angles = (each[0, blocked] for each in in_grid(pose, *(each[None] for each in beams.middle)))
        met = cast_rays(self._obstacles.mask, self.grid.resolution, laser[:, 0], laser[:, 1], angles)
        along = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        failures.count(failures.passed, (laser + met[:, None] * along)[np.isfinite(met)])
        bad[blocked] = True
        failures.count(failures.good, ends[~bad[:hits]])
        self._bad.append(float(bad.mean()))

    def _add_motion(self, step: Step, true: Pose) -> None:
        assert step.motion is not None
        middle = 0.5 * (step.motion.lower + step.motion.upper)
        aside = np.abs([true.x - middle[0], true.y - middle[1], wrap(true.theta - middle[2])])
        self._translation.append(float(aside[:2].max()))
        self._rotation.append(float(aside[2]))
        self._kept.append(step.motion.contains(true))
        self._steps.append(RecordedStep(step.recorded, true))

    @property
    def scans(self) -> int:
        """How many scans with a reference were taken."""
        return len(self._bad)

    def held(self) -> FloatArray:
        """Return the share of scans at which each total bound (row) holds with each share of outliers (column), shape (7, 7)."""
        shares = np.array(self._shares)
        return np.array([[np.mean(shares[:, row] <= outliers) for outliers in OUTLIERS] for row in range(len(TOTALS_M))])

    def total_m(self) -> float | None:
        """Return the smallest total tried that leaves at most 10 % of the beams bad in 95 % of the scans; None if none of them does."""
        held = self.held()[:, OUTLIERS.index(TYPICAL_OUTLIERS)]
        rows = np.flatnonzero(held >= TYPICAL_SCANS)
        return TOTALS_M[rows[0]] if len(rows) else None

    def suggestion(self) -> LocalizerConfig:
        """Return the configuration with bounds that this recording keeps in 99 % of its scans and steps.

        The total bound is `total_m`; where that is None, the bounds of beams and `max_outliers` stay as they are configured. The motion
        bounds are those of `fitted`.
        """
        bounds = self.config.bounds
        if self._steps:
            bounds = dataclasses.replace(bounds, motion=fitted(bounds.motion, self._steps, _HELD))
        total = self.total_m()
        if total is None:
            return dataclasses.replace(self.config, bounds=bounds)
        bounds = dataclasses.replace(bounds, map_error_m=round(max(total - bounds.range_error_m, 0.0), 3))
        config = dataclasses.replace(self.config, bounds=bounds)
        if config.outliers == "auto":
            row = TOTALS_M.index(total)
            needed = float(np.quantile([shares[row] for shares in self._shares], _HELD))
            margin = 0 if isinstance(config.outlier_margin, int) else Fraction(str(config.outlier_margin))
            most = math.ceil(100 * (Fraction(str(needed)) + margin)) / 100
            config = dataclasses.replace(config, max_outliers=min(0.9, most))
        return config

    def record(self) -> dict[str, Any]:
        """Return everything as plain values that JSON can hold."""
        shares = np.array(self._shares)
        distances = np.concatenate(self._distances) if self._distances else np.empty(0)
        return {
            "scans": self.scans,
            "beam_error_m": _quantiles(distances),
            "bad_share_of_a_scan": _quantiles(np.array(self._bad)),
            "bad_share_by_total_bound": {f"{total:g}": _quantiles(shares[:, row]) for row, total in enumerate(TOTALS_M)},
            "held": {
                f"{total:g}": {f"{outliers:g}": float(share) for outliers, share in zip(OUTLIERS, row, strict=True)}
                for total, row in zip(TOTALS_M, self.held(), strict=True)
            },
            "suggested_total_m": self.total_m(),
            "motion": {
                "steps": len(self._steps),
                "messages": sum(step.messages for step in self._steps),
                "translation_m": _quantiles(np.array(self._translation)),
                "rotation_rad": _quantiles(np.array(self._rotation)),
                "held": float(np.mean(self._kept)) if self._kept else None,
            },
        }


def _quantiles(values: FloatArray) -> dict[str, float] | None:
    if not len(values):
        return None
    quantiles = {f"{share:g}": float(value) for share, value in zip(QUANTILES, np.quantile(values, QUANTILES), strict=True)}
    return {**quantiles, "max": float(values.max())}
