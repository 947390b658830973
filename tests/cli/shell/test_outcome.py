import pytest

from ial.cli.shell.outcome import exit_status


def test_too_little_memory_is_an_error_with_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught, exit_status():
        raise MemoryError
    assert caught.value.code == 2
    assert "the memory does not hold" in capsys.readouterr().err


def test_an_interruption_within_a_kernel_is_one(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught, exit_status():
        raise SystemError("returned a result with an exception set") from KeyboardInterrupt()
    assert caught.value.code == 130
    assert "interrupted: nothing was written" in capsys.readouterr().err
    with pytest.raises(SystemError), exit_status():
        raise SystemError("something else")
