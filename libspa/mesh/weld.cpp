// SPDX-License-Identifier: Apache-2.0
#include "weld.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <tuple>

namespace spa {
namespace {

struct Key {
    std::uint64_t xy;
    std::uint32_t z;
    friend bool operator==(const Key&, const Key&) = default;
};

Key key_of(Vec3f p) {
    // Adding 0 turns -0 into 0.
    const std::uint64_t x = std::bit_cast<std::uint32_t>(p.x + 0.0F);
    const std::uint64_t y = std::bit_cast<std::uint32_t>(p.y + 0.0F);
    return {x << 32U | y, std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

// Multiply and fold (as in wyhash): every input bit reaches the upper half.
std::uint32_t hash_of(const Key& key) {
    std::uint64_t h = key.xy * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 32U) ^ key.z) * 0xD6E8FEB86659FD93ULL;
    return std::uint32_t(h >> 32U);
}

struct Entry {
    std::uint32_t hash;
    std::uint32_t index;
};

// Equal positions have equal hashes, so each bucket of hashes stands alone, and its table fits in a cache.
constexpr unsigned bucket_bits = 9;
constexpr std::size_t buckets = std::size_t(1) << bucket_bits;
constexpr std::size_t bucket_of(std::uint32_t hash) { return hash >> (32 - bucket_bits); }

class Welder {
public:
    explicit Welder(std::span<const Vec3f> positions)
        : positions_(positions), entries_(positions.size()), first_(positions.size()) {}

    std::vector<std::uint32_t> run() {
        distribute();
        tbb::parallel_for(std::size_t(0), buckets, [&](std::size_t b) {
            const std::span<Entry> bucket = std::span(entries_).subspan(begin_[b], begin_[b + 1] - begin_[b]);
            if (!weld_by_table(bucket)) weld_by_sorting(bucket);
        });
        return std::move(first_);
    }

private:
    // Sorts the entries by bucket; within a bucket they stay in order of index.
    void distribute() {
        constexpr std::size_t most_chunks = 64;
        const std::size_t chunk = std::max<std::size_t>(4096, positions_.size() / most_chunks + 1);
        const std::size_t chunks = (positions_.size() + chunk - 1) / chunk;
        std::vector<std::uint32_t> hashes(positions_.size());
        std::vector<std::array<std::uint32_t, buckets>> next(chunks);
        const auto each_chunk = [&](auto&& visit) {
            tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t c) {
                for (std::size_t i = c * chunk; i < std::min(positions_.size(), (c + 1) * chunk); ++i)
                    visit(next[c], i);
            });
        };
        each_chunk([&](auto& count, std::size_t i) {
            hashes[i] = hash_of(key_of(positions_[i]));
            ++count[bucket_of(hashes[i])];
        });
        std::uint32_t sum = 0;
        for (std::size_t b = 0; b < buckets; ++b) {
            begin_[b] = sum;
            for (auto& count : next) {
                const std::uint32_t n = count[b];
                count[b] = sum;
                sum += n;
            }
        }
        begin_[buckets] = sum;
        each_chunk([&](auto& place, std::size_t i) {
            entries_[place[bucket_of(hashes[i])]++] = {hashes[i], std::uint32_t(i)};
        });
    }

    // Open addressing. False, with nothing done that sorting would not do again, if the bucket's hashes
    // collide so often that somebody must have made them.
    bool weld_by_table(std::span<const Entry> bucket) {
        constexpr std::size_t most_probes = 16; // a position, on average
        const std::size_t size = std::bit_ceil(2 * bucket.size() + 1);
        std::vector<Entry> table(size, Entry{0, empty});
        std::size_t probes = 0;
        for (const Entry& entry : bucket) {
            const Key key = key_of(positions_[entry.index]);
            std::size_t slot = entry.hash & (size - 1);
            while (table[slot].index != empty &&
                   (table[slot].hash != entry.hash || key_of(positions_[table[slot].index]) != key)) {
                slot = (slot + 1) & (size - 1);
                if (++probes > most_probes * bucket.size()) return false;
            }
            if (table[slot].index == empty) table[slot] = entry;
            first_[entry.index] = table[slot].index;
        }
        return true;
    }

    void weld_by_sorting(std::span<Entry> bucket) {
        const auto order = [&](const Entry& entry) {
            const Key key = key_of(positions_[entry.index]);
            return std::tuple(key.xy, key.z, entry.index);
        };
        std::sort(bucket.begin(), bucket.end(),
                  [&](const Entry& a, const Entry& b) { return order(a) < order(b); });
        for (std::size_t i = 0; i < bucket.size(); ++i) {
            const std::uint32_t index = bucket[i].index;
            const bool same = i > 0 && key_of(positions_[index]) == key_of(positions_[bucket[i - 1].index]);
            first_[index] = same ? first_[bucket[i - 1].index] : index;
        }
    }

    static constexpr std::uint32_t empty = 0xFFFFFFFFU; // not an index: there are fewer positions

    std::span<const Vec3f> positions_;
    std::vector<Entry> entries_;
    std::array<std::size_t, buckets + 1> begin_{};
    std::vector<std::uint32_t> first_;
};

} // namespace

std::vector<std::uint32_t> weld_positions(std::span<const Vec3f> positions) {
    return Welder(positions).run();
}

} // namespace spa
