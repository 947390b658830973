import pytest

from ial.cli.shell.outcome import exit_status


def test_too_little_memory_is_an_error_with_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught, exit_status():
        raise MemoryError
    assert caught.value.code == 2
    assert "the memory does not hold" in capsys.readouterr().err
