"""Every example of the documentation runs, and prints what the page says."""

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parent.parent / "docs"
EXAMPLES = runpy.run_path(str(DOCS / "examples.py"))
SECTIONS = {
    f"{name}: {heading}": (DOCS / name, section)
    for name in EXAMPLES["PAGES"]
    for heading, section in EXAMPLES["sections"](DOCS / name).items()
}


@pytest.mark.parametrize("name", SECTIONS)
def test_an_example_prints_what_the_page_says(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    monkeypatch.chdir(tmp_path)  # where pictures are written
    page, section = SECTIONS[name]
    try:
        assert EXAMPLES["run"](page, section) == [example.printed for example in section]
    finally:
        pyplot.close("all")


@pytest.mark.parametrize("name", EXAMPLES["PAGES"])
def test_no_block_of_a_page_is_passed_over(name: str) -> None:
    text = (DOCS / name).read_text(encoding="utf-8")
    examples = [example for section in EXAMPLES["sections"](DOCS / name).values() for example in section]
    assert len(examples) == text.count("```python\n") > 0
    assert sum(bool(example.printed) for example in examples) == text.count("```text\n")


def test_every_picture_of_a_page_is_made_by_its_examples() -> None:
    for name in EXAMPLES["PAGES"]:
        text = (DOCS / name).read_text(encoding="utf-8")
        for picture in {part.partition(")")[0] for part in text.split("](_build/pictures/")[1:]}:
            assert f'savefig("{picture}"' in text


def test_a_wrong_output_is_noticed(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("# A page\n\n## A section\n\n```python\nprint(1 + 1)\n```\n\n```text\n3\n```\n")
    (section,) = EXAMPLES["sections"](page).values()
    assert section[0].printed == "3\n"
    assert EXAMPLES["run"](page, section) == ["2\n"]
