#include "matrix/merge.h"

#include <fmt/format.h>

#include <map>

#include "matrix/cell_pictures.h"

namespace gnomon {
namespace {

/// The settings of a whole run of which @p shard is a part.
RunSettings wholeOf(RunSettings shard, std::size_t cells) {
    shard = withSetting(std::move(shard), "shard", toText(Shard{}));
    shard = withSetting(std::move(shard), "past", "");
    return withSetting(std::move(shard), "cells", fmt::format("{}", cells));
}

/// The stores of all shards in their order.
/// @throws StoreError
std::vector<CellStore> shardsIn(const std::vector<std::filesystem::path>& folders) {
    std::map<Shard, CellStore> found;
    RunSettings first;
    for (const std::filesystem::path& folder : folders) {
        CellStore store = CellStore::toRead(folder);
        const auto fail = [&](const std::string& what) {
            throw StoreError(fmt::format("{}: {}", folder.string(), what));
        };
        const RunSettings settings = store.settings();
        const Shard shard = shardFrom(settingOf(settings, "shard"));
        if (shard.count == 0) fail("is damaged: it does not say which shard it is");
        if (first.empty()) first = settings;
        RunSettings like = withSetting(settings, "shard", settingOf(first, "shard"));
        like = withSetting(like, "cells", settingOf(first, "cells"));
        if (const std::string difference = differenceOf(first, like); !difference.empty())
            fail(fmt::format("is of another run than {} ({})", folders.front().string(), difference));
        if (shard.count != shardFrom(settingOf(first, "shard")).count)
            fail(fmt::format("is shard {}, but {} is {}", toText(shard), folders.front().string(),
                             settingOf(first, "shard")));
        if (const auto twin = found.find(shard); twin != found.end())
            fail(fmt::format("is shard {}, as {} is", toText(shard), twin->second.folder().string()));
        if (const std::string missing = missingOf(store); !missing.empty())
            fail(fmt::format("is not at its end: {} are there", missing));
        found.emplace(shard, std::move(store));
    }
    const int count = shardFrom(settingOf(first, "shard")).count;
    for (int index = 1; index <= count; ++index)
        if (!found.contains({index, count}))
            throw StoreError(fmt::format("shard {} is missing", toText(Shard{index, count})));
    std::vector<CellStore> stores;
    for (auto& [shard, store] : found) stores.push_back(std::move(store));
    return stores;
}

}  // namespace

std::string missingOf(const CellStore& store) {
    const std::string all = settingOf(store.settings(), "cells");
    const std::string there = fmt::format("{}", store.count());
    return there == all ? "" : fmt::format("{} of {} cells", there, all);
}

CellStore mergedShards(const std::vector<std::filesystem::path>& folders,
                       const std::filesystem::path& folder) {
    for (const std::filesystem::path& shard : folders) {
        std::error_code none;
        if (std::filesystem::equivalent(shard, folder, none))
            throw StoreError(fmt::format("{}: is a shard itself", folder.string()));
    }
    const std::vector<CellStore> shards = shardsIn(folders);
    std::size_t cells = 0;
    for (const CellStore& shard : shards) cells += shard.count();
    const RunSettings settings = wholeOf(shards.front().settings(), cells);

    CellStore whole = CellStore::toWrite(folder);
    const RunSettings there = whole.settings();
    if (const std::string difference = there.empty() ? "" : differenceOf(there, settings);
        !difference.empty())
        throw StoreError(fmt::format("{}: another run is there ({})", folder.string(), difference));
    for (const CellStore& shard : shards)
        linkAllPictures(shard.folder() / CellStore::kPictures, folder / CellStore::kPictures);
    whole.inOneTransaction([&] {
        whole.clear();
        whole.setSettings(settings);
        for (const CellStore& shard : shards) {
            for (const StoredSession& session : shard.sessions()) whole.addSession(session);
            shard.forEach([&](const StoredCell& cell) { whole.put(cell); });
        }
        if (whole.count() != cells)
            throw StoreError(
                fmt::format("{}: shards share {} cells", folder.string(), cells - whole.count()));
    });
    whole.finish();
    return whole;
}

}  // namespace gnomon
