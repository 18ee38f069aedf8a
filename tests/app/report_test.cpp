// gnomon report and matrix --report, as a user runs them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/program.h"
#include "report/deflate.h"
#include "report/unpack.h"

namespace gnomon {
namespace report_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

/// The content of a data block of a page.
std::string blockOf(const std::string& page, const std::string& id) {
    const std::string begin = fmt::format("id=\"gnomon-{}\">", id);
    const std::size_t at = page.find(begin);
    if (at == std::string::npos) return "no block";
    const std::size_t from = at + begin.size();
    return page.substr(from, page.find("</script>", from) - from);
}

/// The run that stands in a page.
Json runOf(const std::string& page) {
    const Json head = Json::parse(blockOf(page, "head"));
    return Json::parse(inflated(fromBase64(blockOf(page, "run")), head.at("run").at("length")));
}

class ReportCommand : public ProgramTest {
  protected:
    const std::vector<std::string> kSmall{"matrix",    "boxes",
                                          "--profile", "ideal,voodoo2,ps1",
                                          "--method",  "none,carmack,roettger-screen,williams",
                                          "--size",    "48x36",
                                          "--frames",  "0,10"};
    /// A small run, as JSON.
    const std::string& smallRun() const {
        if (m_run.empty()) m_run = newRun();
        return m_run;
    }
    /// The same once more, with other times.
    std::string newRun() const {
        auto arguments = kSmall;
        arguments.insert(arguments.end(), {"--format", "json"});
        return run(arguments).out;
    }
    std::string page(const std::string& name) const { return contentOf(pathOf(name)); }

  private:
    mutable std::string m_run{};
};

TEST_F(ReportCommand, WritesThePageThatTheMatrixWrites) {
    auto arguments = kSmall;
    arguments.insert(arguments.end(), {"--format", "json", "--report", pathOf("a.html")});
    const Outcome matrix = run(arguments);
    ASSERT_EQ(matrix.status, 0) << matrix.err;
    const std::string file = write("run.json", matrix.out);
    for (const char* jobs : {"1", "2"}) {
        const Outcome report = run({"report", file, "-o", pathOf("b.html"), "--jobs", jobs});
        EXPECT_EQ(report.status, 0) << report.err;
        EXPECT_EQ(report.out, "");
        EXPECT_EQ(page("a.html"), page("b.html"));
    }
    EXPECT_THAT(leftBehind(), testing::UnorderedElementsAre("a.html", "b.html", "run.json"));
}

TEST_F(ReportCommand, PutsItsDataWhereThePageReadsIt) {
    ASSERT_EQ(run({"report", write("run.json", smallRun()), "-o", pathOf("a.html")}).status, 0);
    const std::string html = page("a.html");
    EXPECT_THAT(html, Not(HasSubstr("<!-- gnomon:data -->")));
    const Json head = Json::parse(blockOf(html, "head")), run = runOf(html);
    EXPECT_EQ(run.at("format"), 1);
    EXPECT_EQ(
        run.at("command"),
        "gnomon matrix boxes --profile ideal,voodoo2,ps1 --method none,carmack,roettger-screen,williams "
        "--size 48x36 --frames 0,10");
    EXPECT_EQ(run.at("cells").at("count"), 24);
    EXPECT_EQ(run.at("profiles").size(), 3u);
    EXPECT_GT(run.at("profiles")[1].at("limits").size(), 20u);
    EXPECT_EQ(run.at("scenes").dump(), R"([{"id":"boxes","frames":[0,10]}])");
    EXPECT_EQ(run.at("compare"), nullptr);
    EXPECT_FALSE(run.at("states").empty());
    for (const auto& [name, column] : run.at("cells").at("columns").items())
        EXPECT_EQ(column.at("values").size(), 24u) << name;

    // Every picture lies in its chunk, every chunk inflates to its length.
    const std::string bytes = fromBase64(blockOf(html, "pictures"));
    std::vector<std::size_t> lengths;
    for (const Json& chunk : head.at("chunks")) {
        const std::size_t length = chunk.at("length");
        EXPECT_NE(inflated(bytes.substr(chunk.at("offset"), chunk.at("size")), length), "broken");
        lengths.push_back(length);
    }
    for (const Json& p : run.at("pictures")) {
        const auto size =
            std::size_t(p.at("planes")) * std::size_t(p.at("width")) * std::size_t(p.at("height"));
        EXPECT_LE(std::size_t(p.at("offset")) + size, lengths.at(p.at("chunk")));
    }
}

// JSON and CSV have every column of the page's cells; of those, drawings and plans are other commands'.
TEST_F(ReportCommand, ShowsNothingThatJsonAndCsvLack) {
    const std::string json = smallRun();
    ASSERT_EQ(run({"report", write("run.json", json), "-o", pathOf("a.html")}).status, 0);
    auto arguments = kSmall;
    arguments.insert(arguments.end(), {"--format", "csv"});
    const std::string csv = run(arguments).out;
    const std::string head = fmt::format(",{},", csv.substr(0, csv.find("\r\n")));
    const Json cells = Json::parse(json), shown = runOf(page("a.html")).at("cells");
    for (const auto& [name, column] : shown.at("columns").items()) {
        if (name == "drawing" || name == "plan") continue;
        std::string flat = name;
        std::replace(flat.begin(), flat.end(), '.', '_');
        EXPECT_THAT(head, HasSubstr(fmt::format(",{},", flat))) << "CSV";
        std::string pointer = fmt::format("/{}", name);
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Json& value = column.at("values")[i];
            const Json here =
                column.contains("dictionary") ? column["dictionary"][std::size_t(value)] : value;
            const Json::json_pointer at(pointer);
            EXPECT_EQ(cells[i].contains(at) ? cells[i].at(at) : Json(), here) << name;
        }
    }
}

TEST_F(ReportCommand, PrintsAsJsonAllThatThePageSays) {
    const std::string file = write("run.json", smallRun());
    const Outcome outcome = run({"report", file, "--format", "json", "-o", pathOf("a.html")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json words = Json::parse(outcome.out), shown = runOf(page("a.html")),
               cells = Json::parse(smallRun());
    for (const char* key : {"command", "profiles", "methods", "scenes", "causes", "states"})
        EXPECT_EQ(words.at(key), shown.at(key)) << key;
    ASSERT_EQ(words.at("cells").size(), cells.size());
    const Json& plans = shown.at("cells").at("columns").at("plan");
    for (std::size_t i = 0; i < cells.size(); ++i) {
        Json cell = words.at("cells")[i];
        EXPECT_EQ(cell.value("plan", ""), plans.at("dictionary")[std::size_t(plans.at("values")[i])]);
        cell.erase("plan");
        EXPECT_EQ(cell, cells[i]);
    }
    EXPECT_EQ(run({"report", file, "--format", "json"}).out, outcome.out) << "without a page";
}

TEST_F(ReportCommand, KeepsToItsLimit) {
    const std::string file = write("run.json", smallRun());
    ASSERT_EQ(run({"report", file, "-o", pathOf("a.html")}).status, 0);
    const std::size_t whole = page("a.html").size();
    const std::size_t less = whole - 1500;
    ASSERT_EQ(run({"report", file, "-o", pathOf("a.html"), "--limit", fmt::format("{}", double(less) / 1e6)})
                  .status,
              0);
    EXPECT_LE(page("a.html").size(), less);
    const Json run1 = runOf(page("a.html"));
    std::set<bool> strips;
    for (const Json& drawing : run1.at("drawings")) strips.insert(drawing.at("strip").empty());
    EXPECT_EQ(strips, (std::set<bool>{false, true}));
    expectRefused(run({"report", file, "-o", pathOf("b.html"), "--limit", "0.001"}),
                  "--limit: the report takes ");
    EXPECT_THAT(leftBehind(), Not(testing::Contains("b.html")));
}

TEST_F(ReportCommand, DrawsCellsAgainFromTheirRecordsAlone) {
    const std::vector<std::vector<std::string>> runs{
        {"--light", "2,5,1,1", "--eye", "6,4,5", "--target", "0,1,0", "--fov", "40", "--near", "0.3"},
        {"--fidelity", "gl,chip", "--dither", "on"},
        {"--fidelity", "chip", "--blend-unit", "voodoo_86box"},
        {"--method", "auto,williams", "--map-size", "128"},
        {"--effects", "needed"},
        {"--method", "screen-count", "--start", "middle", "--shade", "black,ambient"},
        {"--store", "stencil", "--caps", "away", "--clip", "none", "--count", "zfail", "--offset", "0.01"}};
    for (const auto& options : runs) {
        std::vector<std::string> arguments{"matrix",   "boxes", "--profile", "ideal,voodoo2",
                                           "--size",   "40x30", "--frames",  "0",
                                           "--format", "json",  "--method"};
        arguments.pop_back();
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome matrix = run(arguments);
        ASSERT_EQ(matrix.status, 0) << matrix.err;
        const Outcome report = run({"report", write("run.json", matrix.out), "-o", pathOf("a.html")});
        EXPECT_EQ(report.status, 0) << report.err;
        EXPECT_FALSE(runOf(page("a.html")).at("drawings").empty());
    }
}

// The page is written all the same, and marks the cell.
TEST_F(ReportCommand, SaysWhichCellComesOutOtherwise) {
    const std::string good = write("good.json", smallRun());
    std::string text = smallRun();
    const std::size_t at =
        text.find("\"digest\":\"", text.find("voodoo2/roettger-screen/boxes/48x36/0\"")) + 10;
    text.replace(at, 16, "0000000000000000");
    const std::string bad = write("run.json", text);
    const Outcome outcome = run({"report", bad, "-o", pathOf("a.html")});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, testing::MatchesRegex(
                                 ".*run.json:[0-9]+: voodoo2/roettger-screen/boxes/48x36/0: drawn again, it "
                                 "differs from the run in digest\n"));
    int marked = 0;
    const Json shown = runOf(page("a.html"));
    for (const Json& drawing : shown.at("drawings"))
        if (drawing.contains("differs")) {
            EXPECT_EQ(drawing.at("differs"), Json({"digest"}));
            ++marked;
        }
    EXPECT_EQ(marked, 1);
    const Outcome compared = run({"report", good, bad, "-o", pathOf("b.html")});
    EXPECT_EQ(compared.status, 3);
    EXPECT_THAT(compared.out, HasSubstr("24 cells before, 24 after: 1 differ\n"));
    EXPECT_THAT(compared.err, HasSubstr("drawn again, it differs"));
}

TEST_F(ReportCommand, FindsFilesByTheirNames) {
    std::filesystem::create_directory(pathOf("there"));
    std::filesystem::create_directory(pathOf("here"));
    const std::string mesh = write("there/it's a tent.obj",
                                   "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0.3 1 0.3\n"
                                   "f 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
    const Outcome matrix = run({"matrix", mesh, "--profile", "ideal", "--method", "carmack", "--size",
                                "32x24", "--frames", "0", "--format", "json"});
    ASSERT_EQ(matrix.status, 0) << matrix.err;
    const std::string file = write("run.json", matrix.out);
    std::filesystem::rename(mesh, pathOf("here/it's a tent.obj"));
    const Outcome lost = run({"report", file, "-o", pathOf("a.html")});
    EXPECT_EQ(lost.status, 2);
    EXPECT_THAT(lost.err, AllOf(HasSubstr("run.json:1: "), HasSubstr("--scene FILE says where it is\n")));
    const Outcome found =
        run({"report", file, "--scene", pathOf("here/it's a tent.obj"), "-o", pathOf("a.html")});
    EXPECT_EQ(found.status, 0) << found.err;
    const Json shown = runOf(page("a.html"));
    EXPECT_EQ(shown.at("drawings").size(), 1u);
    EXPECT_EQ(shown.at("command"), fmt::format("gnomon matrix '{}' --profile ideal --method carmack --size "
                                               "32x24",
                                               pathOf("there/it'\\''s a tent.obj")))
        << "as the shell takes it";
}

TEST_F(ReportCommand, RefusesBadFilesInOneLine) {
    const std::string good = write("run.json", smallRun()), html = pathOf("a.html");
    expectRefused(run({"report", good}), "-o: ");
    expectRefused(run({"report", good, "-o", pathOf("a.txt")}), "a report's name ends in .html");
    expectRefused(run({"report", good, "-o", pathOf("none/a.html")}), "no folder");
    expectRefused(run({"report", good, "--format", "csv", "-o", html}), "--format");
    expectRefused(run({"report", good, good, good}), "a third run");
    expectRefused(run({"report", pathOf("none.json"), "-o", html}), "none.json: no such file");
    expectRefused(run({"report", pathOf(""), "-o", html}), "is a folder");
    expectRefused(run({"report", write("e.json", ""), "-o", html}), "e.json:1: an empty file");
    expectRefused(run({"report", write("t.json", smallRun().substr(0, 3000)), "-o", html}), "t.json:");
    expectRefused(run({"report", write("run.html", smallRun()), "-o", pathOf("run.html")}),
                  "is the run itself");
    expectRefused(run({"report", good, "-o", html, "--limit", "0"}), "--limit");

    const auto changed = [&](const std::string& what, const std::string& to) {
        std::string text = smallRun();
        for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += to.size())
            text.replace(at, what.size(), to);
        return write("c.json", text);
    };
    expectRefused(run({"report", changed("voodoo2", "voodoo9"), "-o", html}), "c.json:2: ");
    expectRefused(run({"report", changed("boxes", "crates"), "-o", html}), "c.json:1: ");
    expectRefused(run({"report", changed("\"frame\":10", "\"frame\":999"), "-o", html}), "c.json:");
    EXPECT_THAT(leftBehind(), Not(testing::Contains("a.html")));
    expectRefused(run({"matrix", "boxes", "--report", pathOf("none/a.html")}), "no folder");
}

TEST_F(ReportCommand, TellsWhatHasChanged) {
    const std::string text = smallRun();
    const std::string before = write("old.json", text);
    Outcome same = run({"report", before, write("new.json", newRun())});
    EXPECT_EQ(same.status, 0) << same.err;
    EXPECT_EQ(same.out, "24 cells before, 24 after: no answer has changed\n");

    Json cells = Json::parse(text);
    cells[0]["verdict"] = "exact", cells[0]["wrong"] = {{"edge", 0}, {"interior", 0}},
    cells[0]["causes"] = Json::object();
    cells[6]["passes"]["copy"] = 7;
    cells.erase(cells.size() - 1);
    const std::string after = write("after.json", cells.dump());
    const Outcome changed = run({"report", before, after});
    EXPECT_EQ(changed.status, 1);
    EXPECT_THAT(changed.out, HasSubstr("24 cells before, 23 after: "));
    EXPECT_THAT(changed.out, HasSubstr("only in the old run (1 cell)"));
    EXPECT_THAT(changed.out, HasSubstr("passes.copy 0 -> 7"));
    const Json json = Json::parse(run({"report", before, after, "--format", "json"}).out);
    EXPECT_EQ(json.at("old").at("cells"), 24);
    EXPECT_THAT(run({"report", before, after, "--format", "csv"}).out, HasSubstr("passes.copy,0,7"));
    const Outcome paged = run({"report", before, before, "-o", pathOf("same.html")});
    EXPECT_EQ(paged.status, 0) << paged.err;
    EXPECT_TRUE(runOf(page("same.html")).at("compare").at("changes").empty());
    EXPECT_EQ(run({"report", after, before, "-o", pathOf("change.html")}).status, 1);
    const Outcome altered = run({"report", before, after, "-o", pathOf("change.html")});
    EXPECT_EQ(altered.status, 3) << "the drawn one of the altered cells comes out as before";
    EXPECT_THAT(altered.err, testing::EndsWith(" drawn again, it differs from the run in passes.copy\n"));
    EXPECT_EQ(runOf(page("change.html")).at("compare").at("changes"), json.at("changes"));
}

}  // namespace report_test
}  // namespace gnomon
