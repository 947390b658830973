"""`ial warm`: the kernels, compiled before they are needed."""

import time

from ial.cli.shell.terminal import say


def warm() -> None:
    """Compile everything that the localizer runs, so that the first scan of a robot does not wait; needed once after an installation."""
    from ial.contractors.kernel_folder import kernel_folder
    from ial.lidar.warming import warm

    begun = time.perf_counter()
    warm()
    folder = kernel_folder()
    where = f"are in {folder.path}" if folder.keeps else "could not be kept, so the next start compiles them again"
    say(f"the kernels {where} ({time.perf_counter() - begun:.1f} s)")
