// SPDX-License-Identifier: Apache-2.0
#include "samples.h"
#include "scenes.h"

#include "../libspa/core/error.h"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace spa::samples {

namespace {

void write(const std::vector<std::byte>& bytes, const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    const auto fail = [&](int error_number) {
        std::error_code ignored;
        fs::remove(path.string() + ".part", ignored);
        throw Error(ExitCode::input_output,
                    path.string() + ": cannot be written: " + std::generic_category().message(error_number));
    };
    const fs::path temporary = path.string() + ".part";
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) fail(errno);
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) fail(error.value());
}

} // namespace

void write_glb(const Model& model, const std::filesystem::path& path) { write(to_glb(model), path); }
void write_glb(const Scene& scene, const std::filesystem::path& path) { write(to_glb(scene), path); }

} // namespace spa::samples
