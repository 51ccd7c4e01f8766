// SPDX-License-Identifier: Apache-2.0
#include "attack.h"

#include "../../libspa/trace/trace.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdio>
#include <thread>

namespace spa::test {
namespace {

constexpr std::size_t most_failures = 3;
constexpr std::uint64_t block = 4096; // rays

bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool same(const trace::Hit& a, const trace::Hit& b) {
    return same_bits(a.t, b.t) && same_bits(a.normal.x, b.normal.x) && same_bits(a.normal.y, b.normal.y) &&
           same_bits(a.normal.z, b.normal.z) && same_bits(a.map.x, b.map.x) && same_bits(a.map.y, b.map.y) &&
           a.layer == b.layer && a.side == b.side && a.front == b.front && a.instance == b.instance;
}

struct Target {
    const NamedPart* part;
    trace::TraceMap map;
    Judge judge;
};

Tally attack_block(const Target& target, RayClass kind, std::uint64_t count, std::uint64_t judge_every,
                   std::uint64_t seed) {
    RayMaker maker(target.part->owned.part, seed);
    const std::uint32_t flags = maker.flags();
    std::vector<trace::Ray> rays(count);
    for (trace::Ray& ray : rays) ray = maker.make(kind);
    std::vector<trace::Hit> stream(count);
    std::vector<std::uint8_t> blocked(count);
    trace::closest_hits(target.map, rays, flags, stream);
    trace::occluded(target.map, rays, flags, blocked);
    Tally tally;
    for (std::size_t i = 0; i < count; ++i) {
        trace::Hit single;
        trace::closest_hit(target.map, rays[i], flags, single);
        const bool differs = !same(single, stream[i]);
        const bool occlusion = (blocked[i] != 0) != single.valid() ||
                               trace::occluded(target.map, rays[i], flags) != single.valid();
        ++tally.rays;
        tally.hits += single.valid() ? 1U : 0U;
        tally.stream_differs += differs ? 1U : 0U;
        tally.occlusion_differs += occlusion ? 1U : 0U;
        Judgement judgement;
        if (i % judge_every == 0) {
            judgement = judge_hit(target.judge, rays[i], flags, single, time_bound(rays[i]));
            ++tally.judged;
            ++tally.verdicts[std::size_t(judgement.verdict)];
            if (judgement.verdict == Verdict::agrees)
                tally.largest_dt = std::max(tally.largest_dt, judgement.dt);
        }
        const bool wrong = !is_right(judgement.verdict);
        if ((wrong || differs || occlusion) && tally.failures.size() < most_failures)
            tally.failures.push_back(std::string(differs     ? "stream differs"
                                                 : occlusion ? "occlusion differs"
                                                             : name(judgement.verdict)) +
                                     ", " + target.part->name + ", " + name(kind) + ": " +
                                     describe(target.judge, rays[i], flags, single));
    }
    return tally;
}

} // namespace

void Tally::add(const Tally& other) {
    rays += other.rays;
    hits += other.hits;
    judged += other.judged;
    for (std::size_t i = 0; i < verdict_count; ++i) verdicts[i] += other.verdicts[i];
    stream_differs += other.stream_differs;
    occlusion_differs += other.occlusion_differs;
    largest_dt = std::max(largest_dt, other.largest_dt);
    for (const std::string& failure : other.failures)
        if (failures.size() < most_failures) failures.push_back(failure);
}

bool Tally::passed() const {
    std::uint64_t right = 0;
    for (std::size_t i = 0; i < verdict_count; ++i) right += is_right(Verdict(i)) ? verdicts[i] : 0;
    return right == judged && stream_differs == 0 && occlusion_differs == 0;
}

Tally AttackResult::total() const {
    Tally total;
    for (const auto& part : tallies)
        for (const Tally& tally : part) total.add(tally);
    return total;
}

AttackResult attack(const std::vector<NamedPart>& parts, const AttackOptions& options) {
    std::vector<Target> targets;
    AttackResult result;
    for (const NamedPart& part : parts) {
        targets.push_back({&part, trace::TraceMap(part.owned.part), Judge(part.owned.part)});
        result.parts.push_back(part.name);
    }
    result.tallies.resize(parts.size());
    const std::uint64_t blocks = (options.rays_per_class + block * parts.size() - 1) / (block * parts.size());
    const std::uint64_t rays_of_block = options.rays_per_class / (blocks * parts.size()) + 1;
    // One piece of work: a block of one class against one part.
    const std::uint64_t works = parts.size() * ray_class_count * blocks;
    std::vector<std::vector<std::array<Tally, ray_class_count>>> of_thread(options.threads, result.tallies);
    std::atomic<std::uint64_t> next = 0;
    const auto work = [&](unsigned thread) {
        for (std::uint64_t i = next++; i < works; i = next++) {
            const std::size_t part = i % parts.size();
            const auto kind = RayClass(i / parts.size() % ray_class_count);
            of_thread[thread][part][std::size_t(kind)].add(attack_block(
                targets[part], kind, rays_of_block, options.judge_every, options.seed * 1000003 + i));
        }
    };
    std::vector<std::thread> running;
    for (unsigned i = 1; i < options.threads; ++i) running.emplace_back(work, i);
    work(0);
    for (std::thread& thread : running) thread.join();
    for (const auto& tallies : of_thread)
        for (std::size_t part = 0; part < parts.size(); ++part)
            for (std::size_t kind = 0; kind < ray_class_count; ++kind)
                result.tallies[part][kind].add(tallies[part][kind]);
    return result;
}

namespace {

void print_line(const char* what, const Tally& tally) {
    std::printf("%-26s %11llu %11llu %6.2f", what, static_cast<unsigned long long>(tally.rays),
                static_cast<unsigned long long>(tally.judged),
                100.0 * double(tally.hits) / double(std::max<std::uint64_t>(tally.rays, 1)));
    for (const Verdict verdict :
         {Verdict::beside, Verdict::excused, Verdict::bent, Verdict::core, Verdict::missed, Verdict::invented,
          Verdict::wrong_time, Verdict::wrong_record, Verdict::invalid})
        std::printf(" %9llu", static_cast<unsigned long long>(tally.of(verdict)));
    std::printf(" %8llu %9llu %9.2e\n", static_cast<unsigned long long>(tally.stream_differs),
                static_cast<unsigned long long>(tally.occlusion_differs), tally.largest_dt);
}

} // namespace

void print(const AttackResult& result) {
    std::printf("%-26s %11s %11s %6s %9s %9s %9s %9s %9s %9s %9s %9s %9s %8s %9s %9s\n", "", "rays", "judged",
                "hit %", "beside", "excused", "bent", "core", "missed", "invented", "wrong t", "wr.record",
                "invalid", "stream", "occlusion", "max dt/R");
    for (std::size_t part = 0; part < result.parts.size(); ++part) {
        Tally sum;
        for (const Tally& tally : result.tallies[part]) sum.add(tally);
        print_line(result.parts[part].c_str(), sum);
    }
    for (unsigned kind = 0; kind < ray_class_count; ++kind) {
        Tally sum;
        for (const auto& tallies : result.tallies) sum.add(tallies[kind]);
        print_line(name(RayClass(kind)), sum);
    }
    const Tally total = result.total();
    print_line("all", total);
    constexpr std::size_t most_printed = 12;
    std::size_t printed = 0;
    for (unsigned kind = 0; kind < ray_class_count; ++kind)
        for (const auto& tallies : result.tallies)
            for (const std::string& failure : tallies[kind].failures)
                if (printed++ < most_printed) std::printf("%s\n", failure.c_str());
}

} // namespace spa::test
