import subprocess
import sys
from collections.abc import Iterator

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from ial.contractors.boxes import Boxes
from ial.contractors.paving.drawing import draw
from ial.contractors.paving.paving import Paving


@pytest.fixture
def ax() -> Iterator[Axes]:
    mpl.use("Agg")
    yield pyplot.figure(figsize=(2.0, 2.0), dpi=100).add_axes((0, 0, 1, 1))
    pyplot.close("all")


def rectangles(ax: Axes, label: str) -> list[tuple[float, float, float, float]]:
    (collection,) = (each for each in ax.collections if each.get_label() == label)
    assert isinstance(collection, PolyCollection)
    return [(*path.vertices.min(axis=0), *path.vertices.max(axis=0)) for path in collection.get_paths()]


def test_each_box_becomes_its_rectangle_along_the_chosen_axes(ax: Axes) -> None:
    inner, boundary = Boxes.of([(0, 1), (2, 3), (4, 6)]), Boxes.of([(1, 2), (2, 5), (7, 8)], [(0, 0), (1, 1), (2, 3)])
    assert draw(inner, boundary, (2, 0), ax) is ax
    assert rectangles(ax, "inner") == [(4.0, 0.0, 6.0, 1.0)]
    assert rectangles(ax, "boundary") == [(7.0, 1.0, 8.0, 2.0), (2.0, 0.0, 3.0, 0.0)]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("axis 2", "axis 0")
    left, right = ax.get_xlim()
    assert left <= 2.0
    assert right >= 8.0


@pytest.mark.slow
def test_what_is_drawn_covers_its_pixels_without_gaps(ax: Axes) -> None:
    # 100 000 boxes that fill the square: inner ones to the left, boundary to the right.
    at = np.stack(np.meshgrid(np.arange(400) / 400.0, np.arange(250) / 250.0), axis=-1).reshape(-1, 2)
    boxes = Boxes(at, at + np.array([1 / 400.0, 1 / 250.0]))
    left = boxes.upper[:, 0] <= 0.5
    draw(boxes[left], boxes[~left], ax=ax)
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1)
    ax.axis("off")
    canvas = ax.figure.canvas
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[2:-2, 2:-2, :3].astype(int)  # type: ignore[attr-defined]
    for part in (pixels[:, :90], pixels[:, 106:]):
        assert np.ptp(part.reshape(-1, 3), axis=0).max() <= 3
    assert np.abs(pixels[0, 0] - pixels[0, -1]).max() > 30


def test_nothing_is_drawn_for_no_boxes(ax: Axes) -> None:
    assert draw(Boxes.none(2), Boxes.none(2), ax=ax).collections[:] == []


def test_the_current_axes_are_the_default(ax: Axes) -> None:
    pyplot.sca(ax)
    assert draw(Boxes.none(2), Boxes.of([(0, 1), (0, 1)])) is ax


@pytest.mark.parametrize("axes", [(0, 0), (0, 2), (-1, 0)])
def test_axes_that_cannot_be_drawn_are_refused(axes: tuple[int, int], ax: Axes) -> None:
    with pytest.raises(ValueError, match="give two different ones"):
        draw(Boxes.none(2), Boxes.of([(0, 1), (0, 1)]), axes, ax)


def test_an_unbounded_box_is_refused_only_along_the_drawn_axes(ax: Axes) -> None:
    boxes = Boxes.of([(0, 1), (0, 1), (0, np.inf)])
    with pytest.raises(ValueError, match="1 of 1 boxes are unbounded"):
        draw(Boxes.none(3), boxes, (0, 2), ax)
    assert len(draw(Boxes.none(3), boxes, (0, 1), ax).collections) == 1


@pytest.mark.slow
def test_matplotlib_is_loaded_only_to_draw() -> None:
    code = "import sys, ial.contractors.paving.paver, ial.contractors.paving.drawing; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_notebook_shows_a_paving_and_leaves_open_figures_alone(ax: Axes) -> None:
    before = pyplot.get_fignums()
    for paving in (Paving(Boxes.of([(0, 1), (0, 1)]), Boxes.none(2)), Paving(Boxes.none(2), Boxes.none(2))):
        shown = paving._repr_png_()
        assert (shown is not None and shown.startswith(b"\x89PNG")) is bool(len(paving.boxes))
    assert pyplot.get_fignums() == before
    assert pyplot.gca() is ax


@pytest.mark.parametrize("box", [[(0, 1)], [(0, 1), (0, np.inf)]])
def test_a_notebook_shows_the_text_of_what_cannot_be_drawn(box: list[tuple[float, float]]) -> None:
    assert Paving(Boxes.of(box), Boxes.none(len(box)))._repr_png_() is None
