import pytest

from ial.bouncing.stream import parse_stream
from ial.errors import StreamError


def test_observations_are_read() -> None:
    assert parse_stream("001 01\n1\t") == [0, 0, 1, 0, 1, 1]
    assert parse_stream("") == []


@pytest.mark.parametrize(
    ("text", "message"), [("0012", "symbol 4 of the stream is '2'"), ("0 x", "symbol 2 .* 'x'"), ("0,1", "','"), ("٠", "'٠'")]
)
def test_other_symbols_are_refused(text: str, message: str) -> None:
    with pytest.raises(StreamError, match=message):
        parse_stream(text)
