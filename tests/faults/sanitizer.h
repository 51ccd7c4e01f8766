// SPDX-License-Identifier: Apache-2.0
// SPA_ADDRESS_SANITIZER is defined in a build with AddressSanitizer.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define SPA_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPA_ADDRESS_SANITIZER
#endif
#endif
