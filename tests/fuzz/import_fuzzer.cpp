// SPDX-License-Identifier: Apache-2.0
// libFuzzer targets: any bytes as an asset of the name SPA_FUZZED_ASSET; see import_fuzzing.h.
#include "import_fuzzing.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    spa::test::fuzz_asset(SPA_FUZZED_ASSET, std::as_bytes(std::span(data, size)));
    return 0;
}
