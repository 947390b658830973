from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.contractors import kernel_folder, prebuilt_kernels
from ial.contractors.kernel_folder import KernelFolder
from ial.lidar import warming


@pytest.mark.parametrize("kept", [True, False])
def test_it_says_where_the_kernels_are_and_only_if_they_are_there(
    ial: Callable[..., Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, kept: bool
) -> None:
    folder = KernelFolder(tmp_path)
    monkeypatch.setattr(kernel_folder, "kernel_folder", lambda: folder)
    monkeypatch.setattr(warming, "warm", lambda: None if kept else folder.stop("the disk is full"))
    monkeypatch.setattr(prebuilt_kernels, "_ignored", False)
    result = ial("warm")
    assert prebuilt_kernels._ignored  # kernels for this very processor are wanted
    expected = f"the kernels are in {tmp_path} (" if kept else "the kernels could not be kept, so the next start compiles them again ("
    assert (result.exit_code, result.stdout.startswith(expected)) == (0, True)
