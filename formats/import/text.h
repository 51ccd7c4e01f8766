// SPDX-License-Identifier: Apache-2.0
// Pieces of the text formats: lines with their numbers, tokens, numbers, and messages that say where.
// Everything works on views into the file's bytes; nothing depends on the locale.
#pragma once

#include "import.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spa::import {

// The bytes as text, without a UTF-8 byte order mark.
std::string_view as_text(std::span<const std::byte> bytes);

// Walks over the lines of a text. A line ends with "\n", "\r\n" or "\r".
struct LineReader {
    std::string_view text;
    std::size_t next = 0; // offset of the line that read() returns next
    std::size_t line = 0; // number of the line that read() returned last, from 1

    // The next line without its end; nothing at the end of the text.
    std::optional<std::string_view> read();
};

// Walks over the tokens of a text, across lines.
struct TokenReader {
    LineReader lines;
    std::string_view rest; // of the current line

    // The next token; empty at the end of the text.
    std::string_view read();
};

// Cuts the first token (between blanks and tabs) off `rest`; empty when there is none.
std::string_view cut_token(std::string_view& rest);

// Without blanks, tabs and other control characters at both ends.
std::string_view trim(std::string_view text);

// Whether two texts are equal but for the case of ASCII letters.
bool equal_ignoring_case(std::string_view a, std::string_view b);

// A decimal number that fills the whole token: any sign, with or without exponent, nan, inf, and what
// Microsoft's C library printed for them (1.#IND, -1.#INF). Too large gives an infinity, too small 0.
// Nothing if the token is no number.
std::optional<float> parse_float(std::string_view token);

// A whole number that fills the token. Nothing if it is none or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view token);

// A piece of the file for a message: in quotes, control characters replaced, cut after 60 characters.
std::string quote(std::string_view text);

// A message that repeats what the file holds, cut after a thousand bytes.
std::string shorten(std::string message);

// Throw Error(invalid_data, "PATH: what") and "PATH: line LINE: what".
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what);
[[noreturn]] void fail(const std::filesystem::path& path, std::size_t line, const std::string& what);

// Adds a warning as add_warning does, but no more than a hundred and a last one that says so: a hostile file
// must not make the search for duplicates long.
void warn(Report& report, std::string warning);

} // namespace spa::import
