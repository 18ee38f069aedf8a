#include "matrix/merge.h"

#include <fmt/format.h>

#include <map>

#include "matrix/cell_pictures.h"
#include "matrix/stored_cell.h"

namespace gnomon {
namespace {

/// The settings of a whole run of which @p shard is a part.
RunSettings wholeOf(RunSettings shard, std::size_t cells) {
    shard = withSetting(std::move(shard), "shard", toText(Shard{}));
    shard = withSetting(std::move(shard), "past", "");
    return withSetting(std::move(shard), "cells", fmt::format("{}", cells));
}

/// The shards of one run in their order.
struct ShardFolders {
    std::vector<std::filesystem::path> folders{};
    std::size_t cells = 0;
    RunSettings whole{};
};

/// One is open at a time: there may be more of them than a process may have files.
/// @throws StoreError
ShardFolders shardsIn(const std::vector<std::filesystem::path>& folders) {
    ShardFolders result;
    std::map<Shard, std::filesystem::path> found;
    RunSettings first;
    for (const std::filesystem::path& folder : folders) {
        const CellStore store = CellStore::toRead(folder);
        const auto fail = [&](const std::string& what) {
            throw StoreError(fmt::format("{}: {}", folder.string(), what));
        };
        const RunSettings settings = store.settings();
        const Shard shard = shardFrom(settingOf(settings, "shard"));
        if (shard.count == 0) fail("is damaged: it does not say which shard it is");
        if (first.empty()) first = settings;
        RunSettings like = withLimitsOf(withSetting(settings, "shard", settingOf(first, "shard")), first);
        like = withSetting(like, "cells", settingOf(first, "cells"));
        if (const std::string difference = differenceOf(first, like); !difference.empty())
            fail(fmt::format("is of another run than {} ({})", folders.front().string(), difference));
        if (shard.count != shardFrom(settingOf(first, "shard")).count)
            fail(fmt::format("is shard {}, but {} is {}", toText(shard), folders.front().string(),
                             settingOf(first, "shard")));
        if (const auto [twin, isNew] = found.try_emplace(shard, folder); !isNew)
            fail(fmt::format("is shard {}, as {} is", toText(shard), twin->second.string()));
        if (const std::string missing = missingOf(store); !missing.empty())
            fail(fmt::format("is not at its end: {} are there", missing));
        result.cells += store.count();
    }
    const int count = shardFrom(settingOf(first, "shard")).count;
    for (int index = 1; index <= count; ++index)
        if (!found.contains({index, count}))
            throw StoreError(fmt::format("shard {} is missing", toText(Shard{index, count})));
    for (const auto& [shard, folder] : found) result.folders.push_back(folder);
    result.whole = wholeOf(first, result.cells);
    return result;
}

/// Takes all of a shard, cells as they are once they have been found whole.
void addShard(CellStore& whole, const std::filesystem::path& folder) {
    const CellStore shard = CellStore::toRead(folder);
    const auto pictures = folder / CellStore::kPictures;
    const bool hasThem = settingOf(shard.settings(), "pictures") == "yes";
    for (const StoredSession& session : shard.sessions()) whole.addSession(session);
    shard.forEach([&](const StoredCell& stored) {
        const auto cell = cellIn(stored);
        if (!cell || (hasThem && !hasPictures(pictures, cell->digest)))
            throw StoreError(fmt::format("{}: {}; the command that drew it draws it again", folder.string(),
                                         cell ? fmt::format("a picture of {} is missing", cell->id())
                                              : fmt::format("cell {} is damaged", stored.place)));
        whole.put(stored);
    });
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
    const ShardFolders shards = shardsIn(folders);
    CellStore whole = CellStore::toWrite(folder);
    const RunSettings there = whole.settings();
    if (const std::string difference =
            there.empty() ? "" : differenceOf(there, withLimitsOf(shards.whole, there));
        !difference.empty())
        throw StoreError(fmt::format("{}: another run is there ({})", folder.string(), difference));
    for (const std::filesystem::path& shard : shards.folders)
        linkAllPictures(shard / CellStore::kPictures, folder / CellStore::kPictures);
    whole.inOneTransaction([&] {
        whole.clear();
        whole.setSettings(shards.whole);
        for (const std::filesystem::path& shard : shards.folders) addShard(whole, shard);
        if (whole.count() != shards.cells)
            throw StoreError(
                fmt::format("{}: shards share {} cells", folder.string(), shards.cells - whole.count()));
    });
    whole.finish();
    return whole;
}

}  // namespace gnomon
