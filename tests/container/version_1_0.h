// SPDX-License-Identifier: Apache-2.0
// A file of version 1.0 as the writer of that version wrote it: the example of formats/SPA.md, without flags
// of the part.
#pragma once

#include "file_parts.h"

#include <string_view>

namespace spa::test {

// Two hexadecimal digits a byte; "*" is sixteen zeros.
constexpr std::string_view version_1_0_hex = "AB535041204D61700D0A1A0A01000000"
                                             "A4020000000000000400000000000000"
                                             "*"
                                             "0000000000000000FA446EC0D138C8B0"
                                             "50415254010000000000000000000000"
                                             "*"
                                             "4001000000000000C000000000000000"
                                             "C000000000000000A58F0B7B3CFBF4BC"
                                             "44505448010000000000000000000000"
                                             "00000000020000000300000003000000"
                                             "00020000000000000900000000000000"
                                             "0900000000000000F23012E63DA1139D"
                                             "4E524D4C010000000000000000000000"
                                             "00000000050000000300000003000000"
                                             "40020000000000001200000000000000"
                                             "120000000000000054EA4243DE0D5D27"
                                             "434F4C52010000000000000000000000"
                                             "00000000010000000300000003000000"
                                             "80020000000000002400000000000000"
                                             "24000000000000002DECF3485007D670"
                                             "0000000000000000000000000000F03F"
                                             "00000000000000000000000000000040"
                                             "000000000000F03F0000000000000000"
                                             "*"
                                             "000000000000F03F0000000000000000"
                                             "*"
                                             "000000000000F03F0200000001000000"
                                             "FFFFFFFFFFFFFFFF0000C07F0000C07F"
                                             "0000C07F0000C07F0000C07F0000C07F"
                                             "0000C07F0000C07F0000000000000000"
                                             "*"
                                             "*"
                                             "FFFFFFFFFFFFFFFFFF00000000000000"
                                             "*"
                                             "*"
                                             "*"
                                             "7F7F007F7F7F810000007F007F7F0081"
                                             "7F7F0000000000000000000000000000"
                                             "*"
                                             "*"
                                             "00007FFF00FF00FF00007FFF7F0000FF"
                                             "0000FFFFFF0000FF00007FFF007F00FF"
                                             "00007FFF";

inline FileBytes version_1_0_file() {
    const auto digit = [](char c) { return unsigned(c <= '9' ? c - '0' : c - 'A' + 10); };
    FileBytes bytes;
    for (std::size_t i = 0; i < version_1_0_hex.size();) {
        if (version_1_0_hex[i] == '*') {
            bytes.resize(bytes.size() + 16);
            ++i;
        } else {
            bytes.push_back(std::byte(16 * digit(version_1_0_hex[i]) + digit(version_1_0_hex[i + 1])));
            i += 2;
        }
    }
    return bytes;
}

} // namespace spa::test
