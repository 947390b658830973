"""The entry of the command `ial`."""

import sys


def main() -> None:
    """Run the command line."""
    if sys.argv[1:2] == ["stream"]:  # on a robot every import counts
        from ial.cli.lidar.stream import stream
        from ial.cli.shell.outcome import exit_status

        with exit_status():
            stream(sys.argv[2:])
        return
    from ial.cli.main import app

    app()
