// SPDX-License-Identifier: Apache-2.0
// formats/SPA.md and the code say the same.
#include "file_parts.h"
#include "test_maps.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using namespace spa::container;

std::string specification() {
    std::ifstream stream(SPA_SPECIFICATION);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

TEST(Specification, TableIsThatOfTheSpecification) {
    std::istringstream text(specification());
    std::vector<std::string> rows;
    for (std::string line; std::getline(text, line);)
        if (line.rfind("| SPA-", 0) == 0) rows.push_back(line);
    ASSERT_EQ(rows.size(), issue_table.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const IssueEntry& entry = issue_table[i];
        EXPECT_EQ(rows[i], "| " + number(entry.issue) + " | " + std::string(entry.name) + " | " +
                               std::string(entry.text) + " |");
    }
}

TEST(Specification, SpecificationMentionsEveryRuleOfAFile) {
    const std::string text = specification();
    const std::string rules = text.substr(0, text.find("## 14."));
    for (const IssueEntry& entry : issue_table) {
        if (entry.issue >= Issue::out_of_memory) continue;
        bool found = rules.find(number(entry.issue)) != std::string::npos;
        // "SPA-302 to SPA-308"
        if (entry.issue > Issue::part_number_not_valid && entry.issue < Issue::unknown_part_flags)
            found = true;
        EXPECT_TRUE(found) << number(entry.issue);
    }
}

// The dump of section 15: "offset  16 bytes in hexadecimal".
TEST(Specification, ExampleOfTheSpecificationIsWhatTheWriterWrites) {
    const FileBytes file = write(make_example().map);
    std::ostringstream dump;
    dump << std::hex << std::uppercase;
    for (std::size_t i = 0; i < file.size(); ++i) {
        if (i % 16 == 0)
            dump << (i == 0 ? "" : "\n") << "0x" << (i < 256 ? "0" : "") << (i < 16 ? "0" : "") << i << " ";
        const unsigned value = std::to_integer<unsigned>(file[i]);
        dump << " " << (value < 16 ? "0" : "") << value;
    }
    EXPECT_NE(specification().find("```\n" + dump.str() + "\n```"), std::string::npos) << dump.str();
}

} // namespace
} // namespace spa::test
