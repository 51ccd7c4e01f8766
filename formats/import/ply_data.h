// SPDX-License-Identifier: Apache-2.0
// The values after a PLY header, ASCII or binary, one after the other.
#pragma once

#include "ply_header.h"
#include "text.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

// Never reads behind the data; every error is thrown as Error(invalid_data) that names the line (ASCII) or
// the element and its number (binary).
class PlyData {
public:
    // text: the whole file.
    PlyData(std::string_view text, const PlyHeader& header, const std::filesystem::path& path);

    // Begins an element of the header. Refuses a count that the rest of the file cannot hold, before anything
    // is allocated for it.
    void begin(const PlyElement& element);
    // Begins the next of its rows; in ASCII a row starts on a line of its own and may go on over several.
    void begin_row();
    // The next value. Every integer type is exact in a double.
    double read(PlyType type);
    // The next list.
    void read_list(const PlyProperty& property, std::vector<double>& items);
    void skip(const PlyProperty& property);

    // After the last element: how many bytes (ASCII: whether a token) are left.
    bool at_end();
    [[noreturn]] void refuse(const std::string& what) const;

private:
    double read_token(PlyType type);
    std::uint64_t read_count(PlyType type);
    std::size_t left() const;

    const std::filesystem::path& path_;
    PlyFormat format_;
    std::string_view data_;  // binary: what is left
    TokenReader tokens_;     // ASCII
    std::size_t first_line_; // of the data
    const PlyElement* element_ = nullptr;
    std::uint64_t row_ = 0; // from 1
};

} // namespace spa::import
