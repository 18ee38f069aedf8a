// The matrix as text, JSON and CSV, from cells made by hand.

#include "report/matrix_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace matrix_report_test {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// One cell of each verdict on two chips, two methods and two frames, with words that need quoting.
std::vector<Cell> cells() {
    std::vector<Cell> all;
    for (const int frame : {0, 15}) {
        for (const char* method :
             {"roettger-screen", "roettger-alpha", "roettger-screen-max", "heidmann", "none"}) {
            for (const char* profile : {"ideal", "voodoo2"}) {
                Cell c;
                c.profile = profile, c.method = method, c.scene = "models/a, \"b\".ply";
                c.axes = findMethod(method)->axes;
                c.width = 320, c.height = 240, c.frame = frame, c.pixels = 76800;
                c.passes = {2, 4, 3, 0};
                c.verdict = Verdict::Exact;
                c.digest = "0123456789abcdef";
                const bool isIdeal = c.profile == "ideal";
                if (c.method == "heidmann" && isIdeal) c.chosen = true;
                if (c.method == "roettger-alpha" && !isIdeal)
                    c.verdict = Verdict::Refused,
                    c.missing = {
                        {"alpha_excludes_depth", "destination alpha beside depth", "MAME, \"one pipe\""}};
                if (c.method == "roettger-screen-max" && isIdeal && frame == 15)
                    c.verdict = Verdict::Edge, c.wrongEdge = 3, c.causes = {{"unexplained", 3}};
                if (c.method == "none")
                    c.verdict = Verdict::Wrong, c.wrongEdge = 10, c.wrongInterior = 30,
                    c.causes = {{"no shadow is drawn", 40}};
                if (c.method == "heidmann" && !isIdeal)
                    c.verdict = Verdict::Failed, c.error = "crashed: signal 11";
                all.push_back(c);
            }
        }
    }
    return all;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The columns of the line that starts with @p method: two blanks or more part them.
std::vector<std::string> rowOf(const std::string& text, const std::string& method) {
    for (const std::string& line : linesOf(text)) {
        if (!line.starts_with(method + "  ")) continue;
        std::vector<std::string> columns;
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = std::min(line.find("  ", at), line.size());
            columns.push_back(line.substr(at, end - at));
            at = std::min(line.find_first_not_of(' ', end), line.size());
        }
        return columns;
    }
    return {};
}

/// A reader of CSV by the rules of RFC 4180.
std::vector<std::vector<std::string>> readCsv(const std::string& text) {
    std::vector<std::vector<std::string>> records{{""}};
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string& field = records.back().back();
        if (quoted && text[i] == '"' && text[i + 1] == '"')
            field += text[++i];
        else if (text[i] == '"')
            quoted = !quoted;
        else if (quoted)
            field += text[i];
        else if (text[i] == ',')
            records.back().push_back("");
        else if (text.substr(i, 2) == "\r\n")
            records.push_back({""}), ++i;
        else
            field += text[i];
    }
    records.pop_back();
    return records;
}

TEST(MatrixText, HasNoEmptyCell) {
    const std::string text = matrixText(cells());
    EXPECT_THAT(rowOf(text, "method"), ElementsAre("method", "ideal", "voodoo2"));
    for (const char* method :
         {"roettger-screen", "roettger-alpha", "roettger-screen-max", "heidmann", "none"})
        EXPECT_THAT(rowOf(text, method), AllOf(SizeIs(3), Each(Not(IsEmpty())))) << method;
}

TEST(MatrixText, ShowsVerdictWrongPixelsPassesAndPath) {
    const std::string text = matrixText(cells());
    EXPECT_THAT(rowOf(text, "roettger-screen"), ElementsAre("roettger-screen", "exact 2/3", "exact 2/3"));
    EXPECT_EQ(rowOf(text, "heidmann").at(1), "exact 2/3*");
    EXPECT_EQ(rowOf(text, "none").at(1), "WRONG 80 2/3") << "the frames' wrong pixels add up";
    EXPECT_EQ(rowOf(text, "roettger-screen-max").at(1), "edge 3 2/3") << "the worst frame counts";
    EXPECT_THAT(rowOf(text, "roettger-alpha").at(2), testing::StartsWith("- "));
    EXPECT_THAT(rowOf(text, "heidmann").at(2), testing::StartsWith("FAILED"));
}

TEST(MatrixText, SpellsOutRefusalsFailuresAndCauses) {
    EXPECT_THAT(matrixText(cells()),
                AllOf(HasSubstr("destination alpha beside depth"), HasSubstr("MAME, \"one pipe\""),
                      HasSubstr("crashed: signal 11"), HasSubstr("none: no shadow is drawn: 80"),
                      HasSubstr("frames 0 15"), HasSubstr("320x240")));
}

TEST(MatrixText, SetsATableForEachSceneAndSize) {
    std::vector<Cell> all = cells();
    for (Cell c : cells()) c.scene = "boxes", all.push_back(c);
    for (Cell c : cells()) c.width = 64, all.push_back(c);
    int heads = 0;
    for (const std::string& line : linesOf(matrixText(all))) heads += line.starts_with("method  ");
    EXPECT_EQ(heads, 3);
}

/// Cells of one frame: chips @p ids, of which those with a name of the same first letter do everything alike.
std::vector<Cell> cellsOf(const std::vector<std::string>& ids) {
    std::vector<Cell> all;
    for (const char* method : {"roettger-screen", "heidmann"})
        for (const std::string& id : ids) {
            Cell c;
            c.profile = id, c.method = method, c.scene = "boxes", c.axes = findMethod(method)->axes;
            c.width = 320, c.height = 240, c.passes = {2, 4, 3, 0};
            c.verdict = c.method == "heidmann" ? Verdict::Refused : Verdict::Wrong;
            if (c.verdict == Verdict::Refused)
                c.missing = {{"stencil_bits", "stencil", "source of " + id}};
            else
                c.wrongInterior = id[0], c.causes = {{"rounding", id[0]}};
            all.push_back(c);
        }
    return all;
}

TEST(MatrixText, FoldsChipsThatAreAlikeInEveryRow) {
    const std::string text = matrixText(cellsOf({"tnt", "voodoo1", "tnt2", "voodoo2", "voodoo3", "xbox"}));
    EXPECT_THAT(rowOf(text, "method"), ElementsAre("method", "tnt +1", "voodoo1 +2", "xbox"));
    EXPECT_THAT(rowOf(text, "roettger-screen"),
                ElementsAre("roettger-screen", "WRONG 116 2/3", "WRONG 118 2/3", "WRONG 120 2/3"));
    EXPECT_THAT(text, AllOf(HasSubstr("\n  tnt +1: tnt tnt2\n"),
                            HasSubstr("\n  voodoo1 +2: voodoo1 voodoo2 voodoo3\n")));
}

TEST(MatrixText, DoesNotFoldChipsThatDifferInOneRow) {
    auto all = cellsOf({"voodoo1", "voodoo2"});
    all.back().missing.push_back({"depth_bits", "a depth buffer", "nobody"});
    EXPECT_THAT(rowOf(matrixText(all), "method"), ElementsAre("method", "voodoo1", "voodoo2"));
    EXPECT_THAT(matrixText(all), Not(HasSubstr("alike")));
}

TEST(MatrixText, GoesOnInAFurtherBlockWhereItIsTooWide) {
    std::vector<std::string> ids;
    for (char letter = 'a'; letter <= 'z'; ++letter) ids.push_back(letter + std::string("-chip"));
    const std::string text = matrixText(cellsOf(ids));
    std::vector<std::string> heads;
    std::size_t widest = 0;
    int blocks = 0;
    for (const std::string& line : linesOf(text)) {
        widest = std::max(widest, line.size());
        if (!line.starts_with("method  ")) continue;
        ++blocks;
        for (std::string id : rowOf(line + "\n", "method"))
            if (id != "method") heads.push_back(id);
    }
    EXPECT_EQ(heads, ids) << "each once, in order";
    EXPECT_LE(widest, 100u);
    EXPECT_GT(widest, 85u) << "as few blocks as will do";
    EXPECT_EQ(blocks, 6);
}

TEST(MatrixText, KeepsAColumnThatIsWiderThanABlock) {
    const std::string id(200, 'x');
    EXPECT_THAT(rowOf(matrixText(cellsOf({id})), "method"), ElementsAre("method", id));
}

TEST(MatrixText, NamesTheOthersWhereNearlyAllChipsAreMeant) {
    std::vector<std::string> ids{"ideal"};
    for (int i = 1; i <= 9; ++i) ids.push_back("chip" + std::to_string(i));
    auto all = cellsOf(ids);
    for (Cell& c : all)
        for (Missing& m : c.missing) m.source = c.profile == "ideal" ? "itself" : "not in the profile";
    EXPECT_THAT(matrixText(all),
                AllOf(HasSubstr(" all but ideal: not in the profile\n"), HasSubstr(" ideal: itself\n")));
}

TEST(MatrixText, NamesCausesByTheHeadsOfColumns) {
    auto all = cellsOf({"tnt", "voodoo1", "tnt2", "voodoo2", "xbox"});
    EXPECT_THAT(matrixText(all), AllOf(HasSubstr("roettger-screen: rounding: 116 (tnt +1)\n"),
                                       HasSubstr("roettger-screen: rounding: 120 (xbox)\n")));
    all[0].causes = {{"dither", 116}};  // the same verdict for another reason
    EXPECT_THAT(matrixText(all),
                AllOf(HasSubstr("dither: 116 (tnt)\n"), HasSubstr("rounding: 116 (tnt2)\n")));
}

// Each footnote once, however many tables, blocks and chips it stands for.
TEST(MatrixText, SaysEachNoteOnce) {
    std::vector<std::string> ids;
    for (char letter = 'a'; letter <= 'z'; ++letter) ids.push_back(letter + std::string("-chip"));
    auto all = cellsOf(ids);
    for (Cell c : cellsOf(ids)) c.scene = "knot", all.push_back(c);
    const std::string text = matrixText(all);
    int notes = 0;
    for (const std::string& line : linesOf(text)) notes += line == "  a  stencil";
    EXPECT_EQ(notes, 1);
}

TEST(MatrixText, TellsShadesApart) {
    std::vector<Cell> all = cells();
    for (Cell c : cells()) c.axes.shade = Shade::Black, c.verdict = Verdict::Exact, all.push_back(c);
    EXPECT_THAT(rowOf(matrixText(all), "none"), SizeIs(3));
    EXPECT_THAT(matrixText(all), HasSubstr("\nroettger-screen black  "));
}

/// cells(), with a warning that depends on the frame for what doubles, and one for a chip.
std::vector<Cell> cellsWithWarnings() {
    std::vector<Cell> all = cells();
    for (Cell& c : all) {
        if (c.verdict == Verdict::Refused) continue;
        if (c.axes.arithmetic == Arithmetic::Double)
            c.warnings = {c.frame == 0 ? "resolves 2 levels; up to 9 volumes or fronts may nest"
                                       : "resolves 2 levels; up to 12 volumes or fronts may nest"};
        if (c.method == "roettger-screen-max" && c.profile == "voodoo2" && c.frame == 15)
            c.nesting = {.fronts = 14, .overlap = 11, .levels = 12},
            c.warnings = {"resolves 5 levels in 5 bits; up to 12 volumes or fronts may nest"};
    }
    return all;
}

TEST(MatrixText, WarnsOnceOfTheDeepestNestingForAllMethodsChipsAndFrames) {
    const std::vector<std::string> lines = linesOf(matrixText(cellsWithWarnings()));
    const auto head = std::find(lines.begin(), lines.end(), "Volumes may nest too deep");
    ASSERT_NE(head, lines.end());
    EXPECT_EQ(head[1],
              "  roettger-screen, roettger-alpha: resolves 2 levels; up to 12 volumes or fronts may nest");
    EXPECT_EQ(head[2] + head[3].substr(4),
              "  roettger-screen-max: resolves 5 levels in 5 bits; up to 12 volumes or fronts may nest "
              "(frame 15; voodoo2)");
    EXPECT_EQ(head[4], "");
}

TEST(MatrixText, SaysNothingOfNestingWithoutWarnings) {
    EXPECT_THAT(matrixText(cells()), Not(HasSubstr("nest")));
}

TEST(MatrixJson, HasOneObjectPerCell) {
    const auto json = nlohmann::json::parse(matrixJson(cells()));
    ASSERT_TRUE(json.is_array());
    ASSERT_EQ(json.size(), cells().size());
    for (std::size_t i = 0; i < json.size(); ++i) EXPECT_EQ(json[i]["cell"], cells()[i].id());
}

TEST(MatrixJson, IsAnEmptyArrayWithoutCells) {
    EXPECT_EQ(nlohmann::json::parse(matrixJson({})).dump(), "[]");
}

TEST(MatrixCsv, HasAsManyFieldsInEachLineAsInItsHead) {
    const auto records = readCsv(matrixCsv(cells()));
    ASSERT_EQ(records.size(), cells().size() + 1);
    EXPECT_THAT(records, Each(SizeIs(records[0].size())));
    EXPECT_GT(records[0].size(), 30u);
}

TEST(MatrixCsv, PutsEachValueUnderItsHead) {
    const std::vector<Cell> cells = cellsWithWarnings();
    const auto records = readCsv(matrixCsv(cells));
    const auto field = [&](std::size_t cell, const std::string& head) {
        const auto at = std::find(records[0].begin(), records[0].end(), head);
        return at == records[0].end() ? "no " + head
                                      : records[cell + 1][std::size_t(at - records[0].begin())];
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell c = cells[i];
        EXPECT_EQ(field(i, "cell"), c.id());
        EXPECT_EQ(field(i, "verdict"), name(c.verdict));
        EXPECT_EQ(field(i, "wrong_edge"), std::to_string(c.wrongEdge));
        EXPECT_EQ(field(i, "wrong_interior"), std::to_string(c.wrongInterior));
        EXPECT_EQ(field(i, "nesting_fronts"), std::to_string(c.nesting.fronts));
        EXPECT_EQ(field(i, "nesting_overlap"), std::to_string(c.nesting.overlap));
        EXPECT_EQ(field(i, "nesting_levels"), std::to_string(c.nesting.levels));
        EXPECT_EQ(field(i, "warnings"), c.warnings.empty() ? "" : c.warnings[0]);
        EXPECT_EQ(field(i, "passes_rectangle"), "3");
        EXPECT_EQ(field(i, "chosen"), c.chosen ? "true" : "false");
        EXPECT_EQ(field(i, "digest"), c.digest);
        EXPECT_EQ(field(i, "error"), c.error);
    }
    EXPECT_EQ(field(3, "missing"), "destination alpha beside depth");
    EXPECT_EQ(field(8, "causes"), "no shadow is drawn 40");
}

}  // namespace matrix_report_test
}  // namespace gnomon
