// SPDX-License-Identifier: Apache-2.0
// What an exception means to the user.
#pragma once

#include "../libspa/core/error.h"

#include <string>

namespace spa::tools {

struct Failure {
    ExitCode code = ExitCode::internal;
    std::string message;
};

// Of the exception that is being handled; call it in a catch block. bake::Cancelled is none of its business.
Failure current_failure();

} // namespace spa::tools
