// SPDX-License-Identifier: Apache-2.0
#include "../../formats/import/text.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace spa::import {
namespace {

TEST(Text, LinesEndWithAnyConvention) {
    LineReader lines{"a\nb\r\nc\rd\n\ne"};
    std::vector<std::string> read;
    while (const auto line = lines.read()) read.emplace_back(*line);
    EXPECT_EQ(read, (std::vector<std::string>{"a", "b", "c", "d", "", "e"}));
    EXPECT_EQ(lines.line, 6U);
}

TEST(Text, TokensCrossLinesAndCountThem) {
    TokenReader tokens{{"one \t two\n\n three"}, {}};
    EXPECT_EQ(tokens.read(), "one");
    EXPECT_EQ(tokens.read(), "two");
    EXPECT_EQ(tokens.lines.line, 1U);
    EXPECT_EQ(tokens.read(), "three");
    EXPECT_EQ(tokens.lines.line, 3U);
    EXPECT_TRUE(tokens.read().empty());
}

TEST(Text, NumbersInEveryForm) {
    struct Row {
        const char* text;
        float value;
    };
    const float infinity = std::numeric_limits<float>::infinity();
    const Row rows[] = {{"1", 1},
                        {"+1.5", 1.5F},
                        {"-2.", -2},
                        {".25", 0.25F},
                        {"1e2", 100},
                        {"1E+2", 100},
                        {"2.e-1", 0.2F},
                        {"1e999", infinity},
                        {"-1e99", -infinity},
                        {"1e-999", 0},
                        {"0.1", 0.1F},
                        {"inf", infinity},
                        {"-inf", -infinity},
                        {"+inf", infinity},
                        {"1.#INF", infinity},
                        {"-1.#INF", -infinity}};
    for (const Row& row : rows) {
        const auto value = parse_float(row.text);
        ASSERT_TRUE(value) << row.text;
        EXPECT_EQ(*value, row.value) << row.text;
    }
    for (const char* text : {"nan", "-nan", "NaN", "1.#IND", "-1.#QNAN0"}) {
        const auto value = parse_float(text);
        ASSERT_TRUE(value) << text;
        EXPECT_TRUE(std::isnan(*value)) << text;
    }
    for (const char* text : {"", "x", "1x", "3.1+e2", "--1", "+-1", "+", "-", ".", "1,5", "0x10"})
        EXPECT_FALSE(parse_float(text)) << text;
}

TEST(Text, WholeNumbers) {
    EXPECT_EQ(parse_integer("-12"), -12);
    EXPECT_EQ(parse_integer("+12"), 12);
    for (const char* text : {"", "1.0", "1x", "99999999999999999999", "+-1", "x"})
        EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Text, QuotesWithoutControlCharactersAndCut) {
    EXPECT_EQ(quote("a\x1b[0m\n"), "'a?[0m?'");
    EXPECT_EQ(quote(std::string(1000, 'x')).size(), 65U);
}

} // namespace
} // namespace spa::import
