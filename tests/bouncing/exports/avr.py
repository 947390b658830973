"""Programs for AVR processors, compiled by avr-gcc and run by simavr, where those are installed."""

import shutil
import subprocess
from pathlib import Path

import pytest

REPLAY = """\
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include "f.h"

static const __flash unsigned char seen[] = {%s};

static void put(char letter) {
    while (!(UCSR0A & (1 << UDRE0))) {
    }
    UDR0 = (unsigned char)letter;
}

static void number(uint32_t value) {
    char digits[10];
    unsigned char count = 0;
    do {
        digits[count++] = (char)('0' + value %% 10u);
        value /= 10u;
    } while (value);
    while (count) {
        put(digits[--count]);
    }
    put(' ');
}

int main(void) {
    room_state state = ROOM_START;
    unsigned i;
    UCSR0B = 1 << TXEN0;
    for (i = 0; i < sizeof seen; i++) {
        state = room_step(state, seen[i]);
        number(state);
        number(room_colour(state));
        number((uint32_t)room_trapped(state));
        number((uint32_t)room_localized(state));
        number(room_size(state));
        put('\\n');
    }
    cli();
    sleep_enable();
    sleep_cpu();
    return 0;
}
"""

OPTIONS = ["-std=gnu99", "-Wall", "-Wextra", "-Werror", "-Os"]


def compiled_for(processor: str, flash: str, header: str, program: str, folder: Path, *more: str) -> Path:
    """A program that includes the header as f.h, with its tables in a kind of flash."""
    if shutil.which("avr-gcc") is None:
        pytest.skip("avr-gcc is not installed")
    (folder / "f.h").write_text(header)
    (folder / "main.c").write_text(program)
    options = [*OPTIONS, f"-mmcu={processor}", f"-DROOM_FLASH={flash}", *more]
    subprocess.run(["avr-gcc", *options, "main.c", "-o", "main.elf"], cwd=folder, check=True)
    return folder / "main.elf"


def sections(program: Path) -> dict[str, int]:
    """The bytes of each section."""
    listed = subprocess.run(["avr-size", "-A", program], capture_output=True, text=True, check=True).stdout
    return {line.split()[0]: int(line.split()[1]) for line in listed.splitlines() if line.startswith(".")}


def run_on(processor: str, program: Path) -> list[list[int]]:
    """The rows of numbers that a program sends."""
    if shutil.which("simavr") is None:
        pytest.skip("simavr is not installed")
    done = subprocess.run(["simavr", "-m", processor, "-f", "16000000", program], capture_output=True, text=True, check=True, timeout=120)
    lines = [line.replace("\x1b[32m", "").replace("\x1b[0m", "") for line in (done.stdout + done.stderr).splitlines()]
    return [[int(word) for word in line.rstrip(".").split()] for line in lines if line[:1].isdigit()]
