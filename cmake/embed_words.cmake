# SPDX-License-Identifier: Apache-2.0
# Writes the little-endian words of the file INPUT as the array NAME to the C++ header OUTPUT.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
file(WRITE ${OUTPUT} "#pragma once\n#include <cstdint>\nconstexpr std::uint32_t ${NAME}[] = {${words}};\n")
