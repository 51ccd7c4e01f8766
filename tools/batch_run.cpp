// SPDX-License-Identifier: Apache-2.0
#include "batch_run.h"

#include "batch_child.h"
#include "batch_progress.h"
#include "interrupt.h"
#include "memory_budget.h"
#include "output.h"
#include "worker.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <map>
#include <numeric>
#include <set>

namespace spa::tools {

namespace {

constexpr auto heartbeat = std::chrono::milliseconds(100);
// Sources up to here are read to see whether they changed before a process is started: that costs more.
constexpr std::uint64_t read_at_once = std::uint64_t(1) << 20U;
// What an asset costs whatever its size, as bytes.
constexpr std::uint64_t asset_weight = std::uint64_t(64) << 10U;

struct Start {
    std::size_t asset = 0;
    ChildTask task;
    std::uint64_t memory_bytes = 0; // that it may use
};

class Batch {
public:
    Batch(BatchReport& report, const PictureSink& pictures)
        : report_(report), arguments_(report.arguments), pictures_(pictures),
          progress_(report.assets.size(), total_weight(report), arguments_.quiet || arguments_.dry_run) {}

    void run() {
        waiting_ = largest_first();
        while (!waiting_.empty() || !ready_.empty() || pool_.running() > 0) {
            obey_signal();
            const bool went_on = go_on();
            const std::optional<WorkerEnd> end =
                pool_.wait(went_on ? std::chrono::milliseconds(0) : heartbeat);
            obey_signal(); // before an end is judged: what interrupts the batch may have ended that process,
                           // too
            if (end) finish(*end);
            progress_.update();
        }
    }

private:
    static std::uint64_t total_weight(const BatchReport& report) {
        std::uint64_t weight = 0;
        for (const BatchAsset& asset : report.assets) weight += weight_of(asset);
        return weight;
    }
    static std::uint64_t weight_of(const BatchAsset& asset) { return asset.bytes + asset_weight; }

    [[nodiscard]] std::deque<std::size_t> largest_first() const {
        std::deque<std::size_t> order(report_.assets.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return report_.assets[a].bytes > report_.assets[b].bytes;
        });
        return order;
    }

    // Starts the next asset if there is room for it, or deals with it at once. False if there is nothing to
    // do before a process ends.
    bool go_on() {
        if (ready_.empty() && !waiting_.empty()) {
            const std::size_t asset = waiting_.front();
            waiting_.pop_front();
            std::optional<Start> start = prepare(asset);
            if (!start) return true; // dealt with
            ready_.push_back(std::move(*start));
        }
        if (ready_.empty() || !has_room(ready_.front())) return false;
        Start start = std::move(ready_.front());
        ready_.pop_front();
        try {
            pool_.start(start.asset, [&start] { return run_child(start.task); },
                        {start.memory_bytes, arguments_.timeout});
        } catch (const Error&) {
            if (pool_.running() == 0) throw;
            ready_.push_front(std::move(start)); // with fewer at once it will do
            return false;
        }
        memory_in_use_ += start.memory_bytes;
        running_[start.asset] = std::move(start);
        return true;
    }

    [[nodiscard]] bool has_room(const Start& start) const {
        if (pool_.running() == 0) return true;
        return pool_.running() < arguments_.jobs &&
               memory_in_use_ + start.memory_bytes <= arguments_.memory_bytes;
    }

    // What there is to do for an asset; none if it is done.
    std::optional<Start> prepare(std::size_t i) {
        const BatchAsset& asset = report_.assets[i];
        AssetResult& result = report_.results[i];
        if (!asset.problem.empty()) {
            result.status = AssetStatus::failed;
            result.exit_code = ExitCode::input_output;
            result.error = asset.path.string() + ": " + asset.problem;
            return done(i);
        }
        Start start{i, {asset, report_.settings.of(asset.name, asset.settings)}, 0};
        ChildTask& task = start.task;
        task.settings.node = asset.node;
        task.settings.options.threads = arguments_.threads;
        task.follow_links = arguments_.query.follow_links;
        task.dry_run = arguments_.dry_run;
        task.wants_picture = pictures_ != nullptr;
        task.reason = BakeReason::forced;
        if (!arguments_.force) {
            const MapState state = judge_map(asset.output, asset.path, task.settings, read_at_once);
            task.reason = state.reason;
            task.is_current = state.freshness == Freshness::current;
            if (task.is_current) {
                result.status = AssetStatus::up_to_date;
                result.facts = state.facts;
                if (!task.wants_picture) return done(i);
            }
        }
        if (arguments_.dry_run && task.reason != BakeReason::none) {
            result.status = AssetStatus::baked;
            result.reason = task.reason;
            return done(i);
        }
        const std::uint64_t share = arguments_.memory_bytes / arguments_.jobs;
        start.memory_bytes =
            std::min(arguments_.memory_bytes, std::max(share, estimated_memory(asset.bytes, task.settings)));
        return start;
    }

    std::nullopt_t done(std::size_t i) {
        progress_.done(report_.assets[i], report_.results[i], weight_of(report_.assets[i]));
        return std::nullopt;
    }

    void finish(const WorkerEnd& end) {
        Start start = std::move(running_.at(end.id));
        running_.erase(end.id);
        memory_in_use_ -= start.memory_bytes;
        if (!end.completed) remove_leftovers_of(start.task.asset.output);
        ChildOutcome outcome = parse_outcome(end.result);
        const bool was_stopped = !end.completed || outcome.interrupt != 0;
        if (was_stopped && report_.stopped_by == BatchStop::signal) return; // not_started
        if (was_stopped) {
            outcome.result.signal = end.signal != 0 ? end.signal : outcome.interrupt;
            describe_end(end, start.task.asset, outcome.result);
        }
        if (may_want_memory(end, outcome) && start.memory_bytes < arguments_.memory_bytes) {
            if (report_.stopped_by != BatchStop::none) return; // not_started
            start.memory_bytes = arguments_.memory_bytes;      // with all of it, and so alone
            ready_.push_front(std::move(start));
            return;
        }
        if (!outcome.picture.empty()) pictures_(end.id, outcome.picture);
        if (!start.task.is_current) {
            outcome.result.diagnostics = end.diagnostics;
            outcome.result.seconds = end.seconds;
            outcome.result.peak_memory_bytes = end.peak_memory_bytes;
            report_.results[end.id] = std::move(outcome.result);
        }
        if (outcome.output_failed && !arguments_.keep_going) stop(BatchStop::output);
        done(end.id);
    }

    // Memory that is not to be had shows as an error, or as a crash where a library does not expect it.
    static bool may_want_memory(const WorkerEnd& end, const ChildOutcome& outcome) {
        return outcome.out_of_memory || (end.signal != 0 && !end.timed_out && !asks_to_end(end.signal));
    }

    static bool asks_to_end(int signal) { return signal == SIGTERM || signal == SIGINT || signal == SIGHUP; }

    // What is to be said of a process that was stopped; result.signal is known.
    void describe_end(const WorkerEnd& end, const BatchAsset& asset, AssetResult& result) const {
        result.status = AssetStatus::failed;
        result.error = asset.path.string() + ": ";
        const std::string signal = signal_name(result.signal);
        if (end.timed_out) {
            result.exit_code = ExitCode::limits;
            result.error +=
                "took longer than " + std::to_string(arguments_.timeout->count()) + " s (--timeout)";
        } else if (result.signal == SIGKILL) {
            result.exit_code = ExitCode::unsupported;
            result.error +=
                "was killed (SIGKILL), as the system does when it is out of memory; lower --memory or --jobs";
        } else {
            result.exit_code = ExitCode::internal;
            result.error += result.signal == 0           ? "its process ended without a result"
                            : asks_to_end(result.signal) ? "was ended by somebody else (" + signal + ")"
                                                         : "crashed (" + signal + ")";
        }
    }

    static void remove_leftovers_of(const std::filesystem::path& output) {
        const std::string staged = staged_name(output.filename().string());
        remove_leftovers(output.parent_path(), [&](const std::string& name) { return name == staged; });
    }

    void obey_signal() {
        if (interrupt_signal() == 0 || report_.stopped_by == BatchStop::signal) return;
        stop(BatchStop::signal);
        pool_.stop_all();
    }

    void stop(BatchStop reason) {
        report_.stopped_by = reason;
        waiting_.clear();
        ready_.clear();
    }

    BatchReport& report_;
    const BatchArguments& arguments_;
    const PictureSink& pictures_;
    BatchProgress progress_;
    WorkerPool pool_;
    std::deque<std::size_t> waiting_; // assets not looked at
    std::deque<Start> ready_;         // wait for room
    std::map<std::size_t, Start> running_;
    std::uint64_t memory_in_use_ = 0;
};

void remove_all_leftovers(const std::vector<BatchAsset>& assets) {
    std::map<std::filesystem::path, std::set<std::string>> names; // by folder
    for (const BatchAsset& asset : assets)
        names[asset.output.parent_path()].insert(staged_name(asset.output.filename().string()));
    for (const auto& [folder, ours] : names)
        remove_leftovers(folder, [&ours = ours](const std::string& name) { return ours.contains(name); });
}

// What oneTBB does once in a process (it looks for its allocator and for other run times in every library
// folder) costs more than the bake of a small asset. Done here, and without starting a thread, every fork has
// it.
void prepare_threading() {
    tbb::task_arena(1).execute([] { tbb::parallel_for(0, 2, [](int) {}); });
}

} // namespace

void run_batch(BatchReport& report, const PictureSink& pictures) {
    const auto start = std::chrono::steady_clock::now();
    report.results.resize(report.assets.size());
    if (!report.arguments.dry_run) {
        make_folders_of(report.arguments.query.output / "map.spa");
        check_output_folder(report.arguments.query.output);
        remove_all_leftovers(report.assets);
    }
    prepare_threading();
    Batch(report, pictures).run();
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace spa::tools
