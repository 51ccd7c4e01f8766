// SPDX-License-Identifier: Apache-2.0
#include "../../formats/container/text.h"

#include <random>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace spa::test {
namespace {

using namespace spa::container;

TEST(Utf8, BoundariesOfEveryLength) {
    for (const char* good : {"", "abc", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF",
                             "\xEE\x80\x80", "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(find_utf8_error(good), text_ok) << good;
    for (const char* bad : {"\x80", "\xBF", "\xC0\x80", "\xC1\xBF", "\xC2", "\xC2\xC0", "\xE0\x9F\xBF",
                            "\xED\xA0\x80", "\xE1\x80", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80",
                            "\xF5\x80\x80\x80", "\xFF", "\xF1\x80\x80", "\xE1\x80\x41"})
        EXPECT_EQ(find_utf8_error("ab" + std::string(bad)), 2U);
}

const std::vector<std::string>& json_texts() {
    static const std::vector<std::string> texts{
        "{}",
        " \t\r\n{ } \n",
        R"({"a":1,"b":[true,false,null,-0.5e+10,"x\u00e9\n\"\\/"],"c":{"d":{}},"e":[[],[[1,2]],{}]})",
        R"({"a":0,"b":10,"c":-1,"d":1.5,"e":1e5,"f":0.0E-1})",
    };
    return texts;
}

TEST(Json, AcceptsObjects) {
    for (const std::string& text : json_texts()) EXPECT_EQ(find_json_error(text), text_ok) << text;
}

TEST(Json, RefusesAllElse) {
    for (const char* bad : {"",
                            " ",
                            "[]",
                            "1",
                            "{",
                            "}",
                            "{}{}",
                            "{} x",
                            "{\"a\"}",
                            "{\"a\":}",
                            "{\"a\":1,}",
                            "{,}",
                            "{a:1}",
                            "{\"a\":01}",
                            "{\"a\":.5}",
                            "{\"a\":1.}",
                            "{\"a\":+1}",
                            "{\"a\":1e}",
                            "{\"a\":tru}",
                            "{\"a\":[1,]}",
                            "{\"a\":[1}",
                            "{\"a\":\"\n\"}",
                            "{\"a\":\"\\x\"}",
                            "{\"a\":\"\\u12g4\"}",
                            "{\"a\":\"",
                            "{\"a\":-}",
                            "\xEF\xBB\xBF{}",
                            "{\"a\":1 \"b\":2}"})
        EXPECT_NE(find_json_error(bad), text_ok) << bad;
    EXPECT_NE(find_json_error(std::string_view("{\0}", 3)), text_ok);
    EXPECT_NE(find_json_error(std::string_view("{}\0", 3)), text_ok);
    EXPECT_NE(find_json_error(std::string_view("{\"a\":\"\\\0\"}", 9)), text_ok);
}

TEST(Json, DepthIsLimited) {
    const auto nested = [](std::size_t depth) {
        return "{\"a\":" + std::string(depth - 1, '[') + std::string(depth - 1, ']') + "}";
    };
    EXPECT_EQ(find_json_error(nested(json_depth_limit)), text_ok);
    EXPECT_NE(find_json_error(nested(json_depth_limit + 1)), text_ok);
    EXPECT_NE(find_json_error("{\"a\":" + std::string(1000000, '[')), text_ok);
}

// A parser by somebody else, on many texts that are nearly right.
TEST(Json, AgreesWithAnotherParser) {
    std::mt19937 random(7);
    const std::string alphabet = "{}[]:,\"\\ ue10.-+tnf\n\x01/";
    int accepted = 0;
    for (int round = 0; round < 200000; ++round) {
        std::string text = json_texts()[random() % json_texts().size()];
        for (unsigned edits = 1 + random() % 2; edits > 0; --edits) {
            const std::size_t at = random() % text.size();
            const char c = alphabet[random() % alphabet.size()];
            switch (random() % 3) {
            case 0: text[at] = c; break;
            case 1: text.insert(at, 1, c); break;
            default: text.erase(at, 1);
            }
            if (text.empty()) text.assign(1, '{');
        }
        const std::size_t first = text.find_first_not_of(" \t\r\n");
        const bool object = first != std::string::npos && text[first] == '{';
        // Lone surrogates are a matter of taste: RFC 8259, section 8.2.
        if (text.find("\\ud") != std::string::npos) continue;
        const bool expected = object && nlohmann::json::accept(text);
        ASSERT_EQ(find_json_error(text) == text_ok, expected) << text;
        accepted += expected ? 1 : 0;
    }
    EXPECT_GT(accepted, 1000);
}

} // namespace
} // namespace spa::test
