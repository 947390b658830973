import importlib
import sys
from pathlib import Path

import pytest

PACKAGE = """
from ial.lazy import lazy

__getattr__, __dir__, __all__ = lazy(__name__, {"sound": ["value"], "broken": ["other"], "alone": []})
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    folder = tmp_path / "lazily"
    folder.mkdir()
    files = {"__init__": PACKAGE, "sound": "value = 3\n", "broken": "import math\nother = math.missing\n", "alone": ""}
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("lazily", *(f"lazily.{file}" for file in files)):
        monkeypatch.delitem(sys.modules, name, raising=False)  # of another test
    importlib.invalidate_caches()
    return "lazily"


def test_names_and_modules_are_loaded_when_they_are_used(package: str) -> None:
    names: dict[str, object] = {}
    exec(f"import {package}\nfrom {package} import alone, value", names)
    assert names["value"] == 3
    assert dir(names[package]) == ["alone", "other", "value"]
    with pytest.raises(AttributeError, match="module 'lazily' has no attribute 'nothing'"):
        _ = names[package].nothing  # type: ignore[attr-defined]


def test_why_a_module_cannot_be_imported_is_said(package: str) -> None:
    with pytest.raises(ImportError, match=r"lazily\.other cannot be imported: module 'math' has no attribute 'missing'") as refused:
        exec(f"from {package} import other")
    assert isinstance(refused.value.__cause__, AttributeError)
