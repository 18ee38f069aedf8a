// The store of a run: what was put survives whatever ends the process, and what is no store is refused.

#include "matrix/cell_store.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <sstream>

#include "process/child.h"
#include "process/die_of.h"
#include "temporary_folder.h"

namespace gnomon {
namespace cell_store_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

StoredCell cellAt(std::size_t place, const std::string& verdict = "exact") {
    return {place,
            ~std::uint64_t(place),
            verdict,
            0.25 * double(place),
            place << 60 | place,
            fmt::format("cell {}", place)};
}

std::vector<std::string> cellsIn(const CellStore& store) {
    std::vector<std::string> cells;
    store.forEach([&](const StoredCell& cell) { cells.push_back(cell.cell); });
    return cells;
}

/// What @p work throws, as a StoreError.
std::string refusalOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const StoreError& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(CellStore, GivesBackWhatWasPutInTheOrderOfPlaces) {
    const TemporaryFolder folder;
    CellStore store = CellStore::toWrite(folder / "run");
    for (const std::size_t place : {7u, 0u, 3u}) store.put(cellAt(place));
    std::vector<StoredCell> all;
    store.forEach([&](const StoredCell& cell) { all.push_back(cell); });
    ASSERT_EQ(all.size(), 3u);
    for (const StoredCell& cell : all) {
        const StoredCell put = cellAt(cell.place);
        EXPECT_EQ(cell.key, put.key);
        EXPECT_EQ(cell.digest, put.digest);
        EXPECT_EQ(cell.seconds, put.seconds);
        EXPECT_EQ(cell.verdict, put.verdict);
    }
    EXPECT_THAT(cellsIn(store), ElementsAre("cell 0", "cell 3", "cell 7"));
}

TEST(CellStore, HasOneCellAPlace) {
    const TemporaryFolder folder;
    CellStore store = CellStore::toWrite(folder / "run");
    store.put(cellAt(1)), store.put(cellAt(1, "wrong")), store.put(cellAt(2));
    EXPECT_EQ(store.count(), 2u);
    EXPECT_THAT(store.countByVerdict(), ElementsAre(Pair("exact", 1u), Pair("wrong", 1u)));
    store.remove({2, 9});
    EXPECT_EQ(store.count(), 1u);
}

TEST(CellStore, DigestIsOverThePlacesOrderWhateverCameFirst) {
    const TemporaryFolder folder;
    CellStore one = CellStore::toWrite(folder / "one"), two = CellStore::toWrite(folder / "two");
    one.put(cellAt(1)), one.put(cellAt(2));
    two.put(cellAt(2)), two.put(cellAt(1));
    EXPECT_EQ(one.digest(), two.digest());
    two.put({.place = 2, .digest = 5});
    EXPECT_NE(one.digest(), two.digest());
}

TEST(CellStore, KeepsSettingsAndSessions) {
    const TemporaryFolder folder;
    const RunSettings settings{{"version", "1"}, {"scenes", "a,b"}, {"a", ""}};
    {
        CellStore store = CellStore::toWrite(folder / "run");
        EXPECT_TRUE(store.settings().empty());
        store.setSettings({{"old", "x"}});
        store.setSettings(settings);
        store.addSession({"2026", "gnomon 'a b'", "a processor", "a host"});
    }
    const CellStore store = CellStore::toRead(folder / "run");
    EXPECT_EQ(store.settings(), settings);
    ASSERT_EQ(store.sessions().size(), 1u);
    EXPECT_EQ(store.sessions()[0].command, "gnomon 'a b'");
}

// A child writes, tells of each cell, and is killed in the middle of it.
TEST(CellStore, HasAllThatWasToldOfWhenItsProcessIsKilled) {
    const TemporaryFolder folder;
    for (int round = 0; round < 20; ++round) {
        const auto path = folder / fmt::format("run{}", round);
        Child child = startChild([&](int socket) {
            CellStore store = CellStore::toWrite(path);
            for (std::size_t place = 0;; ++place) {
                store.put(cellAt(place));
                const char told = 't';
                if (write(socket, &told, 1) != 1) return;
            }
        });
        std::size_t told = 0;
        char buffer[64];
        while (told < std::size_t(1 + 13 * round)) {
            const ssize_t n = read(child.socket, buffer, sizeof buffer);
            ASSERT_GT(n, 0);
            told += std::size_t(n);
        }
        kill(child.pid, SIGKILL);
        waitFor(child);
        const CellStore store = CellStore::toRead(path);
        EXPECT_GE(store.count(), told);
        std::size_t place = 0;
        for (const std::string& cell : cellsIn(store)) EXPECT_EQ(cell, fmt::format("cell {}", place++));
    }
}

TEST(CellStore, TransactionIsAllOrNothing) {
    const TemporaryFolder folder;
    CellStore store = CellStore::toWrite(folder / "run");
    store.put(cellAt(1));
    EXPECT_THROW(store.inOneTransaction([&] {
        store.clear();
        store.setSettings({{"a", "b"}});
        store.put(cellAt(2));
        throw std::runtime_error("no");
    }),
                 std::runtime_error);
    EXPECT_THAT(cellsIn(store), ElementsAre("cell 1"));
    EXPECT_TRUE(store.settings().empty());
    store.put(cellAt(3));
    EXPECT_EQ(store.count(), 2u);
}

TEST(CellStore, IsWrittenByOneProcessAtATime) {
    const TemporaryFolder folder;
    const auto path = folder / "run";
    Child child = startChild([&](int socket) {
        const CellStore store = CellStore::toWrite(path);
        char byte = 'o';
        if (write(socket, &byte, 1) != 1 || read(socket, &byte, 1) < 0) return;
    });
    char byte = 0;
    ASSERT_EQ(read(child.socket, &byte, 1), 1);
    EXPECT_EQ(refusalOf([&] { CellStore::toWrite(path); }),
              fmt::format("{}: another run is at work there (process {})", path.string(), child.pid));
    waitFor(child);
    EXPECT_EQ(CellStore::toWrite(path).count(), 0u);
}

TEST(CellStore, RefusesWhatIsNone) {
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "text";
    EXPECT_THAT(refusalOf([&] { CellStore::toWrite(folder / "file"); }),
                StartsWith((folder / "file").string() + ": "));
    std::filesystem::create_directory(folder / "full");
    std::ofstream(folder / "full" / "letter.txt") << "dear";
    EXPECT_THAT(refusalOf([&] { CellStore::toWrite(folder / "full"); }),
                HasSubstr("has other things than a run in it"));
    EXPECT_THAT(refusalOf([&] { CellStore::toRead(folder / "none"); }), HasSubstr("no run is there"));
    std::filesystem::create_directory(folder / "text");
    std::ofstream(folder / "text" / CellStore::kFile) << std::string(5000, 'x');
    for (const auto& open : {CellStore::toWrite, CellStore::toRead})
        EXPECT_THAT(refusalOf([&] { open(folder / "text"); }), HasSubstr("run.sqlite is no store of gnomon"));
    EXPECT_THAT(refusalOf([&] { CellStore::toWrite("/proc/gnomon"); }), StartsWith("/proc/gnomon: "));
}

/// A store of @p cells cells that is at its end.
std::filesystem::path finished(const TemporaryFolder& folder, std::size_t cells) {
    const auto path = folder / "run";
    CellStore store = CellStore::toWrite(path);
    for (std::size_t place = 0; place < cells; ++place) {
        StoredCell cell = cellAt(place);
        cell.cell += std::string(500, 'x');
        store.put(cell);
    }
    store.finish();
    return path;
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

// Neither a store of a later gnomon nor somebody else's database is written to by being refused.
TEST(CellStore, LeavesWhatItRefusesAsItIs) {
    const TemporaryFolder folder;
    const auto path = finished(folder, 3);
    const std::string good = bytesOf(path / CellStore::kFile);
    constexpr std::size_t kFormatByte = 63, kApplicationByte = 71;  // the last of four each
    for (const auto& [byte, what] :
         {std::pair{kFormatByte, "has format 99"}, std::pair{kApplicationByte, "is no store of gnomon"}}) {
        std::string content = good;
        content[byte] = 99;
        std::ofstream(path / CellStore::kFile, std::ios::binary) << content;
        EXPECT_THAT(refusalOf([&] { CellStore::toWrite(path); }), HasSubstr(what));
        EXPECT_EQ(bytesOf(path / CellStore::kFile), content) << what;
    }
}

// As a killed process leaves it that had only just made the file.
TEST(CellStore, TakesAnEmptyFileForOneThatHasNotBegun) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "run");
    std::ofstream(folder / "run" / CellStore::kFile).close();
    CellStore store = CellStore::toWrite(folder / "run");
    store.put(cellAt(1));
    EXPECT_EQ(store.count(), 1u);
}

TEST(CellStore, IsOneFileAtItsEnd) {
    const TemporaryFolder folder;
    const auto path = finished(folder, 10);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        names.push_back(entry.path().filename());
    EXPECT_THAT(names, ElementsAre(CellStore::kFile));
    const CellStore one = CellStore::toRead(path), two = CellStore::toRead(path);
    EXPECT_EQ(one.count() + two.count(), 20u) << "two read at a time";
}

// Half of the pages are gone, or another has other things in it.
TEST(CellStore, RefusesADamagedOne) {
    const TemporaryFolder folder;
    const auto path = finished(folder, 200);
    const auto file = path / CellStore::kFile;
    const auto size = std::filesystem::file_size(file);
    std::filesystem::resize_file(file, size / 2);
    EXPECT_THAT(refusalOf([&] { cellsIn(CellStore::toWrite(path)); }),
                AllOf(HasSubstr("run.sqlite is damaged"), HasSubstr("without it the run begins anew")));
}

}  // namespace cell_store_test
}  // namespace gnomon
