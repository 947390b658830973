from pathlib import Path

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.paving.paving_file import read, write
from ial.errors import OutputError, PavingError


def example(rows: int = 50) -> tuple[Boxes, Boxes]:
    lower = np.random.default_rng(0).normal(size=(rows, 3))
    return Boxes(lower, lower + 0.1), Boxes(lower - 1.0, np.full(lower.shape, np.inf))


@pytest.mark.parametrize("rows", [0, 1, 50])
def test_bounds_are_kept_bit_for_bit(rows: int, tmp_path: Path) -> None:
    inner, boundary = example(rows)
    write(tmp_path / "paving", inner, boundary, "time", 2**40)
    assert [file.name for file in tmp_path.iterdir()] == ["paving"]
    found_inner, found_boundary, limited, nodes = read(tmp_path / "paving")
    for kept, given in ((found_inner, inner), (found_boundary, boundary)):
        assert kept.lower.tobytes() == given.lower.tobytes()
        assert kept.upper.tobytes() == given.upper.tobytes()
        assert kept.dimension == 3
    assert (limited, nodes) == ("time", 2**40)


def test_a_file_that_is_cut_short_is_refused_wherever_it_ends(tmp_path: Path) -> None:
    path = tmp_path / "paving.npz"
    write(path, *example(), "", 1)
    whole = path.read_bytes()
    for length in range(0, len(whole), max(1, len(whole) // 200)):
        path.write_bytes(whole[:length])
        with pytest.raises(PavingError, match=str(path)):
            read(path)


def test_a_file_with_a_flipped_byte_is_refused_or_unchanged_in_what_it_says(tmp_path: Path) -> None:
    path = tmp_path / "paving.npz"
    inner, boundary = example()
    write(path, inner, boundary, "", 1)
    whole = bytearray(path.read_bytes())
    refused = 0
    for at in range(0, len(whole), max(1, len(whole) // 300)):
        broken = whole.copy()
        broken[at] ^= 0x10
        path.write_bytes(broken)
        try:
            again = read(path)
        except PavingError:
            refused += 1
        else:
            assert again[0].lower.tobytes() == inner.lower.tobytes()
            assert again[1].upper.tobytes() == boundary.upper.tobytes()
    assert refused > 200


def test_other_files_are_refused(tmp_path: Path) -> None:
    text, array, archive, object_file = (tmp_path / name for name in ("a.txt", "a.npy", "a.npz", "o.npz"))
    text.write_text("no paving\n")
    np.save(array, np.zeros(3))
    np.savez(archive, lower=np.zeros(3))
    np.savez(object_file, format=np.array([object()], dtype=object))
    for path in (text, array, archive, object_file, tmp_path, tmp_path / "missing.npz"):
        with pytest.raises(PavingError, match=str(path)):
            read(path)


@pytest.mark.parametrize(
    "change",
    [
        {"format": "ial paving 99"},
        {"limited": "patience"},
        {"nodes": "many"},
        {"inner_lower": np.zeros((50, 2)), "inner_upper": np.ones((50, 2))},
        {"inner_lower": np.zeros((7, 3))},
        {"boundary_lower": np.full((50, 3), np.nan)},
        {"boundary_upper": np.full((50, 3), -1e9)},
        {"boundary_upper": np.full((50, 3), "x")},
    ],
)
def test_an_archive_with_other_content_is_refused(change: dict[str, object], tmp_path: Path) -> None:
    path = tmp_path / "paving.npz"
    write(path, *example(), "", 1)
    with np.load(path) as archive:
        content: dict[str, object] = dict(archive) | change
    np.savez(path, **content)  # type: ignore[arg-type]
    with pytest.raises(PavingError, match=str(path)):
        read(path)


def test_a_file_is_replaced_only_by_a_whole_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "paving.npz"
    write(path, *example(), "", 1)
    before = path.read_bytes()

    def full(file: object, **content: object) -> None:
        file.write(b"half")  # type: ignore[attr-defined]
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez_compressed", full)
    with pytest.raises(OutputError, match="No space left on device"):
        write(path, *example(1), "", 1)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_does_not_exist_is_named(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"paving cannot be written .*choose another folder"):
        write(tmp_path / "no" / "paving.npz", *example(), "", 1)
    with pytest.raises(OutputError, match=r"paving cannot be written .*choose another folder"):
        write(tmp_path, *example(), "", 1)
