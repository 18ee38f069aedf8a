#include "matrix/cell_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/Savepoint.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <string_view>
#include <utility>

#include "matrix/digest.h"

namespace gnomon {
namespace {

constexpr int kFormat = 1;
constexpr int kApplication = 0x676e6f6d;  ///< "gnom": tells a store from any other database
constexpr int kWriterWaitsMs = 2000;      ///< for a process that is just ending
constexpr int kReaderWaitsMs = 30'000;    ///< for others that read a run that was broken off

/// The process that holds a lock of SQLite on @p file; 0 if none does.
pid_t holderOf(const std::filesystem::path& file) {
    constexpr off_t kPendingByte = 0x40000000,
                    kLockBytes = 512;  // SQLite's file format, 1.3 "The Lock-Byte Page"
    const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) return 0;
    struct flock lock {};
    lock.l_type = F_WRLCK, lock.l_whence = SEEK_SET, lock.l_start = kPendingByte, lock.l_len = kLockBytes;
    const bool isKnown = fcntl(opened, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    close(opened);
    return isKnown ? lock.l_pid : 0;
}

/// The database by a name that SQLite takes for nothing else than a file.
std::string fileOf(const std::filesystem::path& folder) {
    return std::filesystem::absolute(folder / CellStore::kFile);
}

/// What SQLite says of a store, for people.
std::string meaningOf(const SQLite::Exception& error, const std::filesystem::path& file) {
    switch (error.getErrorCode()) {
        case SQLITE_BUSY: {
            const pid_t holder = holderOf(file);
            return fmt::format("another run is at work there{}",
                               holder ? fmt::format(" (process {})", holder) : "");
        }
        case SQLITE_NOTADB:
            return fmt::format("{} is no store of gnomon", CellStore::kFile);
        case SQLITE_CORRUPT:
            return fmt::format("{} is damaged ({}); without it the run begins anew", CellStore::kFile,
                               error.what());
        case SQLITE_FULL:
            return "the disk is full; what was kept stays, and the same command goes on from there";
        case SQLITE_READONLY:
        case SQLITE_CANTOPEN:
        case SQLITE_PERM:
            return fmt::format("{} can't be written ({})", CellStore::kFile, error.what());
        case SQLITE_IOERR:
            return fmt::format("{}: {}; what was kept stays, and the same command goes on from there",
                               CellStore::kFile, error.what());
        default:
            return fmt::format("{}: {}", CellStore::kFile, error.what());
    }
}

std::int64_t asSigned(std::uint64_t value) {
    return std::bit_cast<std::int64_t>(value);
}
std::uint64_t asUnsigned(std::int64_t value) {
    return std::bit_cast<std::uint64_t>(value);
}

constexpr const char* kSchema = R"(
    CREATE TABLE settings(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
    CREATE TABLE sessions(session INTEGER PRIMARY KEY, began TEXT NOT NULL, command TEXT NOT NULL,
                          processor TEXT NOT NULL, host TEXT NOT NULL) STRICT;
    CREATE TABLE cells(place INTEGER PRIMARY KEY, key INTEGER NOT NULL, verdict TEXT NOT NULL, seconds REAL NOT NULL,
                       digest INTEGER NOT NULL, cell TEXT NOT NULL) STRICT;
)";

/// Refuses a folder that holds something else than a run.
void checkFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw StoreError(fmt::format("{}: {}", folder.string(), error ? error.message() : "is no folder"));
    if (hasStore(folder)) return;
    const bool isEmpty = std::filesystem::is_empty(folder, error);
    if (error) throw StoreError(fmt::format("{}: {}", folder.string(), error.message()));
    if (!isEmpty) throw StoreError(fmt::format("{}: has other things than a run in it", folder.string()));
}

/// What the first bytes of a database say (SQLite's file format, 1.3 "The Database Header"), without a write
/// to it.
struct DatabaseHeader {
    bool isDatabase = false, isEmpty = false;
    int application = 0, format = 0;
};

DatabaseHeader headerOf(const std::filesystem::path& file) {
    std::array<unsigned char, 100> bytes{};
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    if (in.gcount() == 0) return {.isDatabase = true, .isEmpty = true};
    const auto number = [&](std::size_t at) {
        return int(unsigned(bytes[at]) << 24 | unsigned(bytes[at + 1]) << 16 | unsigned(bytes[at + 2]) << 8 |
                   bytes[at + 3]);
    };
    constexpr std::string_view kMagic("SQLite format 3", 16);
    return {.isDatabase = std::equal(kMagic.begin(), kMagic.end(), bytes.begin()),
            .isEmpty = number(40) == 0,  // the schema's cookie: no table was made
            .application = number(68),
            .format = number(60)};
}

/// Refuses a file that is none of ours, before anything is written there. What a log beside it holds is not
/// known here.
void checkHeader(const std::filesystem::path& folder) {
    std::error_code none;
    const auto file = folder / CellStore::kFile;
    if (!std::filesystem::exists(file, none) || std::filesystem::exists(file.string() + "-wal", none)) return;
    const DatabaseHeader header = headerOf(file);
    if (header.isDatabase && header.isEmpty) return;
    if (!header.isDatabase || header.application != kApplication)
        throw StoreError(fmt::format("{}: {} is no store of gnomon", folder.string(), CellStore::kFile));
    if (header.format != kFormat)
        throw StoreError(fmt::format("{}: {} has format {}, this gnomon reads {}", folder.string(),
                                     CellStore::kFile, header.format, kFormat));
}

}  // namespace

struct CellStore::Impl {
    std::filesystem::path folder{};
    std::optional<SQLite::Database> database{};
    std::optional<SQLite::Statement> insertion{};

    /// Does @p work; what SQLite throws is about this store.
    template <class Work>
    auto guarded(const Work& work) const {
        try {
            return work();
        } catch (const SQLite::Exception& error) {
            throw StoreError(
                fmt::format("{}: {}", folder.string(), meaningOf(error, folder / CellStore::kFile)));
        }
    }

    void checkFormat(SQLite::Database& db) const {
        const int application = db.execAndGet("PRAGMA application_id"),
                  format = db.execAndGet("PRAGMA user_version");
        if (application != kApplication)
            throw StoreError(fmt::format("{}: {} is no store of gnomon", folder.string(), CellStore::kFile));
        if (format != kFormat)
            throw StoreError(fmt::format("{}: {} has format {}, this gnomon reads {}", folder.string(),
                                         CellStore::kFile, format, kFormat));
    }

    /// @throws StoreError  pages are damaged, or somebody has added to what we made
    void checkContent(SQLite::Database& db) const {
        const std::string fault = db.execAndGet("PRAGMA quick_check(1)");
        if (fault != "ok")
            throw StoreError(fmt::format("{}: {} is damaged ({}); without it the run begins anew",
                                         folder.string(), CellStore::kFile, fault));
        const int ours = db.execAndGet(
            "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('settings', 'sessions', "
            "'cells')");
        const int foreign =
            db.execAndGet("SELECT count(*) FROM sqlite_master WHERE type IN ('trigger', 'view')");
        if (ours != 3 || foreign != 0)
            throw StoreError(fmt::format("{}: {} has not the tables that it was made with", folder.string(),
                                         CellStore::kFile));
    }

    void put(const StoredCell& cell) {
        SQLite::Statement& s = *insertion;
        s.reset();
        s.bind(1, std::int64_t(cell.place));
        s.bind(2, asSigned(cell.key));
        s.bindNoCopy(3, cell.verdict);
        s.bind(4, cell.seconds);
        s.bind(5, asSigned(cell.digest));
        s.bindNoCopy(6, cell.cell);
        s.exec();
        s.reset();  // and lets go of what it was given
    }
};

CellStore::CellStore(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
CellStore::CellStore(CellStore&&) noexcept = default;
CellStore::~CellStore() = default;

CellStore CellStore::toWrite(const std::filesystem::path& folder) {
    checkFolder(folder);
    checkHeader(folder);
    auto impl = std::make_unique<Impl>();
    impl->folder = folder;
    impl->guarded([&] {
        impl->database.emplace(fileOf(folder), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kWriterWaitsMs);
        SQLite::Database& db = *impl->database;
        // The lock is taken by the first access and held until the process ends, in whatever way; and the log
        // needs no shared memory then, which files on a network haven't.
        db.exec("PRAGMA locking_mode = EXCLUSIVE");
        db.exec("PRAGMA journal_mode = WAL");
        db.exec("PRAGMA synchronous = NORMAL");
        SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
        // Else it was ended before it had begun.
        if (int(db.execAndGet("SELECT count(*) FROM sqlite_master")) == 0) {
            db.exec(kSchema);
            db.exec(fmt::format("PRAGMA application_id = {}", kApplication));
            db.exec(fmt::format("PRAGMA user_version = {}", kFormat));
        }
        impl->checkFormat(db);
        impl->checkContent(db);
        transaction.commit();
        impl->insertion.emplace(db, "INSERT OR REPLACE INTO cells VALUES (?, ?, ?, ?, ?, ?)");
    });
    return CellStore(std::move(impl));
}

CellStore CellStore::toRead(const std::filesystem::path& folder) {
    if (!hasStore(folder)) throw StoreError(fmt::format("{}: no run is there ({})", folder.string(), kFile));
    auto impl = std::make_unique<Impl>();
    impl->folder = folder;
    impl->guarded([&] {
        const std::string file = fileOf(folder);
        // What was broken off is put right by opening it, which is to write.
        const bool isWritable = access(file.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0;
        impl->database.emplace(file, isWritable ? SQLite::OPEN_READWRITE : SQLite::OPEN_READONLY,
                               kReaderWaitsMs);
        impl->database->exec("PRAGMA locking_mode = EXCLUSIVE");
        if (int(impl->database->execAndGet("SELECT count(*) FROM sqlite_master")) == 0)
            throw StoreError(fmt::format("{}: the run there has not begun", folder.string()));
        impl->checkFormat(*impl->database);
        impl->checkContent(*impl->database);
    });
    return CellStore(std::move(impl));
}

const std::filesystem::path& CellStore::folder() const {
    return m_impl->folder;
}

RunSettings CellStore::settings() const {
    return m_impl->guarded([&] {
        RunSettings settings;
        SQLite::Statement query(*m_impl->database, "SELECT name, value FROM settings ORDER BY rowid");
        while (query.executeStep())
            settings.emplace_back(query.getColumn(0).getString(), query.getColumn(1).getString());
        return settings;
    });
}

void CellStore::setSettings(const RunSettings& settings) {
    inOneTransaction([&] {
        m_impl->database->exec("DELETE FROM settings");
        for (const auto& [name, value] : settings) {
            SQLite::Statement insertion(*m_impl->database, "INSERT INTO settings VALUES (?, ?)");
            insertion.bind(1, name), insertion.bind(2, value);
            insertion.exec();
        }
    });
}

void CellStore::addSession(const StoredSession& session) {
    m_impl->guarded([&] {
        SQLite::Statement insertion(*m_impl->database, "INSERT INTO sessions VALUES (NULL, ?, ?, ?, ?)");
        insertion.bind(1, session.began), insertion.bind(2, session.command);
        insertion.bind(3, session.processor), insertion.bind(4, session.host);
        insertion.exec();
    });
}

std::vector<StoredSession> CellStore::sessions() const {
    return m_impl->guarded([&] {
        std::vector<StoredSession> sessions;
        SQLite::Statement query(*m_impl->database,
                                "SELECT began, command, processor, host FROM sessions ORDER BY session");
        while (query.executeStep())
            sessions.push_back(
                {query.getColumn(0), query.getColumn(1), query.getColumn(2), query.getColumn(3)});
        return sessions;
    });
}

void CellStore::put(const StoredCell& cell) {
    m_impl->guarded([&] { m_impl->put(cell); });
}

void CellStore::inOneTransaction(const std::function<void()>& work) {
    m_impl->guarded([&] {
        const bool isWithinOne = sqlite3_get_autocommit(m_impl->database->getHandle()) == 0;
        if (isWithinOne) return work();
        SQLite::Transaction all(*m_impl->database);
        work();
        all.commit();
    });
}

void CellStore::remove(const std::vector<std::size_t>& places) {
    if (places.empty()) return;
    inOneTransaction([&] {
        SQLite::Statement deletion(*m_impl->database, "DELETE FROM cells WHERE place = ?");
        for (const std::size_t place : places) {
            deletion.bind(1, std::int64_t(place));
            deletion.exec();
            deletion.reset();
        }
    });
}

void CellStore::clear() {
    m_impl->guarded([&] { m_impl->database->exec("DELETE FROM cells; DELETE FROM sessions"); });
}

std::size_t CellStore::count() const {
    return m_impl->guarded(
        [&] { return std::size_t(m_impl->database->execAndGet("SELECT count(*) FROM cells").getInt64()); });
}

std::map<std::string, std::size_t> CellStore::countByVerdict() const {
    return m_impl->guarded([&] {
        std::map<std::string, std::size_t> counts;
        SQLite::Statement query(*m_impl->database, "SELECT verdict, count(*) FROM cells GROUP BY verdict");
        while (query.executeStep()) counts[query.getColumn(0)] = std::size_t(query.getColumn(1).getInt64());
        return counts;
    });
}

void CellStore::forEach(const std::function<void(const StoredCell&)>& take) const {
    m_impl->guarded([&] {
        SQLite::Statement query(
            *m_impl->database, "SELECT place, key, verdict, seconds, digest, cell FROM cells ORDER BY place");
        while (query.executeStep())
            take({std::size_t(query.getColumn(0).getInt64()), asUnsigned(query.getColumn(1).getInt64()),
                  query.getColumn(2), query.getColumn(3), asUnsigned(query.getColumn(4).getInt64()),
                  query.getColumn(5)});
    });
}

std::string CellStore::digest() const {
    return m_impl->guarded([&] {
        Digest digest;
        SQLite::Statement query(*m_impl->database, "SELECT digest FROM cells ORDER BY place");
        while (query.executeStep()) digest.add(asUnsigned(query.getColumn(0).getInt64()));
        return digest.text();
    });
}

PastCosts CellStore::costs() const {
    return m_impl->guarded([&] {
        PastCosts costs;
        SQLite::Statement query(*m_impl->database,
                                "SELECT cell ->> '$.scene', cell ->> '$.width', cell ->> '$.height', "
                                "cell ->> '$.frame', cell ->> '$.profile', sum(seconds) "
                                "FROM cells GROUP BY 1, 2, 3, 4, 5");
        while (query.executeStep())
            costs[{query.getColumn(0).getString(), query.getColumn(1).getInt(), query.getColumn(2).getInt(),
                   query.getColumn(3).getInt(), query.getColumn(4).getString()}] =
                query.getColumn(5).getDouble();
        return costs;
    });
}

void CellStore::finish() {
    m_impl->guarded([&] { m_impl->database->exec("PRAGMA journal_mode = DELETE"); });
}

bool hasStore(const std::filesystem::path& folder) {
    std::error_code none;
    return std::filesystem::is_regular_file(folder / CellStore::kFile, none);
}

}  // namespace gnomon
