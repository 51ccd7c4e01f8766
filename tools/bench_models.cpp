// SPDX-License-Identifier: Apache-2.0
#include "bench_models.h"

#include "arguments.h"

#include "../formats/import/import.h"
#include "../samples/samples.h"

#include <cctype>

namespace spa::tools {

Model load_bench_model(const std::string& option, const std::string& given) {
    const std::size_t colon = given.find(':');
    const std::string name = given.substr(0, colon);
    const samples::Sample* const sample = samples::find_sample(name);
    if (sample == nullptr) return spa::import::read_model(given).model;
    const int level = colon == std::string::npos
                          ? sample->default_level
                          : int(parse_number(option, given.substr(colon + 1), 0, samples::max_level));
    return samples::make_sample(name, level);
}

std::string bench_file_name(const std::string& model) {
    const std::size_t slash = model.find_last_of('/');
    std::string name = slash == std::string::npos ? model : model.substr(slash + 1);
    name = name.substr(0, name.find_last_of('.'));
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
    return name;
}

} // namespace spa::tools
