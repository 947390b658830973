"""`ial warm`: the kernels, compiled before they are needed."""

import time

from ial.cli.shell.terminal import say


def warm() -> None:
    """Compile everything that the localizer runs for this processor, so that no scan of a robot waits; once after an installation."""
    from ial.contractors.kernel_folder import kernel_folder
    from ial.contractors.prebuilt_kernels import ignore_prebuilt
    from ial.lidar.warming import warm

    begun = time.perf_counter()
    ignore_prebuilt()  # what came with ial is compiled for any processor of its kind, and slower
    warm()
    folder = kernel_folder()
    where = f"are in {folder.path}" if folder.keeps else "could not be kept, so the next start compiles them again"
    say(f"the kernels {where} ({time.perf_counter() - begun:.1f} s)")
