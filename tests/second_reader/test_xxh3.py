# SPDX-License-Identifier: Apache-2.0
"""The checksums of read_spa.py against the table in formats/SPA.md, section 2 (the argument)."""

import re
import sys

import read_spa

with open(sys.argv[1], encoding="utf-8") as stream:
    table = re.findall(r"\| (\d+) \| ([0-9A-F]{16}) (?=\|)", stream.read())
assert len(table) == 12, table
for size, expected in table:
    value = read_spa.xxh3(bytes(i & 255 for i in range(int(size))))
    assert value == int(expected, 16), f"{size} bytes: {value:016X}, not {expected}"
