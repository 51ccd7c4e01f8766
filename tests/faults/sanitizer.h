// SPDX-License-Identifier: Apache-2.0
// What a build with AddressSanitizer cannot try, and what takes it long.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define SPA_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPA_ADDRESS_SANITIZER
#endif
#endif

namespace spa::test {

#ifdef SPA_ADDRESS_SANITIZER
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

// It needs terabytes of addresses, and keeps what is freed for a while.
constexpr const char* no_memory_limits = "AddressSanitizer has its own idea of memory";

// How often something random is tried.
constexpr int rounds(int usual) { return is_sanitized ? (usual + 5) / 6 : usual; }

} // namespace spa::test
