// What proofs say to people: verdicts, paragraphs, tables.

#include "report/prove_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace prove_report_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

/// A row of a chip "c" with the proof @p proof.
ProofRow rowOf(const MaskProof& proof, int bits = 8, DrawOrder order = DrawOrder::Volume,
               MaskArithmetic arithmetic = MaskArithmetic::Double) {
    ProofRow row{.profile = "c", .store = "screen", .format = "8888", .claim = {}, .proof = proof};
    row.claim = {{BlendUnit::VoodooMame, bits}, arithmetic, order};
    return row;
}

MaskProof reaching(std::optional<int> depth, std::optional<int> volumes) {
    MaskProof proof;
    proof.depth = depth;
    proof.volumes = volumes;
    proof.drift = {{1, 0, 0}, {64, 0, 0}};
    return proof;
}

TEST(VerdictOf, SaysHowFarAProofReaches) {
    EXPECT_EQ(verdictOf(rowOf(reaching(std::nullopt, std::nullopt))), "exact, half = 128");
    EXPECT_EQ(verdictOf(rowOf(reaching(5, 5))), "up to 5 open, half = 128");
    EXPECT_EQ(verdictOf(rowOf(reaching(0, 3))), "up to 3 in all, half = 128");
    EXPECT_EQ(verdictOf(rowOf(reaching(0, 0))), "never, half = 128");
    EXPECT_EQ(verdictOf(rowOf(reaching(-1, -1))), "never, half = 128");
    EXPECT_EQ(verdictOf(rowOf(reaching(2, 2), 8, DrawOrder::Volume, MaskArithmetic::Count)), "up to 2 open");
}

TEST(VerdictOf, SaysWhatTheOtherConstantReaches) {
    MaskProof proof = reaching(6, 6);
    proof.otherHalf = MaskProof::Reach{5, 5};
    EXPECT_EQ(verdictOf(rowOf(proof)), "up to 6 open, half = 128 (127: up to 5 open)");
    proof.choice.half = 127;
    EXPECT_EQ(verdictOf(rowOf(proof)), "up to 6 open, half = 127 (128: up to 5 open)");
}

// Only where all but the whole cycle is told apart is it exact modulo the cycle.
TEST(VerdictOf, SaysExactModuloOnlyOfAWholeCycle) {
    MaskProof proof = reaching(255, 255);
    proof.period = 256;
    EXPECT_THAT(verdictOf(rowOf(proof, 8, DrawOrder::Volume, MaskArithmetic::Count)),
                StartsWith("exact modulo 256, in any order"));
    proof.depth = 127;
    EXPECT_EQ(verdictOf(rowOf(proof, 8, DrawOrder::Volume, MaskArithmetic::Count)), "up to 127 open");
}

TEST(VerdictOf, SaysWhatIsMissing) {
    ProofRow row;
    row.refused = "destination alpha";
    EXPECT_EQ(verdictOf(row), "refused: destination alpha");
}

// Widths with one result share it; of units that disagree the one that reaches least is told.
TEST(ShowProofs, TellsEachWidthAndTheWorstOfItsUnits) {
    ProofRow other = rowOf(reaching(3, 3), 5);
    other.claim.channel.unit = BlendUnit::Voodoo86Box;
    const std::string text = showProofs(
        {rowOf(reaching(5, 5), 5), other, rowOf(reaching(6, 6), 6), rowOf(reaching(6, 6), 8)}, Format::Text);
    EXPECT_THAT(text,
                StartsWith("c screen double\n  half = 128: volume up to 3 open in 5 bits, up to 6 open in 6 "
                           "and 8 bits; no drift\n"));
}

TEST(ShowProofs, TellsTheDriversModeApart) {
    ProofRow off = rowOf(reaching(std::nullopt, std::nullopt), 5), dithered = rowOf(reaching(1, 1), 5);
    dithered.claim.channel.dither = DitherMode::Matrix4x4Subtract;
    dithered.isDefaultDither = true;
    dithered.proof->drift = {{1, -1, 0}, {64, -1, 8}};
    const std::string text = showProofs({dithered, off}, Format::Text);
    EXPECT_THAT(text, HasSubstr("  dither off, half = 128: volume exact; no drift\n"));
    EXPECT_THAT(text,
                HasSubstr("  dither 4x4_subtract, the driver's default, half = 128: volume up to 1 open; "
                          "drifts by -1..8\n      codes in 64 volumes\n"));
}

TEST(ShowProofs, TellsLevelsInRuns) {
    std::vector<ProofRow> rows{rowOf(reaching(std::nullopt, std::nullopt))};
    for (const int levels : {1, 2, 3, 4}) {
        rows.push_back(rowOf(levels == 1 ? reaching(1, 1) : reaching(std::nullopt, std::nullopt)));
        rows.back().levels = levels;
    }
    const std::string text = showProofs(rows, Format::Text);
    EXPECT_THAT(text, HasSubstr("    8 bits, volume by levels: 1: up to 1 open; 2 to 4: exact\n"));
    // The figures are those of the best start.
    const std::string table = text.substr(text.find("\nprofile"));
    EXPECT_EQ(
        std::count(table.begin(), table.end(), '\n') -
            std::count(table.begin() + static_cast<std::ptrdiff_t>(table.find("\n\n")), table.end(), '\n'),
        3 /* head, rule, one row */);
    EXPECT_EQ(Json::parse(showProofs(rows, Format::Json)).size(), 5u);
}

// With levels asked for there is no best start, and theirs are the figures.
TEST(ShowProofs, ShowsTheLevelsThatWereAskedFor) {
    ProofRow row = rowOf(reaching(2, 2));
    row.levels = 2;
    const std::string text = showProofs({row}, Format::Text);
    EXPECT_THAT(text, StartsWith("c screen double\n  half = 128: volume up to 2 open; no drift\n"));
    EXPECT_THAT(text, Not(HasSubstr("by levels:")));
    EXPECT_THAT(text, HasSubstr("c        screen"));
}

TEST(ShowProofs, WritesEveryFieldAsJsonAndCsv) {
    MaskProof proof = reaching(2, 2);
    proof.counterexample = Counterexample{"DDDHH", {64, 128, 255, 255, 128, 64}};
    proof.otherHalf = MaskProof::Reach{1, std::nullopt};
    ProofRow row = rowOf(proof);
    row.levels = 2;
    row.isDefaultDither = true;
    ProofRow refused{.profile = "c", .store = "alpha"};
    refused.refused = "destination alpha";
    refused.source = "the manual";
    const Json json = Json::parse(showProofs({row, refused}, Format::Json));
    ASSERT_EQ(json.size(), 2u);
    EXPECT_EQ(json[0]["levels"], 2);
    EXPECT_EQ(json[0]["default_dither"], true);
    EXPECT_EQ(json[0]["by"], "blend");
    EXPECT_TRUE(json[0]["period"].is_null());
    EXPECT_EQ(json[0]["other_half"], (Json{{"half", 127}, {"depth", 1}, {"volumes", nullptr}}));
    EXPECT_EQ(json[0]["verdict"], "up to 2 open, half = 128 (127: up to 1 open)");
    EXPECT_EQ(json[0]["counterexample"]["codes"], (Json{64, 128, 255, 255, 128, 64}));
    EXPECT_EQ(json[1]["refused"], "destination alpha");

    std::istringstream lines(showProofs({row, refused}, Format::Csv));
    std::string head, line;
    std::getline(lines, head);
    EXPECT_THAT(head, AllOf(HasSubstr(",levels,by,order,"), HasSubstr(",period,")));
    while (std::getline(lines, line))
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ','))
            << line;
}

}  // namespace prove_report_test
}  // namespace gnomon
