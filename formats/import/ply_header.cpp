// SPDX-License-Identifier: Apache-2.0
#include "ply_header.h"

#include "text.h"

#include <algorithm>
#include <array>
#include <optional>

namespace spa::import {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

// The names of 1994 and those with sizes that newer writers use.
constexpr std::array<TypeName, 16> type_names{{{"char", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"int8", PlyType::int8},
                                               {"uint8", PlyType::uint8},
                                               {"int16", PlyType::int16},
                                               {"uint16", PlyType::uint16},
                                               {"int32", PlyType::int32},
                                               {"uint32", PlyType::uint32},
                                               {"float32", PlyType::float32},
                                               {"float64", PlyType::float64}}};

// One header line, read word by word.
struct HeaderLine {
    const std::filesystem::path& path;
    std::size_t line;
    std::string_view rest;

    [[noreturn]] void refuse(const std::string& what) const { fail(path, line, what); }

    std::string_view word(const char* what) {
        const std::string_view token = cut_token(rest);
        if (token.empty()) refuse(std::string("the header lacks ") + what);
        return token;
    }
    PlyType type() {
        const std::string_view token = word("a type");
        const auto* const found = std::find_if(type_names.begin(), type_names.end(),
                                               [&](const TypeName& t) { return t.name == token; });
        if (found == type_names.end()) refuse("unknown type " + quote(token));
        return found->type;
    }
    void end() {
        const std::string_view extra = trim(rest);
        if (!extra.empty()) refuse("unexpected " + quote(extra) + " at the end of a header line");
    }
};

void read_format(HeaderLine& line, std::optional<PlyFormat>& format) {
    const std::string_view name = line.word("the format");
    if (format) line.refuse("the format is declared twice");
    if (name == "ascii")
        format = PlyFormat::ascii;
    else if (name == "binary_little_endian")
        format = PlyFormat::little_endian;
    else if (name == "binary_big_endian")
        format = PlyFormat::big_endian;
    else
        line.refuse("unknown format " + quote(name) +
                    "; it must be ascii, binary_little_endian or binary_big_endian");
    const std::string_view version = line.word("the version after the format");
    if (version != "1.0") line.refuse("unknown version " + quote(version) + "; it must be 1.0");
    line.end();
}

void read_element(HeaderLine& line, PlyHeader& header) {
    PlyElement element;
    element.name = line.word("the name of an element");
    const std::string_view count = line.word("the count of an element");
    const auto value = parse_integer(count);
    if (!value || *value < 0) line.refuse("the element count " + quote(count) + " is not a whole number");
    element.count = std::uint64_t(*value);
    line.end();
    for (const PlyElement& other : header.elements) {
        if (other.name == element.name)
            line.refuse("the element " + quote(element.name) + " is declared twice");
    }
    // Real files have a handful; a limit keeps the search above short.
    if (header.elements.size() == 256) line.refuse("more than 256 elements");
    header.elements.push_back(std::move(element));
}

void read_property(HeaderLine& line, PlyHeader& header) {
    if (header.elements.empty()) line.refuse("a property comes before the first element");
    PlyElement& element = header.elements.back();
    PlyProperty property;
    std::string_view peek = line.rest;
    if (cut_token(peek) == "list") {
        line.rest = peek;
        property.is_list = true;
        property.count_type = line.type();
        if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
            line.refuse("the count of a list must be of an integer type");
    }
    property.type = line.type();
    property.name = line.word("the name of a property");
    line.end();
    for (const PlyProperty& other : element.properties) {
        if (other.name == property.name)
            line.refuse("the property " + quote(property.name) + " is declared twice");
    }
    if (element.properties.size() == 1024) line.refuse("more than 1024 properties of an element");
    element.properties.push_back(std::move(property));
}

} // namespace

std::size_t size_of(PlyType type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[std::size_t(type)];
}

PlyHeader parse_ply_header(std::string_view text, const std::filesystem::path& path) {
    LineReader lines{text};
    const auto first = lines.read();
    if (!first || trim(*first) != "ply") fail(path, "does not begin with a line 'ply'");
    // Where lines end with "\r" alone, a "\n" after the header is data.
    const bool carriage_return_only = lines.next >= 1 && text.substr(0, lines.next).back() == '\r';

    PlyHeader header;
    std::optional<PlyFormat> format;
    while (const auto read = lines.read()) {
        HeaderLine line{path, lines.line, trim(*read)};
        std::string_view peek = line.rest;
        const std::string_view keyword = cut_token(peek);
        if (keyword.empty() || line.rest.starts_with("Created by")) continue;
        line.rest = peek;
        if (keyword == "comment" || keyword == "obj_info") {
            if (cut_token(peek) == "TextureFile") header.textures.emplace_back(trim(peek));
        } else if (keyword == "format") {
            read_format(line, format);
        } else if (keyword == "element") {
            read_element(line, header);
        } else if (keyword == "property") {
            read_property(line, header);
        } else if (keyword == "end_header") {
            line.end();
            if (!format) fail(path, "the header has no format line");
            header.format = *format;
            header.lines = lines.line;
            header.data_offset = std::min(lines.next, text.size());
            if (carriage_return_only && text[header.data_offset - 1] == '\n') --header.data_offset;
            return header;
        } else {
            line.refuse("unknown header statement " + quote(keyword));
        }
    }
    fail(path, "the header has no end_header line; the file is cut off or no PLY file");
}

} // namespace spa::import
