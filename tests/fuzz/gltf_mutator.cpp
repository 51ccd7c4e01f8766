// SPDX-License-Identifier: Apache-2.0
// Mutations for the glTF fuzzer that keep JSON well-formed: most changes of bytes only get as far as the
// parser.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Json = nlohmann::json;

class Mutator {
public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t count) { return random_() % count; }

    void mutate(Json& document) {
        for (std::size_t i = 1 + below(3); i > 0; --i) {
            values_.clear();
            collect(document);
            change(*values_[below(values_.size())]);
        }
    }

private:
    void collect(Json& value) {
        values_.push_back(&value);
        if (value.is_structured())
            for (Json& member : value) collect(member);
    }

    // A copy: what it is put into may be where it comes from.
    Json any() { return *values_[below(values_.size())]; }

    Json number(const Json& old) {
        constexpr std::array<std::int64_t, 22> edges{
            0,    1,    2,    3,     4,     5,  12,  16,   255,        256,        5121,
            5123, 5125, 5126, 65535, 65536, -1, 100, 1024, 2147483647, 4294967295, 9007199254740992};
        switch (below(5)) {
        case 0: return old.get<double>() + 1;
        case 1: return old.is_number_integer() ? Json(old.get<std::int64_t>() / 2) : Json(-old.get<double>());
        case 2: return std::array{0.5, -0.0, 1e-30, 1e30, 1e308, 3.5, -1e10}[below(7)];
        default: return edges[below(edges.size())];
        }
    }

    std::string key() {
        constexpr std::array keys{"mesh",       "skin",       "children", "indices",  "material",
                                  "bufferView", "byteOffset", "count",    "sparse",   "normalized",
                                  "byteStride", "targets",    "weights",  "matrix",   "camera",
                                  "extensions", "uri",        "mode",     "POSITION", "NORMAL",
                                  "TEXCOORD_0", "COLOR_0",    "JOINTS_0", "WEIGHTS_0"};
        return keys[below(keys.size())];
    }

    void change(Json& value) {
        if (below(6) == 0) {
            value = any();
        } else if (value.is_number()) {
            value = number(value);
        } else if (value.is_boolean()) {
            value = !value.get<bool>();
        } else if (value.is_string()) {
            change_string(value);
        } else if (value.is_array()) {
            change_array(value);
        } else if (value.is_object()) {
            change_object(value);
        }
    }

    void change_string(Json& value) {
        constexpr std::array words{"SCALAR",  "VEC2",       "VEC3",  "VEC4",    "MAT4",
                                   "MASK",    "a.png",      "a.bin", "a.tga",   "ATTRIBUTES",
                                   "INDICES", "OCTAHEDRAL", "",      "../a.bin"};
        if (below(2) == 0) {
            value = words[below(words.size())];
            return;
        }
        Json other = any();
        if (other.is_string()) value = std::move(other);
    }

    void change_array(Json& value) {
        const std::size_t size = value.size();
        switch (size == 0 ? 0 : below(4)) {
        case 0: value.push_back(any()); break;
        case 1: value.erase(below(size)); break;
        case 2: value.push_back(Json(value[below(size)])); break;
        default: std::swap(value[below(size)], value[below(size)]); break;
        }
    }

    void change_object(Json& value) {
        if (value.empty() || below(3) == 0) {
            value[key()] = any();
            return;
        }
        const auto member = std::next(value.begin(), std::ptrdiff_t(below(value.size())));
        if (below(2) == 0) {
            value.erase(member);
            return;
        }
        Json moved = *member;
        value.erase(member);
        value[key()] = std::move(moved);
    }

    std::minstd_rand random_;
    std::vector<Json*> values_;
};

// The JSON of an asset and, of a GLB, what follows its chunk.
struct Parts {
    bool binary = false;
    std::string_view json, rest;
};

Parts split(std::string_view text) {
    constexpr std::size_t head = 20;
    if (text.size() < head || !text.starts_with("glTF")) return {false, text, {}};
    std::uint32_t length = 0;
    std::memcpy(&length, text.data() + 12, sizeof length); // little-endian machines alone are fuzzed
    const std::string_view body = text.substr(head);
    return {true, body.substr(0, length), body.substr(std::min<std::size_t>(length, body.size()))};
}

std::string number_bytes(std::size_t value) {
    std::string out;
    for (unsigned shift = 0; shift < 32; shift += 8) out += char(value >> shift & 0xFFU);
    return out;
}

std::string join(const std::string& json, std::string_view rest, bool binary) {
    if (!binary) return json;
    std::string padded = json;
    while (padded.size() % 4 != 0) padded += ' ';
    return "glTF" + number_bytes(2) + number_bytes(20 + padded.size() + rest.size()) +
           number_bytes(padded.size()) + "JSON" + padded + std::string(rest);
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    Mutator mutator(seed);
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Parts parts = split(text);
    Json document = Json::parse(parts.json, nullptr, false);
    if (document.is_discarded() || mutator.below(5) == 0) return LLVMFuzzerMutate(data, size, max_size);
    std::string rest(parts.rest);
    if (parts.binary && rest.size() > 8 && mutator.below(3) == 0) {
        const std::size_t content = rest.size() - 8;
        rest.resize(8 + LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(rest.data()) + 8, content, content));
    } else {
        mutator.mutate(document);
    }
    const std::string out =
        join(document.dump(-1, ' ', false, Json::error_handler_t::replace), rest, parts.binary);
    if (out.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::memcpy(data, out.data(), out.size());
    return out.size();
}
