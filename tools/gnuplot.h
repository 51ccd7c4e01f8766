// SPDX-License-Identifier: Apache-2.0
// Drawing by gnuplot, which is looked for when it is needed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spa::tools {

// For a script, in gnuplot's single quotes.
std::string gnuplot_text(const std::string& text);

// Throws Error{unsupported} if gnuplot is not found, or does not run.
void require_gnuplot();

// What gnuplot writes to standard output for this script: a picture, if the script sets a terminal and no
// output. Throws Error: unsupported as above; internal if gnuplot does not accept the script (its message is
// on standard error); input_output if no temporary file can be made.
std::vector<std::byte> run_gnuplot(const std::string& script);

} // namespace spa::tools
