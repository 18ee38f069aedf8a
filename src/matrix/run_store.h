#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "matrix/cell_list.h"
#include "matrix/cell_store.h"
#include "matrix/content_keys.h"
#include "matrix/run_maker.h"

namespace gnomon {

/// How a run begins in a store, or goes on.
struct RunStoreOptions {
    std::string command{};           ///< the whole command line, to be recorded
    bool retries = false;            ///< failed cells are drawn again, and limits may be others
    std::filesystem::path reused{};  ///< a store whose cells are taken where nothing has changed; empty: none
};

/// A run with its store: cells that are known and whose content has not changed since are taken from there.
class RunStore {
  public:
    /// Begins @p request's run in @p folder, or goes on with the one there.
    /// @throws StoreError  also if that one has other settings: the difference is named
    RunStore(const std::filesystem::path& folder, const MatrixRequest& request, const RunMaker& maker,
             const RunStoreOptions& options = {});

    /// A cell that is known; once.
    std::optional<Cell> take(std::size_t place);
    /// Keeps one that was drawn.
    /// @throws StoreError
    void keep(std::size_t place, const Cell& cell, double seconds);
    /// All are kept.
    /// @throws StoreError  what is there by now is not what was taken and kept
    void finish();

    /// What became of cells that were there.
    struct Counts {
        std::size_t known = 0, reused = 0;  ///< taken from this store, from the other
        std::size_t changed = 0;            ///< their content is another by now
        std::size_t damaged = 0;            ///< what stands there is no longer what was written
        std::size_t retried = 0, bare = 0;  ///< failed and drawn again, without their pictures
    };
    const Counts& counts() const { return m_counts; }
    const CellStore& store() const { return m_store; }

  private:
    void begin(const RunSettings& asked, bool retries);
    void takeOwn(bool retries);
    void takeFrom(const std::filesystem::path& folder);

    CellList m_list;
    ContentKeys m_keys;
    CellStore m_store;
    std::unordered_map<std::size_t, Cell> m_known{};
    std::map<std::size_t, std::uint64_t> m_digests{};  ///< of all cells that are in the store now, by place
    Counts m_counts{};
};

}  // namespace gnomon
