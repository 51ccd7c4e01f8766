// SPDX-License-Identifier: Apache-2.0
// How everything outside the core and the container reports failure: one exception type whose code
// becomes the exit code of the command. Code that reads untrusted `.spa` bytes or runs per ray returns
// status enums instead and never throws.
#pragma once

#include <stdexcept>
#include <string>

namespace spa {

// Exit codes of the `spa` command.
enum class ExitCode : int {
    ok = 0,
    usage = 1,        // unknown option, bad value, missing argument
    input_output = 2, // a file cannot be opened, read, written or renamed
    invalid_data = 3, // a file was read and its content is wrong
    internal = 4,     // our own mistake
    unsupported = 5,  // valid, but needs something this build or machine lacks
    limits = 6,       // a measured figure misses a threshold the caller set
};

class Error : public std::runtime_error {
public:
    // message: names the file, what is wrong, where, and what to do about it.
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

} // namespace spa
