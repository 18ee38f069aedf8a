#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "matrix/run_settings.h"
#include "matrix/shard.h"

namespace gnomon {

/// A store that can't be used. what() is one line, "folder: what".
struct StoreError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One verdict as it is kept.
struct StoredCell {
    std::size_t place = 0;     ///< CellList
    std::uint64_t key = 0;     ///< ContentKeys
    std::string verdict{};     ///< name(Verdict)
    double seconds = 0;        ///< wall clock that it took
    std::uint64_t digest = 0;  ///< of the cell without its times
    std::string cell{};        ///< toJson()
};

/// One process that worked on a run.
struct StoredSession {
    std::string began{};  ///< by the system's clock, UTC: "2026-11-23T12:00:00Z"
    std::string command{};
    std::string processor{}, host{};
};

/// The verdicts of one run in a folder, in SQLite. Each is a transaction, in a log of its own (WAL): what
/// put() has taken survives the end of the process at any moment, though the last seconds may be lost with
/// the machine's power. One process at a time writes; none reads beside it.
class CellStore {
  public:
    /// The database in a run's folder.
    static constexpr const char* kFile = "run.sqlite";
    /// The pictures beside it.
    static constexpr const char* kPictures = "pictures";

    /// Opens the store in @p folder to write; makes both where there are none.
    /// @throws StoreError  the folder can't be made or has other things in it, what is there is no store or
    /// is
    ///                     damaged, or another process has it open
    static CellStore toWrite(const std::filesystem::path& folder);
    /// Opens a store that is there.
    /// @throws StoreError
    static CellStore toRead(const std::filesystem::path& folder);

    CellStore(CellStore&&) noexcept;
    ~CellStore();

    const std::filesystem::path& folder() const;

    /// Empty of a store that was just made.
    RunSettings settings() const;
    /// Writes the settings of a new run.
    void setSettings(const RunSettings& settings);

    void addSession(const StoredSession& session);
    std::vector<StoredSession> sessions() const;

    /// Keeps a verdict, in place of one that was there; it is on its way to the disk when this returns.
    /// @throws StoreError  such as that the disk is full; what was kept before stays
    void put(const StoredCell& cell);
    /// All that @p work writes is written, or nothing if it throws or the process ends.
    void inOneTransaction(const std::function<void()>& work);
    /// Forgets verdicts, all or none.
    void remove(const std::vector<std::size_t>& places);

    /// Forgets all but the settings.
    void clear();

    std::size_t count() const;
    std::map<std::string, std::size_t> countByVerdict() const;
    /// Cells in the order of their places.
    void forEach(const std::function<void(const StoredCell&)>& take) const;
    /// Over the digests of all cells in their order, 16 hexadecimal digits.
    std::string digest() const;
    PastCosts costs() const;

    /// Makes one file of it that needs no log, for a run that has ended.
    void finish();

  private:
    struct Impl;
    explicit CellStore(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Whether @p folder holds a run.
bool hasStore(const std::filesystem::path& folder);

}  // namespace gnomon
