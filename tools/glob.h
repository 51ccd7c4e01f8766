// SPDX-License-Identifier: Apache-2.0
// File name patterns, with the meaning they have in .gitignore.
#pragma once

#include <string>
#include <string_view>

namespace spa::tools {

// Whether `pattern` matches the relative path, or one of the folders on the way to it. Of the shell: * ? and
// [a-z] do not match '/'; "**" as a whole part stands for any number of folders. A pattern without '/'
// matches at any depth, another one from the top ("/x.obj" is the one at the top). Case and bytes count as
// they are. O(parts of the pattern * parts of the path) calls of fnmatch(3).
bool glob_matches(const std::string& pattern, std::string_view path);

// Whether there can be a path below this folder that the pattern matches. "" and "." are the top.
bool glob_may_match_below(const std::string& pattern, std::string_view folder);

} // namespace spa::tools
