#include "matrix/run_store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <utility>

#include "matrix/cell_json.h"
#include "matrix/cell_pictures.h"

namespace gnomon {
namespace {

StoredSession sessionOf(const RunMaker& maker, const std::string& command) {
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    return {.began = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
            .command = command,
            .processor = maker.processor,
            .host = host.data()};
}

/// The cell that @p stored holds; nothing if it is not what was written.
std::optional<Cell> cellIn(const StoredCell& stored) {
    try {
        Cell cell = cellFromJson(nlohmann::ordered_json::parse(stored.cell));
        if (contentDigest(cell) == stored.digest) return cell;
    } catch (const std::exception&) {
        // A text that is no cell is as damaged as one that says something else.
    }
    return std::nullopt;
}

}  // namespace

RunStore::RunStore(const std::filesystem::path& folder, const MatrixRequest& request, const RunMaker& maker,
                   const RunStoreOptions& options)
    : m_list(request), m_keys(m_list, maker), m_store(CellStore::toWrite(folder)) {
    begin(settingsOf(request, maker), options.retries);
    if (!request.pictureFolder.empty()) {
        std::error_code error;
        std::filesystem::create_directories(request.pictureFolder, error);
        if (error) throw StoreError(fmt::format("{}: {}", request.pictureFolder.string(), error.message()));
        removeHalfWritten(request.pictureFolder);
    }
    takeOwn(options.retries);
    if (!options.reused.empty()) takeFrom(options.reused);
    m_store.addSession(sessionOf(maker, options.command));
}

void RunStore::begin(const RunSettings& asked, bool retries) {
    const RunSettings there = m_store.settings();
    if (!there.empty()) {
        // Of another program no cell is taken, but the run is the same.
        RunSettings like = withSetting(asked, "program", settingOf(there, "program"));
        if (retries)
            for (const char* limit : {"timeout", "memory"})
                like = withSetting(like, limit, settingOf(there, limit));
        if (const std::string difference = differenceOf(there, like); !difference.empty())
            throw StoreError(fmt::format("{}: the run there has other settings ({})",
                                         m_store.folder().string(), difference));
    }
    if (there != asked) m_store.setSettings(asked);
}

void RunStore::takeOwn(bool retries) {
    std::vector<std::size_t> stale;
    m_store.forEach([&](const StoredCell& stored) {
        const bool isOurs = stored.place < m_list.count() && m_keys.of(stored.place) == stored.key;
        auto cell = isOurs ? cellIn(stored) : std::nullopt;
        const bool isRetried = cell && retries && cell->verdict == Verdict::Failed;
        if (!cell || isRetried) {
            ++(!isOurs ? m_counts.changed : isRetried ? m_counts.retried : m_counts.damaged);
            stale.push_back(stored.place);
            return;
        }
        m_known.emplace(stored.place, std::move(*cell));
        ++m_counts.known;
    });
    m_store.remove(stale);
}

void RunStore::takeFrom(const std::filesystem::path& folder) {
    std::error_code none;
    if (std::filesystem::equivalent(folder, m_store.folder(), none))
        throw StoreError(fmt::format("{}: is the run's own folder", folder.string()));
    std::unordered_map<std::uint64_t, std::size_t> wanted;
    const MatrixRequest& request = m_list.request();
    for (const std::size_t place : placesOf(m_list, request.shard, request.past))
        if (!m_known.contains(place)) wanted.emplace(m_keys.of(place), place);
    const CellStore other = CellStore::toRead(folder);
    other.forEach([&](const StoredCell& stored) {
        const auto at = wanted.find(stored.key);
        if (at == wanted.end()) return;
        auto cell = cellIn(stored);
        if (!cell || cell->verdict == Verdict::Failed) return;
        const bool isDrawn = !request.pictureFolder.empty() && !cell->digest.empty();
        if (isDrawn && !linkPictures(folder / CellStore::kPictures, request.pictureFolder, cell->digest))
            return;
        StoredCell mine = stored;
        mine.place = at->second;
        m_store.put(mine);
        m_known.emplace(mine.place, std::move(*cell));
        ++m_counts.reused;
    });
}

std::optional<Cell> RunStore::take(std::size_t place) {
    auto known = m_known.extract(place);
    if (known.empty()) return std::nullopt;
    return std::move(known.mapped());
}

void RunStore::keep(std::size_t place, const Cell& cell, double seconds) {
    m_store.put({.place = place,
                 .key = m_keys.of(place),
                 .verdict = name(cell.verdict),
                 .seconds = seconds,
                 .digest = contentDigest(cell),
                 .cell = toJson(cell).dump()});
}

}  // namespace gnomon
