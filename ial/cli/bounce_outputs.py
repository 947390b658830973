"""What `ial bounce` writes, looked at before any work is done."""

from collections.abc import Sequence
from pathlib import Path


def check_outputs(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    """Refuse files that cannot be written, or that would replace what the command reads or writes.

    Raises
    ------
    ConfigError
        If one is a folder, lies in none, is one of the inputs, or is named twice.
    """
    from ial.errors import ConfigError

    for number, out in enumerate(outputs):
        if not out.name or out.is_dir():
            raise ConfigError(f"{out}: is a folder; name the file in it that shall be written")
        if not out.parent.is_dir():
            raise ConfigError(f"{out}: cannot be written, since there is no folder {out.parent}; make it, or choose another")
        if out.exists() and any(each.exists() and out.samefile(each) for each in inputs):
            raise ConfigError(f"{out}: this is an input of the command, which its output would replace; give another file")
        if out.resolve() in [each.resolve() for each in outputs[:number]]:
            raise ConfigError(f"{out}: is to be written twice; give each output a file of its own")
