// SPDX-License-Identifier: Apache-2.0
#include "ply_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>

namespace spa::import {
namespace {

template <class Unsigned>
Unsigned load(std::string_view bytes, bool big_endian) {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
        const std::size_t at = big_endian ? sizeof(Unsigned) - 1 - i : i;
        value = Unsigned(value | Unsigned(Unsigned{static_cast<unsigned char>(bytes[at])} << (8 * i)));
    }
    return value;
}

double load_value(std::string_view bytes, PlyType type, bool big_endian) {
    switch (type) {
    case PlyType::int8: return double(std::int8_t(load<std::uint8_t>(bytes, big_endian)));
    case PlyType::uint8: return double(load<std::uint8_t>(bytes, big_endian));
    case PlyType::int16: return double(std::int16_t(load<std::uint16_t>(bytes, big_endian)));
    case PlyType::uint16: return double(load<std::uint16_t>(bytes, big_endian));
    case PlyType::int32: return double(std::int32_t(load<std::uint32_t>(bytes, big_endian)));
    case PlyType::uint32: return double(load<std::uint32_t>(bytes, big_endian));
    case PlyType::float32: return double(std::bit_cast<float>(load<std::uint32_t>(bytes, big_endian)));
    case PlyType::float64: return std::bit_cast<double>(load<std::uint64_t>(bytes, big_endian));
    }
    return 0;
}

struct Range {
    double low, high;
};

Range range_of(PlyType type) {
    switch (type) {
    case PlyType::int8: return {-128, 127};
    case PlyType::uint8: return {0, 255};
    case PlyType::int16: return {-32768, 32767};
    case PlyType::uint16: return {0, 65535};
    case PlyType::int32: return {-2147483648.0, 2147483647.0};
    default: return {0, 4294967295.0};
    }
}

bool is_float(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

} // namespace

PlyData::PlyData(std::string_view text, const PlyHeader& header, const std::filesystem::path& path)
    : path_(path), format_(header.format), data_(text.substr(header.data_offset)), tokens_{{data_}, {}},
      first_line_(header.lines) {}

void PlyData::begin(const PlyElement& element) {
    element_ = &element;
    row_ = 0;
    if (element.properties.empty()) return;
    // In ASCII a value takes a character and what separates it from the next, except at the very end.
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties) {
        const PlyType type = property.is_list ? property.count_type : property.type;
        least += format_ == PlyFormat::ascii ? 2 : size_of(type);
    }
    const std::size_t available = left() + (format_ == PlyFormat::ascii ? 1 : 0);
    if (element.count > available / std::max(least, std::size_t{1}))
        fail(path_, "the header declares " + std::to_string(element.count) + " " + quote(element.name) +
                        " elements, more than the remaining " + std::to_string(left()) +
                        " bytes can hold; the file is cut off or damaged");
}

void PlyData::begin_row() {
    ++row_;
    if (format_ != PlyFormat::ascii) return;
    const std::string_view extra = trim(tokens_.rest);
    if (!extra.empty()) refuse("unexpected " + quote(extra) + " after the last value of the line");
}

std::size_t PlyData::left() const {
    if (format_ != PlyFormat::ascii) return data_.size();
    const std::size_t behind =
        tokens_.lines.text.size() - std::min(tokens_.lines.next, tokens_.lines.text.size());
    return behind + tokens_.rest.size();
}

void PlyData::refuse(const std::string& what) const {
    if (format_ == PlyFormat::ascii) fail(path_, first_line_ + tokens_.lines.line, what);
    fail(path_, quote(element_->name) + " element " + std::to_string(row_) + " of " +
                    std::to_string(element_->count) + ": " + what);
}

double PlyData::read_token(PlyType type) {
    const std::string_view token = tokens_.read();
    if (token.empty()) refuse("the file ends in the middle of the " + quote(element_->name) + " elements");
    if (is_float(type)) {
        // Values end up as floats; a double from the text would be rounded twice.
        const auto value = parse_float(token);
        if (!value) refuse(quote(token) + " is not a number");
        return double(*value);
    }
    // Some writers give integers as "3.0".
    const auto whole = parse_integer(token);
    const auto value = whole ? std::optional<double>(double(*whole)) : std::nullopt;
    const auto real = value ? std::nullopt : parse_float(token);
    const double number = value ? *value : double(real.value_or(0.5F));
    const Range range = range_of(type);
    if (number != std::floor(number) || number < range.low || number > range.high)
        refuse(quote(token) + " is not a whole number of the declared type");
    return number;
}

double PlyData::read(PlyType type) {
    if (format_ == PlyFormat::ascii) return read_token(type);
    const std::size_t size = size_of(type);
    if (data_.size() < size) refuse("the file ends in the middle of the data; it is cut off");
    const double value = load_value(data_, type, format_ == PlyFormat::big_endian);
    data_.remove_prefix(size);
    return value;
}

std::uint64_t PlyData::read_count(PlyType type) {
    const double count = read(type);
    if (count < 0) refuse("a list has a negative count");
    return std::uint64_t(count);
}

void PlyData::read_list(const PlyProperty& property, std::vector<double>& items) {
    const std::uint64_t count = read_count(property.count_type);
    const std::size_t least = format_ == PlyFormat::ascii ? 2 : size_of(property.type);
    if (count > (left() + 1) / least)
        refuse("a list declares " + std::to_string(count) + " items, more than the rest of the file holds");
    items.clear();
    for (std::uint64_t i = 0; i < count; ++i) items.push_back(read(property.type));
}

void PlyData::skip(const PlyProperty& property) {
    if (!property.is_list) {
        (void)read(property.type);
        return;
    }
    const std::uint64_t count = read_count(property.count_type);
    if (format_ == PlyFormat::ascii) {
        for (std::uint64_t i = 0; i < count; ++i) (void)read(property.type);
        return;
    }
    const std::size_t size = size_of(property.type);
    if (count > data_.size() / size)
        refuse("a list declares " + std::to_string(count) + " items, more than the rest of the file holds");
    data_.remove_prefix(std::size_t(count) * size);
}

bool PlyData::at_end() { return format_ == PlyFormat::ascii ? tokens_.read().empty() : data_.empty(); }

} // namespace spa::import
