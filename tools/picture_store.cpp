// SPDX-License-Identifier: Apache-2.0
#include "picture_store.h"

#include "../libspa/core/error.h"

namespace spa::tools {

PictureStore::PictureStore(std::size_t count) : file_(std::tmpfile()), places_(count) {
    if (!file_)
        throw Error(ExitCode::input_output,
                    "no temporary file can be made for the report's pictures; set TMPDIR");
}

void PictureStore::put(std::size_t index, std::span<const std::byte> bytes) {
    if (std::fseek(file_.get(), 0, SEEK_END) != 0) return;
    const long offset = std::ftell(file_.get());
    if (offset < 0 || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) return;
    places_[index] = {offset, bytes.size()};
}

std::vector<std::byte> PictureStore::get(std::size_t index) const {
    const Place& place = places_[index];
    std::vector<std::byte> bytes(place.length);
    if (std::fseek(file_.get(), place.offset, SEEK_SET) != 0 ||
        std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        return {};
    return bytes;
}

} // namespace spa::tools
