// SPDX-License-Identifier: Apache-2.0
// What methods of the fakes do that nobody should call.
#pragma once

#include "../../libspa/dxr/d3d12.h"

namespace spa::test {

// Ends the test program.
[[noreturn]] void unexpected(const char* method);

} // namespace spa::test
