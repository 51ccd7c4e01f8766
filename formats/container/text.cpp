// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include <array>

namespace spa::container {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
    return i < text.size() ? std::uint8_t(text[i]) : 0U;
}

// The length of the UTF-8 sequence at i; 0 if there is none (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text, std::size_t i) {
    const unsigned lead = byte_at(text, i);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || length > text.size() - i) return 0;
    unsigned low = 0x80;
    unsigned high = 0xBF;
    if (lead == 0xE0) low = 0xA0;
    if (lead == 0xED) high = 0x9F;
    if (lead == 0xF0) low = 0x90;
    if (lead == 0xF4) high = 0x8F;
    if (byte_at(text, i + 1) < low || byte_at(text, i + 1) > high) return 0;
    for (std::size_t k = 2; k < length; ++k)
        if ((byte_at(text, i + k) & 0xC0U) != 0x80) return 0;
    return length;
}

bool is_digit(unsigned c) { return c >= '0' && c <= '9'; }
bool is_hex(unsigned c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

// Reads tokens off the front. Every function returns whether it found what it looks for.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}
    [[nodiscard]] std::size_t position() const { return at_; }
    [[nodiscard]] bool at_end() const { return at_ == text_.size(); }

    void skip_space() {
        while (!at_end() &&
               (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
            ++at_;
    }
    bool take(char c) {
        if (at_end() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    bool take_string() {
        if (!take('"')) return false;
        while (!at_end()) {
            const unsigned c = byte_at(text_, at_);
            if (c < 0x20) return false;
            ++at_;
            if (c == '"') return true;
            if (c == '\\' && !take_escape()) return false;
        }
        return false;
    }
    bool take_scalar() {
        for (const std::string_view word : {"true", "false", "null"}) {
            if (text_.substr(at_, word.size()) == word) {
                at_ += word.size();
                return true;
            }
        }
        return byte_at(text_, at_) == '"' ? take_string() : take_number();
    }

private:
    bool take_escape() {
        const unsigned c = byte_at(text_, at_++);
        if (c != 'u') return std::string_view("\"\\/bfnrt").find(char(c)) != std::string_view::npos && c != 0;
        for (int i = 0; i < 4; ++i)
            if (!is_hex(byte_at(text_, at_++))) return false;
        return true;
    }
    bool take_digits() {
        const std::size_t first = at_;
        while (is_digit(byte_at(text_, at_))) ++at_;
        return at_ > first;
    }
    bool take_number() {
        take('-');
        if (!take('0') && !take_digits()) return false;
        if (take('.') && !take_digits()) return false;
        if (take('e') || take('E')) {
            if (!take('+')) take('-');
            if (!take_digits()) return false;
        }
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// After a value: closes what ends here. Returns false where the text is wrong.
bool close_containers(Scanner& scan, const std::array<char, json_depth_limit>& closers, std::size_t& depth) {
    for (;;) {
        scan.skip_space();
        if (depth == 0 || scan.take(',')) return true;
        if (!scan.take(closers[depth - 1])) return false;
        --depth;
    }
}

} // namespace

std::size_t find_utf8_error(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        const std::size_t length = utf8_length(text, i);
        if (length == 0) return i;
        i += length;
    }
    return text_ok;
}

std::size_t find_json_error(std::string_view text) {
    Scanner scan(text);
    std::array<char, json_depth_limit> closers{};
    std::size_t depth = 0;
    scan.skip_space();
    bool first = true;
    while (first || depth > 0) {
        // A value begins here; in an object its name comes before it.
        scan.skip_space();
        if (depth > 0 && closers[depth - 1] == '}') {
            if (!scan.take_string()) return scan.position();
            scan.skip_space();
            if (!scan.take(':')) return scan.position();
            scan.skip_space();
        }
        const bool object = scan.take('{');
        if (first && !object) return scan.position();
        first = false;
        if (object || scan.take('[')) {
            if (depth == json_depth_limit) return scan.position() - 1;
            closers[depth] = object ? '}' : ']';
            scan.skip_space();
            if (!scan.take(closers[depth])) {
                ++depth;
                continue;
            }
        } else if (!scan.take_scalar()) {
            return scan.position();
        }
        if (!close_containers(scan, closers, depth)) return scan.position();
    }
    return scan.at_end() ? text_ok : scan.position();
}

} // namespace spa::container
