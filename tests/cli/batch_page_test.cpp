// SPDX-License-Identifier: Apache-2.0
// The text of the page of a batch; what a browser makes of it: tests/page.
#include "../../tools/batch_page.h"

#include "../support/batch_reports.h"
#include "schema.h"

#include <gtest/gtest.h>

#include <sstream>

namespace spa::test {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::byte> bytes_of(std::string_view text) {
    std::vector<std::byte> bytes;
    for (const char c : text) bytes.push_back(std::byte(c));
    return bytes;
}

std::string page_of(const Json& report, const tools::ThumbnailSource& thumbnail) {
    std::ostringstream out;
    tools::write_batch_page(out, report, thumbnail);
    return out.str();
}

std::string page_of(const Json& report) {
    return page_of(report, [](std::size_t) { return std::vector<std::byte>{}; });
}

// What stands in <script ... id="ID">, as a browser reads it: to the next "</script".
std::string script_text(const std::string& page, const std::string& id) {
    const std::size_t at = page.find("id=\"" + id + "\">");
    if (at == std::string::npos) return "absent";
    const std::size_t begin = page.find('>', at) + 1;
    return page.substr(begin, page.find("</script", begin) - begin);
}

// As it is after a way through UTF-8.
Json in_utf8(const Json& value) {
    return Json::parse(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

TEST(BatchPage, ReportsOfTheTestsKeepTheSchema) {
    const nlohmann::json schema = load_schema("batch");
    EXPECT_EQ(schema_error(schema, nlohmann::json(in_utf8(hostile_batch_report()))), "");
    EXPECT_EQ(schema_error(schema, nlohmann::json(in_utf8(large_batch_report(101)))), "");
}

TEST(BatchPage, HoldsTheReport) {
    for (const Json& report : {hostile_batch_report(), large_batch_report(3), large_batch_report(0)})
        EXPECT_EQ(Json::parse(script_text(page_of(report), "report")), in_utf8(report));
}

TEST(BatchPage, TextOfTheReportCannotEndItsScript) {
    const std::string page = page_of(hostile_batch_report());
    const std::string data = script_text(page, "report");
    EXPECT_EQ(data.find('<'), std::string::npos);
    EXPECT_NE(data.find("\\u003c/script>\\u003cb class="), std::string::npos);
    // The same elements as on a page of nothing.
    const auto scripts = [](const std::string& text) {
        std::size_t count = 0;
        for (std::size_t at = text.find("<script"); at != std::string::npos;
             at = text.find("<script", at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(scripts(page), scripts(page_of(large_batch_report(0))));
}

TEST(BatchPage, BytesThatAreNotUtf8AreReplaced) {
    const std::string page = page_of(hostile_batch_report());
    EXPECT_EQ(page.find('\xFF'), std::string::npos);
    EXPECT_NE(page.find("\xEF\xBF\xBD\xEF\xBF\xBD latin.obj"), std::string::npos);
}

TEST(BatchPage, AsksForEachThumbnailOnce) {
    std::vector<std::size_t> asked;
    const std::string page = page_of(large_batch_report(5), [&](std::size_t asset) {
        asked.push_back(asset);
        const char* const texts[] = {"", "f", "fo", "foo", "foob\xFF\xFE"};
        return bytes_of(texts[asset]);
    });
    EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    // RFC 4648, "Test vectors"; the last by another program.
    EXPECT_EQ(script_text(page, "thumbnail-0"), "absent");
    EXPECT_EQ(script_text(page, "thumbnail-1"), "Zg==");
    EXPECT_EQ(script_text(page, "thumbnail-2"), "Zm8=");
    EXPECT_EQ(script_text(page, "thumbnail-3"), "Zm9v");
    EXPECT_EQ(script_text(page, "thumbnail-4"), "Zm9vYv/+");
}

TEST(BatchPage, MayLoadNothing) {
    const std::string page = page_of(large_batch_report(1));
    EXPECT_NE(page.find("content=\"default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; "
                        "style-src 'sha256-"),
              std::string::npos);
    EXPECT_LT(page.find("Content-Security-Policy"), page.find("<style>"));
    for (const char* address : {"http:", "https:", "url(", "@import", "src=\"", "href="})
        EXPECT_EQ(page.find(address), std::string::npos) << address;
}

} // namespace
} // namespace spa::test
