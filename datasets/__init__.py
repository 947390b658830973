"""Recordings: bags, logs and simulated runs read as one kind of steps, and trajectories in and out.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.datasets.conversion import convert as convert
    from ial.datasets.info import RecordingInfo as RecordingInfo
    from ial.datasets.kidnapping import Kidnapping as Kidnapping
    from ial.datasets.kidnapping import kidnap as kidnap
    from ial.datasets.motion import ErrorBound as ErrorBound
    from ial.datasets.motion import Motion as Motion
    from ial.datasets.motion import MotionBounds as MotionBounds
    from ial.datasets.odometry import Odometry as Odometry
    from ial.datasets.odometry_path import OdometryPath as OdometryPath
    from ial.datasets.opening import open_recording as open_recording
    from ial.datasets.recording import Reading as Reading
    from ial.datasets.recording import Recording as Recording
    from ial.datasets.recording import Step as Step
    from ial.datasets.recording import steps as steps
    from ial.datasets.sample import sample_grid as sample_grid
    from ial.datasets.sample import sample_map_path as sample_map_path
    from ial.datasets.sample import sample_recording as sample_recording
    from ial.datasets.scan import BeamClass as BeamClass
    from ial.datasets.scan import LaserScan as LaserScan
    from ial.datasets.scan import Mounting as Mounting
    from ial.datasets.simulator import Lidar as Lidar
    from ial.datasets.simulator import SensorErrors as SensorErrors
    from ial.datasets.simulator import simulate as simulate
    from ial.datasets.trajectory import Trajectory as Trajectory
    from ial.datasets.trajectory import read_tum as read_tum
    from ial.datasets.trajectory import write_tum as write_tum
    from ial.datasets.walk import random_walk as random_walk
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "conversion": ("convert",),
            "info": ("RecordingInfo",),
            "kidnapping": ("Kidnapping", "kidnap"),
            "motion": ("ErrorBound", "Motion", "MotionBounds"),
            "odometry": ("Odometry",),
            "odometry_path": ("OdometryPath",),
            "opening": ("open_recording",),
            "recording": ("Reading", "Recording", "Step", "steps"),
            "sample": ("sample_grid", "sample_map_path", "sample_recording"),
            "scan": ("BeamClass", "LaserScan", "Mounting"),
            "simulator": ("Lidar", "SensorErrors", "simulate"),
            "trajectory": ("Trajectory", "read_tum", "write_tum"),
            "walk": ("random_walk",),
        },
    )
