// SPDX-License-Identifier: Apache-2.0
#include "png_bomb.h"

#include <array>

namespace spa::test {
namespace {

std::string big_endian(std::uint32_t value) {
    std::string out;
    for (unsigned shift = 32; shift > 0; shift -= 8) out += char(value >> (shift - 8) & 0xFFU);
    return out;
}

std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

// RFC 1950, 8.2, for equal bytes.
std::uint32_t adler32(unsigned char byte, std::size_t count) {
    std::uint32_t a = 1, b = 0;
    for (std::size_t i = 0; i < count; ++i) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16U | a;
}

class BitWriter {
public:
    // The lowest bit first; Huffman codes are to be given reversed (RFC 1951, 3.1.1).
    void put(std::uint32_t bits, unsigned count) {
        for (unsigned i = 0; i < count; ++i, ++used_) {
            if (used_ % 8 == 0) out_ += '\0';
            out_.back() = char(static_cast<unsigned char>(out_.back()) | (bits >> i & 1U) << used_ % 8);
        }
    }
    void put_code(std::uint32_t code, unsigned count) {
        for (unsigned i = count; i-- > 0;) put(code >> i, 1);
    }
    [[nodiscard]] const std::string& bytes() const { return out_; }

private:
    std::string out_;
    unsigned used_ = 0;
};

// With the fixed Huffman codes (RFC 1951, 3.2.6).
void put_literal(BitWriter& writer, unsigned char byte) {
    if (byte < 144)
        writer.put_code(0x30U + byte, 8);
    else
        writer.put_code(0x190U + byte - 144, 9);
}

} // namespace

std::string compressed_run(char byte, std::size_t count) {
    BitWriter writer;
    writer.put(1, 1); // the last block
    writer.put(1, 2); // fixed codes
    const auto value = static_cast<unsigned char>(byte);
    std::size_t done = 0;
    for (; done < count && (done == 0 || (count - done) % 258 != 0); ++done) put_literal(writer, value);
    for (; done < count; done += 258) {
        writer.put_code(0xC5, 8); // 285: a length of 258
        writer.put_code(0, 5);    // a distance of 1
    }
    writer.put_code(0, 7); // the end
    return "\x78\x01" + writer.bytes() + big_endian(adler32(value, count));
}

std::string png_chunk(std::string_view type, std::string_view data) {
    const std::string content = std::string(type) + std::string(data);
    return big_endian(std::uint32_t(data.size())) + content + big_endian(crc32(content));
}

std::string black_png(std::uint32_t width, std::uint32_t height, std::string_view chunks) {
    const std::string header = big_endian(width) + big_endian(height) + std::string("\1\0\0\0\0", 5);
    const std::size_t row = (std::size_t{width} + 7) / 8 + 1;
    return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + std::string(chunks) +
           png_chunk("IDAT", compressed_run('\0', row * height)) + png_chunk("IEND", {});
}

} // namespace spa::test
