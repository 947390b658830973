from collections.abc import Callable
from typing import Any

import pytest

from tests.cli.pages import check


@pytest.mark.slow
def test_the_page_shows_what_is_printed(ial: Callable[..., Any]) -> None:
    check("odometer.md", ial)
