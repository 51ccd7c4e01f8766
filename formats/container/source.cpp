// SPDX-License-Identifier: Apache-2.0
#include "source.h"

#include <algorithm>

namespace spa::container {

bool Source::take(std::uint64_t count, Bytes& out) {
    out = {};
    if (read_ != nullptr) {
        const bool complete = take_from_stream(count, out.held);
        out.view = out.held;
        return complete;
    }
    const std::uint64_t left = file_.size() - position_;
    const std::uint64_t taken = std::min(count, left);
    out.view = file_.subspan(std::size_t(position_), std::size_t(taken));
    position_ += taken;
    return taken == count;
}

bool Source::take_from_stream(std::uint64_t count, std::vector<std::byte>& out) {
    constexpr std::uint64_t first_piece = std::uint64_t(1) << 20U;
    while (out.size() < count) {
        const std::size_t have = out.size();
        const std::uint64_t piece = std::min(count - have, std::max<std::uint64_t>(first_piece, have));
        out.resize(have + std::size_t(piece));
        if (!(*read_)(std::span(out).subspan(have))) {
            out.resize(have);
            return false;
        }
        position_ += piece;
    }
    return true;
}

} // namespace spa::container
