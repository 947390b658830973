"""Enclosures as markers of ``visualization_msgs``, which Foxglove and RViz draw."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.datasets.bag_writer import BagWriter
from ial.datasets.ros_messages import point, pose_message, vector
from ial.lidar.estimate import Estimate
from ial.lidar.hypothesis import Hypothesis
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.palette import PREDICTION, STATUS_COLOURS, rgb

_LINES, _TRIANGLES = 5, 11  # Marker.LINE_LIST and Marker.TRIANGLE_LIST
_ADD, _DELETE = 0, 2
_RECTANGLES = 2000  # of one scan; more are drawn coarser
_LINES_AT_MOST = 10_000  # of a raster along one axis
_EDGE_M = 0.03
_HAND_M = 0.6  # length of the lines that bound the heading
_MAP = Pose()


def enclosure_markers(bag: BagWriter, stamp_ns: int, frame: str, grid: OccupancyGrid, estimate: Estimate) -> Any:
    """Return a visualization_msgs/MarkerArray that replaces the one before it.

    ``boxes`` are the boxes of the set, seen from above, as filled rectangles; ``prediction`` those that a scan has rejected and that are
    carried on. ``hypotheses`` are the hulls of the connected parts, each with two lines from its middle that bound the heading.
    """
    colour = STATUS_COLOURS[estimate.status]
    poses = estimate.poses
    header = bag.header(stamp_ns, frame)
    markers = []
    for name, rows, paint in (("boxes", ~poses.unconfirmed, colour), ("prediction", poses.unconfirmed, PREDICTION)):
        corners = _triangles(rectangles(poses.boxes[rows], _RECTANGLES))
        markers.append(_marker(bag, header, name, _TRIANGLES, 1.0, grid.origin, rgb(paint), 0.45, corners))
    for name, unconfirmed in (("hypotheses", False), ("predicted hypotheses", True)):
        ends = _outlines(each for each in estimate.hypotheses if each.prediction is unconfirmed)
        markers.append(_marker(bag, header, name, _LINES, _EDGE_M, _MAP, rgb(PREDICTION if unconfirmed else colour), 1.0, ends))
    return bag.message("visualization_msgs/msg/MarkerArray", markers=markers)


def rectangles(boxes: Boxes, limit: int) -> FloatArray:
    """Return the rectangles x0, y0, x1, y1 that boxes (x, y, …) cover on the floor, shape (n, 4), without repetition.

    Where there are more than `limit`, each is widened to the lines of a raster, which is made coarser until few enough are left.
    """
    exact = np.unique(np.concatenate([boxes.lower[:, :2], boxes.upper[:, :2]], axis=1), axis=0)
    if len(exact) <= limit:
        return exact
    corner = exact[:, :2].min(axis=0)
    lower, upper = exact[:, :2] - corner, exact[:, 2:] - corner
    size = max(float(np.median(upper - lower)), float(upper.max()) / _LINES_AT_MOST)
    while True:
        first = np.floor(lower / size)
        last = np.maximum(np.ceil(upper / size), first + 1.0)
        distinct = np.unique(np.concatenate([first, last], axis=1), axis=0)
        if len(distinct) <= limit:
            return np.asarray(distinct * size + np.tile(corner, 2))
        size *= 2.0


def _triangles(rectangles: FloatArray) -> FloatArray:
    """Return two triangles for each rectangle, shape (6 n, 2)."""
    x0, y0, x1, y1 = rectangles.T
    return np.stack([x0, y0, x1, y0, x1, y1, x0, y0, x1, y1, x0, y1], axis=1).reshape(-1, 2)


def _outlines(hypotheses: Iterable[Hypothesis]) -> FloatArray:
    """Return the ends of lines around each hypothesis and along the bounds of its heading, shape (2 n, 2)."""
    ends: list[tuple[float, float]] = []
    for each in hypotheses:
        (x0, x1), (y0, y1) = each.x, each.y
        ends += [(x0, y0), (x1, y0), (x1, y0), (x1, y1), (x1, y1), (x0, y1), (x0, y1), (x0, y0)]
        middle = each.centre
        if each.theta[1] - each.theta[0] < math.pi:
            for heading in each.theta:
                ends += [(middle.x, middle.y), (middle.x + _HAND_M * math.cos(heading), middle.y + _HAND_M * math.sin(heading))]
    return np.array(ends, dtype=np.float64).reshape(-1, 2)


def _marker(
    bag: BagWriter,
    header: Any,
    name: str,
    kind: int,
    scale: float,
    place: Pose,
    colour: Sequence[float],
    alpha: float,
    points: FloatArray,
) -> Any:
    """Return a visualization_msgs/Marker; one without points deletes its predecessor."""
    make = bag.message
    red, green, blue = colour
    time = make("builtin_interfaces/msg/Time", sec=0, nanosec=0)
    nowhere = make("std_msgs/msg/Header", stamp=time, frame_id="")
    return make(
        "visualization_msgs/msg/Marker",
        header=header,
        ns=name,
        id=0,
        type=kind,
        action=_ADD if len(points) else _DELETE,
        pose=pose_message(bag, place),
        scale=vector(bag, scale, scale, scale),
        color=make("std_msgs/msg/ColorRGBA", r=red, g=green, b=blue, a=alpha),
        lifetime=make("builtin_interfaces/msg/Duration", sec=0, nanosec=0),
        frame_locked=False,
        points=[point(bag, x, y) for x, y in points.tolist()],
        colors=[],
        texture_resource="",
        texture=make("sensor_msgs/msg/CompressedImage", header=nowhere, format="", data=np.empty(0, dtype=np.uint8)),
        uv_coordinates=[],
        text="",
        mesh_resource="",
        mesh_file=make("visualization_msgs/msg/MeshFile", filename="", data=np.empty(0, dtype=np.uint8)),
        mesh_use_embedded_materials=False,
    )
