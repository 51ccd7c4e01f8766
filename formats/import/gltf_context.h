// SPDX-License-Identifier: Apache-2.0
// What every step of the glTF reader is given, and how it reports.
#pragma once

#include "../../libspa/core/error.h"
#include "import.h"
#include "source_file.h"
#include "text.h"

#include <string>
#include <string_view>

namespace spa::import::gltf {

struct Context {
    const Asset& asset;
    const Limits& limits;
    Report& report;
    References& references;
};

// `where` is the place in the document, as in "accessors[3].bufferView"; may be empty.
[[noreturn]] inline void fail(const Context& context, const std::string& where, const std::string& what) {
    throw Error(ExitCode::invalid_data,
                context.asset.path.string() + ": " + shorten((where.empty() ? "" : where + ": ") + what));
}

inline void warn(const Context& context, const std::string& where, const std::string& what) {
    add_warning(context.report, shorten((where.empty() ? "" : where + ": ") + what));
}

// "accessors[3]"
inline std::string at(std::string_view array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

} // namespace spa::import::gltf
