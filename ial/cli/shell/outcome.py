"""How the outcome of a command becomes an exit status."""

from collections.abc import Iterator
from contextlib import contextmanager

from ial.cli.shell.terminal import remark, remarks
from ial.errors import IalError

WRONG_INPUT, INTERRUPTED = 2, 130


@contextmanager
def exit_status() -> Iterator[None]:
    """Turn an error of ial, or too little memory, into one line on stderr and exit status 2, and an interruption into status 130."""
    with remarks():
        try:
            yield
        except IalError as error:
            remark("error", str(error), "bold red")
            raise SystemExit(WRONG_INPUT) from None
        except MemoryError:
            remark("error", "the memory does not hold what this needs; use larger cells, a smaller map, or fewer headings", "bold red")
            raise SystemExit(WRONG_INPUT) from None
        except KeyboardInterrupt:
            raise _interrupted() from None
        except SystemError as error:  # what Numba makes of an interruption within a kernel
            if not isinstance(error.__cause__ or error.__context__, KeyboardInterrupt):
                raise
            raise _interrupted() from None


def _interrupted() -> SystemExit:
    remark("interrupted", "nothing was written", "bold red")
    return SystemExit(INTERRUPTED)
