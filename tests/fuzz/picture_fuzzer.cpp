// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: any bytes as a texture or as a picture to compare with; see import_fuzzing.h.
#include "import_fuzzing.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    spa::test::fuzz_picture(std::as_bytes(std::span(data, size)));
    return 0;
}
