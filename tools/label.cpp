// SPDX-License-Identifier: Apache-2.0
#include "label.h"

#include <array>

namespace spa::tools {

namespace {

constexpr std::uint32_t glyph_width = 5;
constexpr char first_glyph = ' ', last_glyph = '~';

// 5 x 9 pixels a glyph in 45 bits: rows from the top, five bits a row, the leftmost pixel lowest. The
// baseline is under row 6.
constexpr std::array<std::uint64_t, last_glyph - first_glyph + 1> glyphs{
    0x000000000000, 0x000100421084, 0x00000000294A, 0x000295F57D4A, 0x00011F4717C4, 0x000672222273,
    0x000593511526, 0x000000001084, 0x000208210888, 0x000088842082, 0x000009575480, 0x0000084F9080,
    0x02218C000000, 0x0000000F8000, 0x00018C000000, 0x000042222210, 0x0003A33AE62E, 0x0003884210C4,
    0x0007C226422E, 0x0003A306422E, 0x000211F4A988, 0x0003A3083C3F, 0x0003A317844C, 0x00008422221F,
    0x0003A317462E, 0x0001910F462E, 0x00000C6018C0, 0x02218C0018C0, 0x000208208888, 0x000001F07C00,
    0x000088882082, 0x00010044422E, 0x000383DAF62E, 0x000463F8C544, 0x0003E317C62F, 0x0003A210862E,
    0x0003E318C62F, 0x0007C217843F, 0x00004217843F, 0x0007A31E862E, 0x0004631FC631, 0x00038842108E,
    0x00019284211C, 0x000452519531, 0x0007C2108421, 0x0004631AD771, 0x0004631CD671, 0x0003A318C62E,
    0x00004217C62F, 0x00059358C62E, 0x00045257C62F, 0x0003E107043E, 0x00010842109F, 0x0003A318C631,
    0x000114A8C631, 0x0004775AC631, 0x000462A22A31, 0x000108422A31, 0x0007C222221F, 0x00038421084E,
    0x000420820821, 0x00039084210E, 0x000000004544, 0x00F800000000, 0x000000000082, 0x0007A3E83800,
    0x0003E318BC21, 0x00078210F800, 0x0007A318FA10, 0x000383F8B800, 0x000084213C4C, 0x0E87A318F800,
    0x00046318BC21, 0x000388421804, 0x064210843008, 0x000494654842, 0x000388421086, 0x00056B5AAC00,
    0x00046318BC00, 0x0003A318B800, 0x010BE318BC00, 0x1087A318F800, 0x00004211B400, 0x0003E0E0F800,
    0x000304213C42, 0x0007A318C400, 0x00011518C400, 0x0002AB5AC400, 0x000454454400, 0x0E87A318C400,
    0x0007C4447C00, 0x000608411098, 0x000108421084, 0x0000C8441083, 0x0000009AC800,
};

} // namespace

void draw_label(Picture& picture, std::uint32_t x, std::uint32_t y, std::string_view text, Rgb color,
                std::uint32_t scale) {
    for (const char given : text) {
        // The bytes after the first of a UTF-8 sequence.
        if ((static_cast<unsigned char>(given) & 0xC0U) == 0x80U) continue;
        const char character = given < first_glyph || given > last_glyph ? '?' : given;
        const std::uint64_t glyph = glyphs[std::size_t(character - first_glyph)];
        for (std::uint32_t v = 0; v < label_height * scale; ++v)
            for (std::uint32_t u = 0; u < glyph_width * scale; ++u)
                if ((glyph >> (v / scale * glyph_width + u / scale) & 1U) != 0 && x + u < picture.width &&
                    y + v < picture.height)
                    picture.at(x + u, y + v) = color;
        x += label_advance * scale;
    }
}

} // namespace spa::tools
