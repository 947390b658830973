import shutil
from pathlib import Path

import pytest

from ial.contractors import kernel_compiler
from tests.contractors.package_copy import RESULT, USE, PackageCopy
from tests.contractors.pickle_bomb import plant

COMPILING = "compiling kernels, once, that were not used before "


def build(copy: PackageCopy, processor: str) -> Path:
    """Compile the kernels of a copy for a processor, and put them where those of a wheel are; return where."""
    built = copy.folder / "built"
    copy.use(NUMBA_CPU_NAME=processor, NUMBA_CPU_FEATURES="", IAL_CACHE_DIR=str(built))
    (folder,) = built.iterdir()
    place = copy.package / "contractors" / "prebuilt-kernels" / f"kernels-{kernel_compiler.portable_hash(processor)}"
    place.parent.mkdir(0o755, exist_ok=True)
    shutil.move(folder, place)
    built.rmdir()
    return place


@pytest.fixture
def copy(tmp_path: Path) -> PackageCopy:
    return PackageCopy(tmp_path)


@pytest.mark.slow
def test_they_are_used_without_compiling_and_kernels_of_this_processor_win(copy: PackageCopy) -> None:
    place = build(copy, "x86-64")
    prebuilt = copy.kept
    assert copy.use() == (RESULT, [])
    assert copy.kept == prebuilt
    ignoring = "from ial.contractors.prebuilt_kernels import ignore_prebuilt\nignore_prebuilt()\n"
    result, (line,) = copy.use(ignoring + USE)
    assert (result, line.startswith(COMPILING)) == (RESULT, True)
    mark = copy.folder / "run"
    plant(place, mark)
    assert copy.use() == (RESULT, [])
    assert not mark.exists()
    shutil.rmtree(copy.package / "contractors" / "__pycache__")
    copy.use()
    assert mark.exists()  # so the bomb works


@pytest.mark.slow
def test_what_others_could_have_written_and_what_is_damaged_is_compiled(copy: PackageCopy) -> None:
    place = build(copy, "x86-64")
    mark = copy.folder / "run"
    whole = {file: file.read_bytes() for file in place.iterdir()}
    plant(place, mark)
    place.chmod(0o770)
    result, (refused, line) = copy.use()
    assert (result, refused.startswith(f"compiled kernels that came with ial are not used: {place} ")) == (RESULT, True)
    assert (line.startswith(COMPILING), mark.exists()) == (True, False)
    place.chmod(0o700)
    for file, content in whole.items():
        file.write_bytes(content[:-1])
    shutil.rmtree(copy.package / "contractors" / "__pycache__")
    result, (line,) = copy.use()
    assert (result, line.startswith("compiling kernels again, for what was kept cannot be used: damaged: ")) == (RESULT, True)
    assert copy.use() == (RESULT, [])


@pytest.mark.slow
def test_a_change_of_the_source_is_noticed(copy: PackageCopy) -> None:
    build(copy, "x86-64")
    copy.constant.write_text("STEP = 2.00\n")
    result, (line,) = copy.use()
    assert (result, line.startswith(COMPILING)) == ("3.0 5.0 10.0", True)
