// SPDX-License-Identifier: Apache-2.0
// The models of `spa bench`, and what they are called.
#pragma once

#include "../libspa/mesh/model.h"

#include <string>

namespace spa::tools {

// "NAME:LEVEL" or "NAME" of a sample, or a file. A file of a sample's name wants "./". Throws what
// read_model and make_sample throw, and Error{usage} whose message starts with `option`.
Model load_bench_model(const std::string& option, const std::string& given);

// For names of files: letters, digits and "-" of the model's name, without folders and extension.
std::string bench_file_name(const std::string& model);

} // namespace spa::tools
