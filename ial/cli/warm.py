"""`ial warm`: the kernels, compiled before they are needed."""

import time

from ial.cli.terminal import say


def warm() -> None:
    """Compile everything that the localizer runs, so that the first scan of a robot does not wait; needed once after an installation."""
    from ial.contractors.kernels import cache_folder
    from ial.lidar.warming import warm

    begun = time.perf_counter()
    warm()
    say(f"the kernels are in {cache_folder()} ({time.perf_counter() - begun:.1f} s)")
