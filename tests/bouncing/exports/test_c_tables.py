import re
import subprocess
from pathlib import Path

import pytest

from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import ConfigError
from tests.bouncing.exports.test_c_source import compiled


def test_bytes_are_those_of_the_compiler(small: BounceFilter, tmp_path: Path) -> None:
    exported = ExportedFilter.of(small)
    tables = CTables.of(exported, "room")
    header = c_header(exported, "room")
    names = re.findall(r"static const ROOM_FLASH \w+ (\w+)", header.partition("inline")[0])
    program = '#include <stdio.h>\n#include "f.h"\nint main(void) { printf("%lu %lu %lu", (unsigned long)('
    program += " + ".join(f"sizeof({name})" for name in names)
    program += "), (unsigned long)(sizeof(room_next) + sizeof(room_colours)), (unsigned long)sizeof(room_state)); return 0; }\n"
    done = subprocess.run([compiled("gcc", header, program, tmp_path)], capture_output=True, text=True, check=True)
    assert done.stdout == f"{tables.flash_bytes} {tables.stepping_bytes} {tables.ram_bytes}"
    assert len(names) == len(tables.stepping) + len(tables.telling)


def test_the_budget(corner: BounceFilter) -> None:
    tables = CTables.of(ExportedFilter.of(corner), "room")
    assert tables.excess(tables.flash_bytes) is None
    said = tables.excess(tables.flash_bytes - 1)
    assert said is not None
    assert f"take {tables.flash_bytes:,} bytes of flash, and the budget is {tables.flash_bytes - 1:,}" in said
    assert "--minimize colours" in said
    with pytest.raises(ConfigError, match="is -1 bytes"):
        tables.excess(-1)
