// SPDX-License-Identifier: Apache-2.0
// Many small pictures on disk instead of in memory, for as long as this lives.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

namespace spa::tools {

class PictureStore {
public:
    explicit PictureStore(std::size_t count); // throws Error{input_output} if there is no temporary file

    // What cannot be written is forgotten: a report without a picture is better than none.
    void put(std::size_t index, std::span<const std::byte> bytes);
    [[nodiscard]] std::vector<std::byte> get(std::size_t index) const; // empty if there is none

private:
    struct Place {
        long offset = 0;
        std::size_t length = 0;
    };
    struct Closer {
        void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
    };
    std::unique_ptr<std::FILE, Closer> file_;
    std::vector<Place> places_;
};

} // namespace spa::tools
