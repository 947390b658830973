from pathlib import Path

import pytest

from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.formats import export, format_of
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import ConfigError, OutputError


@pytest.mark.parametrize(
    ("name", "form"),
    [("a.h", "c"), ("a.v", "verilog"), ("a.DOT", "dot"), ("a.gv", "dot"), ("a.jff", "jff"), ("a.csv", "csv"), ("a.npz", "npz")],
)
def test_suffixes_stand_for_formats(name: str, form: str, corner: BounceFilter, tmp_path: Path) -> None:
    assert format_of(Path(name)) == form
    files = export(ExportedFilter.of(corner), tmp_path / name)
    assert sorted(tmp_path.iterdir()) == sorted(files)
    assert {file.suffix for file in files} == ({".v", ".hex"} if form == "verilog" else {Path(name).suffix})


def test_what_cannot_be_exported_is_refused(corner: BounceFilter, tmp_path: Path) -> None:
    exported = ExportedFilter.of(corner)
    with pytest.raises(ConfigError, match=r"a\.txt: no format has the suffix '\.txt'; use one of \.h, \.v"):
        export(exported, tmp_path / "a.txt")
    with pytest.raises(ConfigError, match="the format 'vhdl' is unknown; use one of c, verilog"):
        export(exported, tmp_path / "a.v", "vhdl")  # type: ignore[arg-type]
    with pytest.raises(ConfigError, match=r"the memory image gets the suffix \.hex"):
        export(exported, tmp_path / "a.hex", "verilog")
    with pytest.raises(OutputError, match=r"a\.v: the export cannot be written"):
        export(exported, tmp_path / "nowhere" / "a.v")
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        export(exported, tmp_path / "file" / "a.h")
    (tmp_path / "folder.h").mkdir()
    with pytest.raises(OutputError, match=r"folder\.h: the export cannot be written"):
        export(exported, tmp_path / "folder.h")
    (tmp_path / "b.hex").mkdir()
    with pytest.raises(OutputError, match=r"b\.hex: the export cannot be written \(Is a directory\)"):
        export(exported, tmp_path / "b.v")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b.hex", "file", "folder.h"]
