// `gnomon matrix --out`: a run that is kept, what becomes of it when the process, the disk or the clock
// fails, and that it comes out the same however it is drawn.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>

#include "matrix/cell_store.h"
#include "program.h"
#include "pseudo_terminal.h"
#include "running.h"

namespace gnomon {
namespace keep_test {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

using Words = std::vector<std::string>;

/// 126 small cells.
const Words kCells{"matrix",   "--scene", "boxes",  "--profile", "ideal,voodoo2,tnt", "--size", "32x24",
                   "--frames", "0,30",    "--jobs", "2"};

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class Keep : public ProgramTest {
  protected:
    Outcome keep(const std::string& folder, const Words& more = {}, const Words& cells = kCells) const {
        return run(with(cells, with({"--out", pathOf(folder)}, more)));
    }
    /// The digest of a run that is at its end.
    std::string digestIn(const std::string& folder) const {
        return CellStore::toRead(pathOf(folder)).digest();
    }
    /// That of kCells, drawn without a disturbance.
    std::string undisturbed(const Words& cells = kCells) const {
        const Outcome outcome = keep("undisturbed", {}, cells);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return digestIn("undisturbed");
    }
    /// A shell's commands, in which the program is "$1" and the folder "$2".
    Outcome shell(const std::string& commands) const {
        const std::string out = pathOf("stdout"), err = pathOf("stderr");
        const std::string line = fmt::format("/bin/bash -c '{}' shell '{}' '{}' >{} 2>{}", commands,
                                             GNOMON_PROGRAM, pathOf(""), out, err);
        const int status = std::system(line.c_str());
        return {WEXITSTATUS(status), contentOf(out), contentOf(err)};
    }
};

TEST_F(Keep, TheSameCommandTakesAllFromThere) {
    const Outcome first = keep("run"), second = keep("run");
    EXPECT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(second.status, 0) << second.err;
    const std::string digest = digestIn("run");
    const auto cut = [](const std::string& text) { return text.substr(0, text.rfind("run: 126 cells")); };
    EXPECT_EQ(cut(first.out), cut(second.out));
    EXPECT_THAT(first.out, HasSubstr(fmt::format("run: 126 cells; digest {}\n", digest)));
    EXPECT_THAT(second.out,
                HasSubstr(fmt::format("run: 126 cells, 126 of them from before; digest {}\n", digest)));
}

// The table or list is all on standard output that a program reads.
TEST_F(Keep, JsonIsThatOfARunThatIsNotKept) {
    const Outcome kept = keep("run", {"--format", "json"});
    const auto cells = nlohmann::json::parse(kept.out),
               others = nlohmann::json::parse(run(with(kCells, {"--format", "json"})).out);
    EXPECT_THAT(kept.err, HasSubstr("run: 126 cells; digest "));
    ASSERT_EQ(cells.size(), others.size());
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i]["digest"], others[i]["digest"]);
}

TEST_F(Keep, RecordsWhatMadeIt) {
    keep("run");
    const CellStore store = CellStore::toRead(pathOf("run"));
    for (const char* name : {"version", "compiler", "OpenGL", "program"})
        EXPECT_NE(settingOf(store.settings(), name), "") << name;
    ASSERT_THAT(store.sessions(), SizeIs(1));
    EXPECT_THAT(store.sessions()[0].command,
                HasSubstr("matrix --scene boxes --profile ideal,voodoo2,tnt --size"));
    EXPECT_NE(store.sessions()[0].processor, "");
}

// Which picture belongs to which cell is looked up by another command.
TEST_F(Keep, KeepsTheImageAndMaskOfEachCell) {
    const Outcome outcome = keep("run", {"--format", "json"});
    std::set<std::string> files;
    for (const auto& cell : nlohmann::json::parse(outcome.out))
        if (const std::string digest = cell["digest"]; !digest.empty())
            files.insert(digest + ".png"), files.insert(digest + "-mask.png");
    std::set<std::string> there;
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("run/pictures")))
        there.insert(entry.path().filename());
    EXPECT_EQ(files, there);
    for (const auto& cell : nlohmann::json::parse(outcome.out)) {
        if (cell["method"] != "roettger-quarter" || cell["verdict"] == "refused") continue;
        ASSERT_EQ(run({"render", "boxes", "--profile", cell["profile"], "--method", "roettger-quarter",
                       "--size", "32x24", "--frame", fmt::format("{}", int(cell["frame"])), "-o",
                       pathOf("i.png"), "--mask", pathOf("m.png")})
                      .status,
                  0);
        const std::string file = pathOf(fmt::format("run/pictures/{}", std::string(cell["digest"])));
        EXPECT_EQ(contentOf(file + ".png"), contentOf(pathOf("i.png")));
        EXPECT_EQ(contentOf(file + "-mask.png"), contentOf(pathOf("m.png")));
    }
    EXPECT_EQ(keep("bare", {"--pictures", "no"}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(pathOf("bare/pictures")));
}

TEST_F(Keep, RefusesToGoOnWithOtherSettings) {
    keep("run");
    const auto refused = [&](const Words& more, const std::string& what) {
        expectRefused(run(with({"matrix", "--frames", "0,30", "--jobs", "1", "--out", pathOf("run")}, more)),
                      "run: the run there has other settings (" + what + ")");
    };
    const Words scene{"--scene", "boxes"}, chips{"--profile", "ideal,voodoo2,tnt"}, size{"--size", "32x24"};
    refused(with(with(scene, chips), {"--size", "33x24"}), "sizes: 33x24, there 32x24");
    refused(with(with(scene, size), {"--profile", "ideal,ps2"}),
            "profiles: with ps2, without voodoo2, tnt; cells: 84, there 126");
    refused(with(with(with(scene, size), chips), {"--shard", "1/2"}),
            "shard: 1/2, there 1/1; cells: 63, there 126");
    EXPECT_EQ(keep("run").status, 0);
}

TEST_F(Keep, RefusesWhatMakesNoSense) {
    expectRefused(run(with(kCells, {"--retry"})), "--retry: needs --out DIR");
    expectRefused(run(with(kCells, {"--reuse", "x"})), "--reuse: needs --out DIR");
    expectRefused(run(with(kCells, {"--past", "x"})), "--past: is for shards");
    expectRefused(run(with(kCells, {"--shard", "3/2"})), "--shard: '3/2' is not I/N");
    expectRefused(keep("run", {"--reuse", pathOf("none")}), "none: no run is there");
    expectRefused(keep("run", {"--reuse", pathOf("run")}), "run: is the run's own folder");
    write("file", "text");
    expectRefused(keep("file"), "file: ");
    expectRefused(keep("file/run"), "file/run: ");
}

// ---- the process ends

/// Runs the program at a terminal and kills it as soon as that has read of @p cells cells.
/// @return how many it had read of by then; all, where the run was at its end before
std::size_t killedAfter(const Words& arguments, std::size_t cells) {
    int master = -1;
    const pid_t pid = forkpty(&master, nullptr, nullptr, nullptr);
    if (pid == 0) {
        setenv("TERM", "xterm", 1);
        std::vector<std::string> words = with({GNOMON_PROGRAM}, arguments);
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    static const std::regex kShown("([0-9]+) of [0-9]+ cells");
    std::string text;
    std::size_t shown = 0;
    char buffer[4096];
    for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, std::size_t(n));
        for (auto at = std::sregex_iterator(text.begin(), text.end(), kShown); at != std::sregex_iterator();
             ++at)
            shown = std::stoul((*at)[1]);
        if (shown >= cells && text.find(" of ") != std::string::npos) break;
    }
    kill(pid, SIGKILL);
    int status = 0;
    waitpid(pid, &status, 0);
    close(master);
    return shown;
}

TEST_F(Keep, TwentyKillsLoseNothingAndChangeNothing) {
    const Words cells{"matrix", "--scene", "boxes,knot", "--profile",     "ideal,voodoo2,tnt,ps2,tnt2",
                      "--size", "48x32",   "--frames",   "0,10,20,30,40", "--jobs",
                      "2"};
    const std::string digest = undisturbed(cells);
    constexpr std::size_t kAll = 2 * 5 * 5 * 21, kKills = 20;
    std::mt19937 random(std::random_device{}());
    std::size_t kept = 0;
    for (std::size_t kill = 0; kill < kKills; ++kill) {
        // Some in the first moments, some after a while.
        const std::size_t more =
            std::uniform_int_distribution<std::size_t>(0, 2 * (kAll - kept) / (kKills - kill))(random);
        const std::size_t shown = killedAfter(with(cells, {"--out", pathOf("run")}), kept + more / 2);
        const CellStore store = CellStore::toWrite(pathOf("run"));
        EXPECT_GE(store.count(), shown) << "a verdict was reported that isn't there";
        EXPECT_GE(store.count(), kept);
        kept = store.count();
    }
    const Outcome last = keep("run", {}, cells);
    EXPECT_EQ(last.status, 0) << last.err;
    EXPECT_EQ(digestIn("run"), digest);
    EXPECT_EQ(CellStore::toRead(pathOf("run")).count(), kAll);
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("run/pictures")))
        EXPECT_THAT(entry.path().filename().string(), Not(testing::StartsWith("."))) << "half-written";
}

TEST_F(Keep, ARunThatIsTerminatedGoesOn) {
    const std::string digest = undisturbed();
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        const std::string folder = fmt::format("run{}", signal);
        const Running running(with(kCells, {"--out", pathOf(folder)}));
        running.workers(2);
        running.interrupt(signal);
        running.output();
        // It may have been through before.
        EXPECT_THAT(running.status(), testing::AnyOf(128 + signal, 0));
        EXPECT_EQ(keep(folder).status, 0);
        EXPECT_EQ(digestIn(folder), digest);
    }
}

TEST_F(Keep, AFolderTakesOneRunAtATime) {
    const Running running({"matrix", "--jobs", "2", "--frames", "0-59", "--out", pathOf("run")});
    const auto workers = running.workers(2);
    ASSERT_THAT(workers, SizeIs(2));
    expectRefused(keep("run"), "run: another run is at work there (process ");
    running.interrupt(SIGTERM);
    running.output();
    EXPECT_EQ(running.status(), 128 + SIGTERM);
    expectRefused(keep("run"), "other settings");
}

TEST_F(Keep, FailedCellsStayUntilTheyAreRetried) {
    const std::string digest = undisturbed();
    EXPECT_EQ(keep("run", {"--timeout", "1e-9"}).status, 3);
    EXPECT_EQ(keep("run", {"--timeout", "1e-9"}).status, 3);
    EXPECT_THAT(CellStore::toRead(pathOf("run")).countByVerdict(), Contains(testing::Pair("failed", 126u)));
    expectRefused(keep("run"), "timeout: 900 s, there 1e-09 s");
    const Outcome outcome = keep("run", {"--retry"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("run: 126 cells had failed; drawn again\n"));
    EXPECT_EQ(digestIn("run"), digest);
}

// ---- the disk fails

// The largest file that the process may have, as where a disk has no more room.
TEST_F(Keep, AFullDiskEndsTheRunWithWhatThereWasRoomFor) {
    const std::string digest = undisturbed();
    const std::string cells = fmt::format("{}", fmt::join(kCells, " "));
    const Outcome full = shell(fmt::format("ulimit -f 60; \"$1\" {} --out \"$2/run\"", cells));
    EXPECT_EQ(full.status, 2) << full.out;
    EXPECT_THAT(full.err,
                AllOf(HasSubstr("run: "), HasSubstr("what was kept stays, and the same command goes on")));
    EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
    const std::size_t kept = CellStore::toWrite(pathOf("run")).count();
    EXPECT_GT(kept, 0u);
    EXPECT_LT(kept, 126u);
    EXPECT_EQ(keep("run").status, 0);
    EXPECT_EQ(digestIn("run"), digest);
}

// A real one, of a file system of 300 KB in memory.
TEST_F(Keep, ADiskWithoutRoomAndOneThatIsReadOnlyAreTold) {
    if (shell("unshare -rm mount -t tmpfs none \"$2\"").status != 0)
        GTEST_SKIP() << "no file system may be mounted here";
    const std::string cells = fmt::format("{}", fmt::join(kCells, " "));
    const auto mounted = [&](const std::string& options, const std::string& commands) {
        return shell(fmt::format(
            "export program=\"$1\" folder=\"$2\"; unshare -rm bash -c \"mkdir $2/disk; mount -t tmpfs "
            "-o {} none $2/disk && {}\"",
            options, commands));
    };
    const Outcome full = mounted("size=300k", fmt::format("$1 {0} --out $2/disk/run", cells));
    EXPECT_EQ(full.status, 2) << full.out;
    EXPECT_THAT(full.err, HasSubstr("the disk is full"));
    std::filesystem::remove(pathOf("disk"));
    const Outcome closed = mounted("ro", fmt::format("$1 {} --out $2/disk/run", cells));
    EXPECT_EQ(closed.status, 2);
    EXPECT_THAT(closed.err, HasSubstr("disk/run: Read-only file system"));
}

TEST_F(Keep, ADamagedCellIsDrawnAgain) {
    keep("run");
    const std::string digest = digestIn("run");
    std::string content = contentOf(pathOf("run/run.sqlite"));
    const std::size_t at = content.find("\"method\":\"carmack\"");
    ASSERT_NE(at, std::string::npos);
    content[at + 12] = 'C';
    write("run/run.sqlite", content);
    const Outcome outcome = keep("run");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("run: 1 cell damaged; drawn again\n"));
    EXPECT_THAT(outcome.out, HasSubstr("125 of them from before"));
    EXPECT_EQ(digestIn("run"), digest);
}

TEST_F(Keep, AnAlteredShardIsNeitherMergedNorReported) {
    keep("run");
    for (const auto& [from, to] : {std::pair{"\"verdict\":\"exact\"", "\"verdict\":\"wrong\""},
                                   std::pair{"\"pixels\":768", "\"pixels\":769"}}) {
        const std::string good = contentOf(pathOf("run/run.sqlite"));
        std::string content = good;
        const std::size_t at = content.find(from);
        ASSERT_NE(at, std::string::npos);
        write("run/run.sqlite", content.replace(at, std::string(to).size(), to));
        expectRefused(run({"merge", pathOf("run"), "--out", pathOf("whole")}),
                      "is damaged; the command that drew it draws it again");
        expectRefused(run({"report", pathOf("run"), "-o", pathOf("page.html")}), " is damaged");
        write("run/run.sqlite", good);
    }
    EXPECT_EQ(run({"merge", pathOf("run"), "--out", pathOf("whole")}).status, 0);
}

// Two pointers of a page to its cells are exchanged, or one stands there twice: SQLite itself reads on.
TEST_F(Keep, AStoreWhoseOrderIsDamagedIsRefused) {
    keep("run");
    const std::string good = contentOf(pathOf("run/run.sqlite"));
    constexpr std::size_t kPage = 4096, kHeader = 8;
    constexpr char kLeaf = 13;
    int damaged = 0;
    for (std::size_t page = good.size() / 2 / kPage * kPage; page < good.size() && damaged < 4;
         page += kPage) {
        if (good[page] != kLeaf || good[page + 4] < 3) continue;
        for (const bool isExchange : {true, false}) {
            std::string content = good;
            for (std::size_t byte = 0; byte < 2; ++byte) {
                content[page + kHeader + 2 + byte] = good[page + kHeader + 4 + byte];
                if (isExchange) content[page + kHeader + 4 + byte] = good[page + kHeader + 2 + byte];
            }
            write("run/run.sqlite", content);
            expectRefused(keep("run"), "run: run.sqlite is damaged (");
            ++damaged;
        }
    }
    EXPECT_EQ(damaged, 4);
}

TEST_F(Keep, CellsWithoutTheirPicturesAreDrawnAgain) {
    keep("run");
    const std::string digest = digestIn("run");
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("run/pictures")))
        names.insert(entry.path().filename());
    std::filesystem::remove(pathOf("run/pictures/" + *names.begin()));
    expectRefused(run({"merge", pathOf("run"), "--out", pathOf("whole")}), "run: a picture of ");
    const Outcome outcome = keep("run");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, testing::ContainsRegex("run: [0-9]+ cells? without pictures; drawn again\n"));
    EXPECT_TRUE(std::filesystem::exists(pathOf("run/pictures/" + *names.begin())));
    EXPECT_EQ(digestIn("run"), digest);
}

// Nothing at all, as where both were made by a shell that has gone.
TEST_F(Keep, WithoutOutputsAStatusIsLeft) {
    EXPECT_EQ(shell("\"$1\" profiles >&- 2>&-").status, 2);
    EXPECT_EQ(shell("\"$1\" profiles >/dev/full 2>/dev/full").status, 2);
}

TEST_F(Keep, AFolderIsNoUri) {
    std::filesystem::current_path(std::filesystem::path(pathOf("")));
    const Outcome outcome = run(with(kCells, {"--out", "file:run?mode=ro"}));
    std::filesystem::current_path("/");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(CellStore::toRead(pathOf("file:run?mode=ro")).count(), 126u);
}

// Limits decide of nothing where no cell has failed by them.
TEST_F(Keep, LimitsMayDifferWhereNothingHasFailed) {
    keep("run");
    EXPECT_THAT(keep("run", {"--timeout", "77"}).out, HasSubstr("126 of them from before"));
    for (const char* index : {"1/2", "2/2"})
        keep(fmt::format("s{}", index[0]), {"--shard", index, "--timeout", fmt::format("10{}", index[0])});
    EXPECT_EQ(run({"merge", pathOf("s1"), pathOf("s2"), "--out", pathOf("whole")}).status, 0);
    EXPECT_EQ(digestIn("whole"), digestIn("run"));
}

TEST_F(Keep, ADamagedStoreIsRefused) {
    keep("run");
    const std::string content = contentOf(pathOf("run/run.sqlite"));
    write("run/run.sqlite", content.substr(0, content.size() / 2));
    expectRefused(keep("run"), "run: run.sqlite is damaged");
    write("run/run.sqlite", std::string(4096, 'x'));
    expectRefused(keep("run"), "run: run.sqlite is no store of gnomon");
}

// ---- the clock fails

TEST_F(Keep, AClockThatJumpsChangesNothing) {
    const std::string digest = undisturbed();
    setenv("LD_PRELOAD", GNOMON_JUMPING_CLOCK, 1);
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0:detect_leaks=0", 1);
    const Outcome outcome = keep("run", {"--timeout", "60"});
    unsetenv("LD_PRELOAD");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(digestIn("run"), digest);
    const std::string began = CellStore::toRead(pathOf("run")).sessions()[0].began;
    EXPECT_TRUE(began < "2001" || began > "2100") << "the clock did not jump: " << began;
}

// ---- what is reused

TEST_F(Keep, OnlyWhatHasChangedIsDrawnAgain) {
    const auto copy = [&](const std::string& from, const std::string& to, const std::string& old,
                          const std::string& now) {
        std::string text = contentOf(std::filesystem::path(GNOMON_SOURCE) / from);
        const std::size_t at = text.find(old);
        ASSERT_NE(at, std::string::npos);
        write(to, text.replace(at, old.size(), now));
    };
    const auto files = [&] {
        return keep("run", {},
                    {"matrix", "--scene", pathOf("mine.toml"), "--profile", pathOf("my.toml") + ",tnt",
                     "--size", "32x24", "--frames", "0"});
    };
    copy("scenes/boxes.toml", "mine.toml", "title", "title");
    copy("profiles/voodoo2.toml", "my.toml", "title", "title");
    EXPECT_EQ(files().status, 0);
    EXPECT_THAT(files().out, HasSubstr("42 of them from before"));
    // A comment is no content, nor is a title.
    copy("scenes/boxes.toml", "mine.toml", "title", "# nothing\ntitle");
    EXPECT_THAT(files().out, HasSubstr("42 of them from before"));
    copy("profiles/voodoo2.toml", "my.toml", "max_texture_size = { value = 256",
         "max_texture_size = { value = 128");
    const Outcome chip = files();
    EXPECT_THAT(chip.out, HasSubstr("21 of them from before"));
    EXPECT_THAT(
        chip.err,
        HasSubstr("run: 21 cells of which the program, the scene or the chip has changed; drawn again"));
    copy("scenes/boxes.toml", "mine.toml", "position = [0.67", "position = [0.77");
    const Outcome scene = files();
    EXPECT_THAT(scene.out, Not(HasSubstr("from before")));
    EXPECT_THAT(scene.err, HasSubstr("42 cells of which the program, the scene or the chip has changed"));
}

TEST_F(Keep, ALargerRunTakesWhatASmallerOneHas) {
    keep("small");
    const Words larger{"matrix", "--scene", "boxes,knot", "--profile", "ideal,voodoo2,tnt",
                       "--size", "32x24",   "--frames",   "0,30"};
    const std::string digest = undisturbed(larger);
    const Outcome outcome = keep("large", {"--reuse", pathOf("small")}, larger);
    EXPECT_THAT(outcome.out, HasSubstr("252 cells, 126 of them from before"));
    EXPECT_EQ(digestIn("large"), digest);
    const auto countOf = [&](const std::string& folder) {
        return std::distance(std::filesystem::directory_iterator(pathOf(folder)), {});
    };
    EXPECT_EQ(countOf("large/pictures"), countOf("undisturbed/pictures"));
}

// ---- determinism

TEST_F(Keep, DigestIsTheSameHoweverTheRunIsDrawn) {
    const Words cells{"matrix",
                      "--scene",
                      "boxes,knot",
                      "--profile",
                      "ideal,voodoo2,ps2,n64",
                      "--size",
                      "64x48",
                      "--frames",
                      "0",
                      "--fidelity",
                      "gl,chip",
                      "--method",
                      "carmack,roettger-screen,screen-texture,williams,auto"};
    const std::string digest = undisturbed(cells);
    std::set<std::string> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("undisturbed/pictures")))
        pictures.insert(entry.path().filename());
    const auto expectSame = [&](const std::string& folder) {
        EXPECT_EQ(digestIn(folder), digest) << folder;
        std::set<std::string> there;
        for (const auto& entry : std::filesystem::directory_iterator(pathOf(folder + "/pictures"))) {
            const std::string name = entry.path().filename();
            there.insert(name);
            EXPECT_EQ(contentOf(entry.path()), contentOf(pathOf("undisturbed/pictures/" + name))) << name;
        }
        EXPECT_EQ(there, pictures);
    };
    for (const char* jobs : {"1", "2"})
        for (const char* width : {"128", "256"}) {
            setenv("LP_NATIVE_VECTOR_WIDTH", width, 1);
            const std::string folder = fmt::format("jobs{}-width{}", jobs, width);
            EXPECT_EQ(keep(folder, {"--jobs", jobs}, cells).status, 0);
            expectSame(folder);
        }
    unsetenv("LP_NATIVE_VECTOR_WIDTH");
    for (int count = 1; count <= 4; ++count) {
        Words merge{"merge", "--out", pathOf(fmt::format("whole{}", count))};
        for (int index = count; index >= 1; --index) {
            const std::string folder = fmt::format("shard{}of{}", index, count);
            EXPECT_EQ(keep(folder, {"--shard", fmt::format("{}/{}", index, count)}, cells).status, 0);
            merge.push_back(pathOf(folder));
        }
        const Outcome merged = run(merge);
        EXPECT_EQ(merged.status, 0) << merged.err;
        EXPECT_THAT(merged.out, HasSubstr("; digest " + digest));
        expectSame(fmt::format("whole{}", count));
    }
    // And a run goes on with the whole as if it had drawn it.
    EXPECT_THAT(keep("whole4", {}, cells).out, HasSubstr("80 cells, 80 of them from before"));
}

TEST_F(Keep, ShardsAreBalancedByAnEarlierRun) {
    keep("past");
    for (const char* index : {"1/2", "2/2"})
        EXPECT_EQ(keep(fmt::format("s{}", index[0]), {"--shard", index, "--past", pathOf("past")}).status, 0);
    EXPECT_EQ(run({"merge", pathOf("s1"), pathOf("s2"), "--out", pathOf("whole")}).status, 0);
    EXPECT_EQ(digestIn("whole"), digestIn("past"));
    keep("blind", {"--shard", "2/2"});
    expectRefused(run({"merge", pathOf("s1"), pathOf("blind"), "--out", pathOf("other")}),
                  "blind: is of another run than ");
}

// ---- merge and report

TEST_F(Keep, AShardMayBeEmpty) {
    const Words one{"matrix", "boxes",  "--frames", "0",       "--profile",
                    "tnt",    "--size", "32x24",    "--shard", "2/2"};
    const Outcome outcome = keep("empty", {}, one);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("no cell is left for shard 2/2\n"), HasSubstr("empty: 0 cells; digest ")));
    EXPECT_EQ(run(with(one, {"--format", "json"})).out, "[]\n");
    expectRefused(run(with(one, {"--report", pathOf("page.html")})),
                  "--report: no cell is left for shard 2/2");
}

TEST_F(Keep, MergeRefusesWhatIsNotWhole) {
    for (const char* index : {"1/3", "2/3", "3/3"}) keep(fmt::format("s{}", index[0]), {"--shard", index});
    const auto merge = [&](const Words& shards) {
        Words words{"merge", "--out", pathOf("whole")};
        for (const std::string& shard : shards) words.push_back(pathOf(shard));
        return run(words);
    };
    expectRefused(merge({"s1", "s3"}), "shard 2/3 is missing");
    expectRefused(merge({"s1", "s2", "s3", "s2"}), "s2: is shard 2/3, as ");
    expectRefused(merge({"s1", "none"}), "none: no run is there");
    expectRefused(run({"merge", pathOf("s1"), "--out", pathOf("s1")}), "s1: is a shard itself");
    keep("half", {"--shard", "2/2"});
    expectRefused(merge({"s1", "half"}), "half: is shard 2/2, but ");
    EXPECT_FALSE(std::filesystem::exists(pathOf("whole")));

    EXPECT_EQ(merge({"s3", "s1", "s2"}).status, 0);
    EXPECT_EQ(merge({"s3", "s1", "s2"}).status, 0) << "again, as a job that was queued again does";
    const std::string digest = digestIn("whole");
    keep("other", {}, {"matrix", "boxes", "--size", "8x8", "--profile", "tnt", "--frames", "0"});
    expectRefused(run({"merge", pathOf("s1"), pathOf("s2"), pathOf("s3"), "--out", pathOf("other")}),
                  "other: another run is there");
    EXPECT_EQ(digestIn("whole"), digest);
}

TEST_F(Keep, ABrokenOffShardIsNotMergedNorReported) {
    keep("run");
    {
        CellStore store = CellStore::toWrite(pathOf("run"));
        store.remove({5, 6});
    }
    expectRefused(run({"merge", pathOf("run"), "--out", pathOf("whole")}),
                  "run: is not at its end: 124 of 126 cells are there");
    expectRefused(run({"report", pathOf("run"), "-o", pathOf("page.html")}),
                  "run: the run is not at its end: 124 of 126 cells are there");
}

TEST_F(Keep, AReportTakesAKeptRun) {
    const Outcome kept = keep("run", {"--format", "json"});
    write("run.json", kept.out);
    const Outcome compared = run({"report", pathOf("run.json"), pathOf("run")});
    EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
    EXPECT_EQ(run({"report", pathOf("run"), "-o", pathOf("page.html")}).status, 0);
    EXPECT_EQ(run({"report", pathOf("run.json"), "-o", pathOf("other.html")}).status, 0);
    EXPECT_EQ(contentOf(pathOf("page.html")), contentOf(pathOf("other.html")));
}

// Sparse files of 100 GB: nothing is read of them.
TEST_F(Keep, FilesBeyondAllMeasureAreRefused) {
    for (const char* name : {"huge.json", "huge.txt"}) {
        write(name, "");
        std::filesystem::resize_file(pathOf(name), 100'000'000'000);
    }
    expectRefused(run({"report", pathOf("huge.json"), "-o", pathOf("page.html")}),
                  "huge.json: 100000000000 bytes, more than the 4294967296 that gnomon reads");
    expectRefused(run({"check", "--expected", pathOf("huge.txt")}),
                  "huge.txt: 100000000000 bytes, more than the 268435456 that gnomon reads");
}

}  // namespace keep_test
}  // namespace gnomon
