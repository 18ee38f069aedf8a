#include "matrix/run_store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <utility>

#include "matrix/cell_pictures.h"
#include "matrix/digest.h"
#include "matrix/stored_cell.h"

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

/// What of @p there a run that goes on must not have in common: of another program no cell is taken, and
/// limits matter to failed cells only.
RunSettings comparable(RunSettings asked, const RunSettings& there, bool withLimits) {
    asked = withSetting(std::move(asked), "program", settingOf(there, "program"));
    if (!withLimits) asked = withLimitsOf(std::move(asked), there);
    return asked;
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
        const bool hasFailed = m_store.countByVerdict().contains(name(Verdict::Failed));
        const RunSettings like = comparable(asked, there, hasFailed && !retries);
        if (const std::string difference = differenceOf(there, like); !difference.empty())
            throw StoreError(fmt::format("{}: the run there has other settings ({})",
                                         m_store.folder().string(), difference));
    }
    if (there != asked) m_store.setSettings(asked);
}

void RunStore::takeOwn(bool retries) {
    const std::filesystem::path& pictures = m_list.request().pictureFolder;
    std::vector<std::size_t> stale;
    m_store.forEach([&](const StoredCell& stored) {
        const bool isOurs = stored.place < m_list.count() && m_keys.of(stored.place) == stored.key;
        auto cell = isOurs ? cellIn(stored) : std::nullopt;
        const bool isRetried = cell && retries && cell->verdict == Verdict::Failed;
        const bool isBare = cell && !pictures.empty() && !hasPictures(pictures, cell->digest);
        if (!cell || isRetried || isBare) {
            ++(!isOurs     ? m_counts.changed
               : !cell     ? m_counts.damaged
               : isRetried ? m_counts.retried
                           : m_counts.bare);
            stale.push_back(stored.place);
            return;
        }
        m_digests[stored.place] = stored.digest;
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
        m_digests[mine.place] = mine.digest;
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
    const StoredCell stored = storedCell(place, m_keys.of(place), cell, seconds);
    m_store.put(stored);
    m_digests[place] = stored.digest;
}

void RunStore::finish() {
    Digest digest;
    for (const auto& [place, one] : m_digests) digest.add(one);
    if (digest.text() != m_store.digest())
        throw StoreError(fmt::format("{}: {} is damaged: it has not what was written",
                                     m_store.folder().string(), CellStore::kFile));
    m_store.finish();
}

}  // namespace gnomon
