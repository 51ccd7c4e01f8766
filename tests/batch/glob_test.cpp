// SPDX-License-Identifier: Apache-2.0
#include "../../tools/glob.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using tools::glob_matches;

struct Case {
    const char* pattern;
    const char* path;
    bool matches;
};

class Glob : public testing::TestWithParam<Case> {};

TEST_P(Glob, MatchesAsInGitignore) {
    EXPECT_EQ(glob_matches(GetParam().pattern, GetParam().path), GetParam().matches)
        << GetParam().pattern << " on " << GetParam().path;
}

// Of a pattern with a folder in front of it, git says the same: `git check-ignore` on these patterns.
INSTANTIATE_TEST_SUITE_P(
    Patterns, Glob,
    testing::Values(
        Case{"*.obj", "a.obj", true}, Case{"*.obj", "props/deep/a.obj", true}, Case{"*.obj", "a.objx", false},
        Case{"props", "props/a.obj", true}, Case{"props", "x/props/a.obj", true},
        Case{"props", "props2/a.obj", false}, Case{"props/", "props/a.obj", true},
        Case{"props/*.obj", "props/a.obj", true}, Case{"props/*.obj", "props/deep/a.obj", false},
        Case{"props/*.obj", "x/props/a.obj", false}, Case{"props/**", "props/deep/er/a.obj", true},
        Case{"**/a.obj", "a.obj", true}, Case{"**/a.obj", "x/y/a.obj", true},
        Case{"a/**/b.obj", "a/b.obj", true}, Case{"a/**/b.obj", "a/x/y/b.obj", true},
        Case{"a/**/b.obj", "c/a/b.obj", false}, Case{"/a.obj", "a.obj", true},
        Case{"/a.obj", "x/a.obj", false}, Case{"?.obj", "a.obj", true}, Case{"?.obj", "ab.obj", false},
        Case{"[a-c].obj", "b.obj", true}, Case{"[a-c].obj", "d.obj", false}, Case{"*", "x/a.obj", true},
        Case{"*.OBJ", "a.obj", false}, Case{"a*b*c*d*e*f", "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", false},
        Case{"", "a.obj", false}, Case{"\xff*", "\xff\xfe.obj", true},
        Case{"**/**/**/x", "a/b/c/d/e/f/g/x", true}));

TEST(GlobBelow, SaysWhetherAFolderMayHoldAMatch) {
    using tools::glob_may_match_below;
    for (const char* pattern : {"*.obj", "a", "/a", "a/", "a/b", "a/b/", "a/b/*.obj", "a/**", "**/x.obj",
                                "*/*/*.obj", "a/**/x.obj", "?/[a-c]/d/e.obj"})
        EXPECT_TRUE(glob_may_match_below(pattern, "a/b/")) << pattern;
    for (const char* pattern : {"", "/b", "c/**", "/x.obj", "a/x.obj", "a/c/*.obj", "*/c/*.obj"})
        EXPECT_FALSE(glob_may_match_below(pattern, "a/b/")) << pattern;
    for (const char* top : {"", "."}) EXPECT_TRUE(glob_may_match_below("x/y.obj", top));
}

} // namespace
} // namespace spa::test
