"""`Picture`: a run at a glance."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ial.contractors.boxes import Boxes
from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.enclosures import Enclosure
from ial.results.lidar.map_layer import MapLayer
from ial.results.lidar.panels import draw_first, draw_scan, draw_status, draw_track
from ial.results.lidar.thinning import thinned
from ial.results.lidar.track import Track
from ial.results.lidar.wording import pose_text

_DPI = 120
_WIDTH_IN = 14.0
_LEFT_IN, _RIGHT_IN, _TOP_IN, _BOTTOM_IN = 0.55, 0.2, 0.85, 0.5
_GAP_IN = 0.6
_INNER_IN = _WIDTH_IN - _LEFT_IN - _RIGHT_IN
_STATUS_IN = 1.0
_WIDE = 0.45  # a map lower than this share of its width lies across the page

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class _Page:
    """Where the track, the first step, the scan and the status stand: left, top, width and height in inches from the upper left corner."""

    height: float
    boxes: tuple[Box, Box, Box, Box]

    def share(self, box: Box) -> Box:
        """Return a box as matplotlib wants it: left, bottom, width and height as shares of the page."""
        left, top, width, height = box
        return left / _WIDTH_IN, 1.0 - (top + height) / self.height, width / _WIDTH_IN, height / self.height


def _across(layer: MapLayer) -> _Page:
    """Return the page for a map that is much wider than high: the track across it, the others below."""
    left, right, bottom, top = layer.view
    track = min(max(_INNER_IN * (top - bottom) / (right - left), 2.2), 5.5)
    below = 3.0
    half = 0.5 * (_INNER_IN - _GAP_IN)
    second, third = _TOP_IN + track + _GAP_IN, _TOP_IN + track + below + 2.0 * _GAP_IN
    boxes = (
        (_LEFT_IN, _TOP_IN, _INNER_IN, track),
        (_LEFT_IN, second, half, below),
        (_LEFT_IN + half + _GAP_IN, second, half, below),
        (_LEFT_IN, third, _INNER_IN, _STATUS_IN),
    )
    return _Page(third + _STATUS_IN + _BOTTOM_IN, boxes)


def _upright() -> _Page:
    """Return the page for any other map: the track at the left, the first step and the scan at its side."""
    track, high = 7.8, 7.6
    half, side = 0.5 * (high - _GAP_IN), _LEFT_IN + track + _GAP_IN
    third = _TOP_IN + high + _GAP_IN
    boxes = (
        (_LEFT_IN, _TOP_IN, track, high),
        (side, _TOP_IN, _WIDTH_IN - _RIGHT_IN - side, half),
        (side, _TOP_IN + half + _GAP_IN, _WIDTH_IN - _RIGHT_IN - side, half),
        (_LEFT_IN, third, _INNER_IN, _STATUS_IN),
    )
    return _Page(third + _STATUS_IN + _BOTTOM_IN, boxes)


class Picture(AbstractContextManager["Picture"]):
    """``picture.png``: the map with the path and the enclosure of every scan, the first global step, the last scan on the walls, and time.

    Of each scan only the hulls are kept, of a long run not of each, and of the first one all boxes.

    Parameters
    ----------
    path
        The file.
    grid
        The map.
    name
        The title.
    walls_m
        How far a beam that counts as explained may end from an occupied cell.
    reference
        Returns ``T_map_base`` of a reference at a scan, to draw beside the path, or None where it has none.
    """

    def __init__(
        self,
        path: Path,
        grid: OccupancyGrid,
        name: str,
        walls_m: float = 0.1,
        reference: Callable[[Step], Pose | None] | None = None,
    ) -> None:
        self._path = path
        self._grid = grid
        self._name = name
        self._walls_m = walls_m
        self._reference = reference
        self._track = Track()
        self._truth: list[Pose] = []
        self._first: Boxes | None = None
        self._scan: tuple[Step, Pose] | None = None

    def __repr__(self) -> str:
        return f"<Picture of {len(self._track)} scans: {self._path}>"

    def add(self, step: Step, estimate: Estimate) -> None:
        """Remember what will be drawn of one scan."""
        self._track.add(Enclosure.of(step, estimate))
        if self._first is None:
            self._first = estimate.poses.boxes
        if estimate.pose is not None:
            self._scan = step, estimate.pose
        at = None if self._reference is None else self._reference(step)
        if at is not None:
            self._truth.append(at)
            self._truth = thinned(self._truth)

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            figure = self._figure()
            figure.savefig(self._path, dpi=_DPI, format="png", pil_kwargs={"compress_level": 3})

    def _figure(self) -> Figure:
        layer = MapLayer(self._grid)
        left, right, bottom, top = layer.view
        page = _across(layer) if (top - bottom) / (right - left) < _WIDE else _upright()
        figure = Figure(figsize=(_WIDTH_IN, page.height), facecolor="white")
        FigureCanvasAgg(figure)
        track, first, scan, status = (figure.add_axes(page.share(box)) for box in page.boxes)
        draw_track(track, layer, self._track, self._truth)
        draw_first(first, layer, self._first or Boxes.none(3), self._track)
        draw_scan(scan, layer, self._grid, self._scan, self._walls_m)
        draw_status(status, self._track)
        above = 1.0 - 0.15 / page.height
        figure.text(_LEFT_IN / _WIDTH_IN, above, self._title(), ha="left", va="top", fontsize=15, fontweight="bold")
        figure.text(1.0 - _RIGHT_IN / _WIDTH_IN, above, self._outcome(), ha="right", va="top", fontsize=11)
        return figure

    def _title(self) -> str:
        name = Path(self._name).name or self._name
        return f"{name[:60]} in a map of {self._grid.width_m:.0f} × {self._grid.height_m:.0f} m"

    def _outcome(self) -> str:
        """Return in words where the run ended."""
        last = next((each for each in reversed(self._track.scans) if each.pose is not None), None)
        if last is None or last.pose is None:
            return f"never localized in {len(self._track)} scans"
        return f"scan {last.index}: {pose_text(last.pose, last.hypotheses[0])}"
