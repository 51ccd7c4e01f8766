// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <exception>
#include <new>

namespace spa::tools {

Failure current_failure() {
    try {
        throw;
    } catch (const Error& error) {
        return {error.code(), error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitCode::unsupported, "out of memory; bake smaller maps or fewer layers"};
    } catch (const std::exception& error) {
        return {ExitCode::internal,
                std::string("internal error: ") + error.what() + "; please report it with the command line"};
    }
}

} // namespace spa::tools
