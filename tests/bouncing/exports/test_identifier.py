import pytest

from ial.bouncing.exports.identifier import check_identifier
from ial.errors import ConfigError


@pytest.mark.parametrize("prefix", ["a", "B9", "bounce_2_"])
def test_letters_digits_and_underscores_are_taken(prefix: str) -> None:
    check_identifier(prefix)


@pytest.mark.parametrize("prefix", ["", "_a", "9a", "a-b", "a b", "é", "a\n", "a;"])
def test_everything_else_is_refused(prefix: str) -> None:
    with pytest.raises(ConfigError, match="is no identifier; give a letter"):
        check_identifier(prefix)
