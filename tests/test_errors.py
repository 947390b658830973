import pytest

import ial
from ial import errors

FAMILY = [each for each in vars(errors).values() if isinstance(each, type) and issubclass(each, Exception)]


@pytest.mark.parametrize("error", FAMILY)
def test_every_error_is_of_the_family_public_and_says_what_it_is_about(error: type[Exception]) -> None:
    assert issubclass(error, ial.IalError)
    assert getattr(ial, error.__name__) is error
    assert error.__doc__


def test_causes_can_be_told_apart() -> None:
    assert all(error.__bases__ == (errors.IalError,) for error in FAMILY if error is not errors.IalError)
