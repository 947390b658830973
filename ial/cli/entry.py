"""The entry of the command `ial`."""

import sys


def main() -> None:
    """Run the command line."""
    if sys.argv[1:2] == ["stream"]:  # on a robot every import counts
        from ial.cli.outcome import exit_status
        from ial.cli.stream import stream

        with exit_status():
            stream(sys.argv[2:])
        return
    from ial.cli.main import app

    app()
