#include "app/keep_options.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/options.h"
#include "app/shell_words.h"

namespace gnomon {
namespace {

std::string cellsText(std::size_t count) {
    return fmt::format("{} cell{}", count, count == 1 ? "" : "s");
}

/// What the user should know of a run that is gone on with.
void sayBefore(const RunStore& run) {
    const RunStore::Counts& counts = run.counts();
    const std::string folder = run.store().folder().string();
    if (counts.damaged)
        fmt::print(stderr, "{}: {} damaged; drawn again\n", folder, cellsText(counts.damaged));
    if (counts.changed)
        fmt::print(stderr, "{}: {} of which the program, the scene or the chip has changed; drawn again\n",
                   folder, cellsText(counts.changed));
    if (counts.bare)
        fmt::print(stderr, "{}: {} without pictures; drawn again\n", folder, cellsText(counts.bare));
    if (counts.retried)
        fmt::print(stderr, "{}: {} had failed; drawn again\n", folder, cellsText(counts.retried));
    const auto sessions = run.store().sessions();
    const StoredSession& now = sessions.back();
    for (const StoredSession& before : sessions)
        if (before.processor != now.processor) {
            fmt::print(stderr, "{}: times of another processor are among them: {}\n", folder,
                       before.processor);
            break;
        }
}

}  // namespace

void KeepOptions::addTo(CLI::App& app) {
    app.add_option("--out", folder,
                   "keep verdicts and pictures there, as each comes in; the same command goes on with a run "
                   "that was broken off")
        ->type_name("DIR");
    app.add_option("--pictures", pictures, "keep image and mask of each cell, too (default: yes)")
        ->check(CLI::IsMember({"yes", "no"}));
    app.add_flag("--retry", retries, "draw failed cells again; --timeout and --memory may be others then");
    app.add_option("--reuse", reused, "take cells from another run of which nothing has changed")
        ->type_name("DIR");
    addShardTo(app);
}

void KeepOptions::addShardTo(CLI::App& app) {
    app.add_option("--shard", shard, "draw one part of N, such as 2/4: parts are disjoint, and all cells")
        ->type_name("I/N");
    app.add_option("--past", past,
                   "an earlier run, by whose times shards are balanced; the same for all shards")
        ->type_name("DIR");
}

void KeepOptions::applyTo(MatrixRequest& request) const {
    if (folder.empty() && (retries || !reused.empty()))
        throw UsageError(fmt::format("{}: needs --out DIR", retries ? "--retry" : "--reuse"));
    if (!shard.empty()) {
        request.shard = shardFrom(shard);
        if (request.shard.count == 0)
            throw UsageError(fmt::format("--shard: '{}' is not I/N, such as 2/4, with I from 1 to N", shard));
    }
    if (!past.empty()) {
        if (shard.empty()) throw UsageError("--past: is for shards (--shard I/N)");
        request.past = CellStore::toRead(past).costs();
    }
    if (!folder.empty() && pictures == "yes")
        request.pictureFolder = std::filesystem::path(folder) / CellStore::kPictures;
}

std::unique_ptr<RunStore> KeepOptions::open(const MatrixRequest& request) const {
    if (folder.empty()) return nullptr;
    const RunStoreOptions options{.command = ownCommandLine(), .retries = retries, .reused = reused};
    auto run = std::make_unique<RunStore>(folder, request, runMaker(GNOMON_VERSION, request.device), options);
    sayBefore(*run);
    return run;
}

std::string keptText(const RunStore& run) {
    const RunStore::Counts& counts = run.counts();
    const std::size_t before = counts.known + counts.reused;
    return fmt::format("{}: {}{}; digest {}", run.store().folder().string(), cellsText(run.store().count()),
                       before ? fmt::format(", {} of them from before", before) : "", run.store().digest());
}

}  // namespace gnomon
