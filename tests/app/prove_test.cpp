// gnomon prove as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.h"

namespace gnomon {
namespace prove_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

class ProveCommand : public ProgramTest {};

/// The row of @p rows with these values; each test looks for one that it knows.
Json rowWith(const Json& rows, const std::map<std::string, Json>& values) {
    for (const Json& row : rows)
        if (std::all_of(values.begin(), values.end(),
                        [&](const auto& value) { return row.value(value.first, Json()) == value.second; }))
            return row;  // of double, the best start comes first
    ADD_FAILURE() << "no such row";
    return Json::object();
}

// Section 4.2: exact without dithering, five doublings in red and blue, six in green; every mode has its
// rows.
TEST_F(ProveCommand, ProvesTheVoodooExactWithoutDither) {
    const Outcome outcome =
        run({"prove", "--profile", "voodoo2", "--arithmetic", "double", "--format", "json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    const Json rows = Json::parse(outcome.out);
    EXPECT_EQ(rows.size(), 2u /* models */ * (1 + 5 + 1 + 6) /* best and each level of 5 and 6 bits */ *
                               5u /* modes */ * 3u /* orders */);
    for (const char* unit : {"voodoo_mame", "voodoo_86box"})
        for (const int bits : {5, 6}) {
            const Json off =
                rowWith(rows, {{"unit", unit}, {"bits", bits}, {"dither", "off"}, {"order", "volume"}});
            EXPECT_TRUE(off["depth"].is_null() && off["counterexample"].is_null()) << off;
            EXPECT_EQ(off["half"], 128);
            EXPECT_EQ(off["default_dither"], false);
            const Json nested =
                rowWith(rows, {{"unit", unit}, {"bits", bits}, {"dither", "off"}, {"order", "fronts-first"}});
            EXPECT_EQ(nested["depth"], bits);
            EXPECT_EQ(nested["half"], 128);
            EXPECT_EQ(nested["other_half"]["depth"], bits - 1);
            const Json dithered = rowWith(
                rows, {{"unit", unit}, {"bits", bits}, {"dither", "4x4_subtract"}, {"order", "volume"}});
            EXPECT_EQ(dithered["default_dither"], true);
            EXPECT_NE(dithered["drift"][1]["highest"], dithered["drift"][1]["lowest"]) << dithered;
        }
}

/// The first paragraph of @p text, as one line.
std::string firstParagraph(const std::string& text) {
    std::string words;
    std::istringstream in(text.substr(0, text.find("\n\n")));
    for (std::string word; in >> word;) words += (words.empty() ? "" : " ") + word;
    return words;
}

// What a person reads first.
TEST_F(ProveCommand, SaysInWordsWhatItProves) {
    const std::string words =
        firstParagraph(run({"prove", "--profile", "voodoo2", "--arithmetic", "double"}).out);
    EXPECT_THAT(words,
                StartsWith("voodoo2 screen double dither off, half = 128, not 127: volume exact; "
                           "fronts-first up to 5 open in 5 bits, up to 6 open in 6 bits; per-triangle "));
    EXPECT_THAT(words,
                HasSubstr("; no drift 5 bits, volume by levels: 1: up to 1 open; 2 to 5: exact 6 bits, "
                          "volume by levels: 1: up to 1 open; 2 to 6: exact dither 4x4_subtract, the "
                          "driver's default, half"));
    // Section 4.2: from 8 of 31 up to 8 codes after eight trips, and there it stays.
    EXPECT_THAT(words, HasSubstr("2: up to 6 in all, drifts by 0..8 codes in 64 volumes;"));
}

TEST_F(ProveCommand, ProvesThePs2sCountExactModulo256) {
    const Json rows =
        Json::parse(run({"prove", "--profile", "ps2", "--arithmetic", "count", "--format", "json"}).out);
    for (const char* order : {"volume", "fronts-first", "per-triangle", "nearer-only"}) {
        const Json row = rowWith(rows, {{"by", "add_wrap"}, {"bits", 8}, {"order", order}});
        EXPECT_EQ(row["depth"], 255);
        EXPECT_EQ(row["period"], 256);
        EXPECT_THAT(row["verdict"].get<std::string>(), StartsWith("exact modulo 256, in any order"));
        const std::string wrong = row["counterexample"]["crossings"];
        EXPECT_EQ(std::count(wrong.begin(), wrong.end(), 'D') - std::count(wrong.begin(), wrong.end(), 'H'),
                  256);
    }
    const Json clamped = rowWith(rows, {{"by", "blend"}, {"bits", 8}, {"order", "volume"}});
    EXPECT_TRUE(clamped["period"].is_null());
}

/// A chip of our own: what a profile needs for masks in its colours, and more lines.
std::string chipToml(const std::string& more) {
    return "title = \"x\"\nsource_factors = [\"zero\", \"one\", \"dst_color\", \"one_minus_dst_color\"]\n"
           "destination_factors = [\"zero\", \"one\"]\n" +
           more;
}

// Doubling to 2v - 1 takes a code per volume, so that a mask near 64 lasts for 32 volumes; there are other
// starts, such as 65, that double to an odd code which halves back to them.
TEST_F(ProveCommand, ProvesTheDreamcastsDrift) {
    const std::string file = write("tile.toml", chipToml("colour_formats = [\"8888\"]\nblend_equations = "
                                                         "[\"add\"]\nblend_units = [\"powervr\"]\n"));
    const std::vector<std::string> asked{"prove",  "--profile", file,    "--arithmetic",
                                         "double", "--order",   "volume"};
    EXPECT_THAT(
        firstParagraph(run(asked).out),
        HasSubstr("8 bits, volume by levels: 1: up to 1 open; 2: up to 32 in all, drifts by -64 codes in "
                  "64 volumes; 3: up to 16 in all, drifts by -32 codes in 64 volumes; 4: "));
    auto asJson = asked;
    asJson.insert(asJson.end(), {"--format", "json"});
    const Json rows = Json::parse(run(asJson).out);
    ASSERT_EQ(rows.size(), 1u + 8u);
    const Json two = rowWith(rows, {{"levels", 2}});
    EXPECT_EQ(two["start"], 64);
    EXPECT_EQ(two["drift"][1], (Json{{"volumes", 8}, {"lowest", -8}, {"highest", -8}}));
    EXPECT_TRUE(rows[0]["levels"].is_null());
    EXPECT_TRUE(rows[0]["depth"].is_null());
}

// Each listed mode of a chip, the driver's default first; the N64 counts by two codes and only by wrapping.
TEST_F(ProveCommand, ProvesTheN64sCountInEachOfItsModes) {
    const std::string file = write(
        "rdp.toml", chipToml("colour_formats = [\"5551\"]\nblend_equations = [\"add_wrap\"]\nblend_units = "
                             "[\"rdp\"]\ndither_modes = [\"rdp_magic\", \"rdp_bayer\", \"off\"]\n"));
    const Json rows = Json::parse(
        run({"prove", "--profile", file, "--arithmetic", "count", "--order", "volume", "--format", "json"})
            .out);
    ASSERT_EQ(rows.size(), 3u);
    for (const Json& row : rows) {
        EXPECT_EQ(row["by"], "add_wrap");
        EXPECT_EQ(row["default_dither"], row["dither"] == "rdp_magic");
    }
    EXPECT_EQ(rows[2]["period"], 16);
    EXPECT_EQ(rows[2]["depth"], 15);
}

TEST_F(ProveCommand, ProvesParityByLogicOperationsToo) {
    const std::string file =
        write("logic.toml", chipToml("colour_formats = [\"888\"]\nblend_equations = [\"add\"]\n"
                                     "blend_units = [\"flipper\"]\nlogic_ops = true\n"));
    const Json rows = Json::parse(run({"prove", "--profile", file, "--arithmetic", "parity", "--order",
                                       "per-triangle", "--format", "json"})
                                      .out);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["by"], "blend");
    EXPECT_EQ(rows[1]["by"], "logic_op");
    EXPECT_EQ(rows[1]["period"], 2);
}

TEST_F(ProveCommand, ProvesEveryLevelThatTheBitsHold) {
    for (int levels = 1; levels <= 8; ++levels) {
        const Json rows =
            Json::parse(run({"prove", "--profile", "voodoo2", "--arithmetic", "double", "--levels",
                             std::to_string(levels), "--order", "fronts-first", "--format", "json"})
                            .out);
        for (const int bits : {5, 6}) {
            const Json row = rowWith(
                rows,
                {{"bits", bits}, {levels > bits ? "unit" : "dither", levels > bits ? "voodoo_mame" : "off"}});
            if (levels > bits) {
                EXPECT_THAT(row["refused"].get<std::string>(), StartsWith("bits for "));
            } else {
                EXPECT_EQ(row["depth"], levels);
            }
        }
    }
}

TEST_F(ProveCommand, ShowsAShortestCounterexample) {
    const Outcome text = run({"prove", "--profile", "ideal", "--arithmetic", "double", "--levels", "2",
                              "--order", "fronts-first"});
    EXPECT_THAT(text.out, AllOf(HasSubstr("DDDHH"), HasSubstr("64 128 255 255 128 64")));
}

TEST_F(ProveCommand, ProvesWhyAStoreIsRefused) {
    const Outcome outcome = run({"prove", "--profile", "voodoo1,ps2", "--store", "alpha"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("voodoo1 alpha double: refused, the chip lacks destination alpha"),
                      HasSubstr("ps2 alpha double: refused, the chip lacks blending of destination"),
                      HasSubstr("[PGS ubershader.comp")));
}

TEST_F(ProveCommand, ProvesNothingOfWidthsThatAUnitLacks) {
    const std::string file =
        write("station.toml",
              "title = \"x\"\ncolour_formats = [\"5551\", \"4444\"]\nalpha_bits = 1\n"
              "blend_writes_alpha = true\nalpha_source_factors = [\"one\"]\n"
              "alpha_destination_factors = [\"one\"]\nsource_factors = [\"one\"]\n"
              "destination_factors = [\"one\"]\n"
              "blend_equations = [\"add\", \"reverse_subtract\"]\nblend_units = [\"psx\"]\n");
    const Outcome outcome = run({"prove", "--profile", file, "--store", "screen,alpha", "--arithmetic",
                                 "count", "--order", "volume", "--format", "json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const Json rows = Json::parse(outcome.out);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["bits"], 5);
    EXPECT_TRUE(rows[0].contains("depth"));
    EXPECT_EQ(rows[1]["refused"], "it in 4 bits of its blend unit psx");
    EXPECT_EQ(rows[2]["refused"], "a channel of two bits or more");
}

TEST_F(ProveCommand, ProvesInCsvWithAsManyFieldsAsItsHead) {
    const std::string csv =
        run({"prove", "--profile", "tnt", "--arithmetic", "count,parity", "--format", "csv"}).out;
    std::istringstream lines(csv);
    std::string head, line;
    std::getline(lines, head);
    EXPECT_THAT(
        head, StartsWith("profile,store,format,bits,unit,evidence,dither,arithmetic,levels,by,order,depth"));
    while (std::getline(lines, line))
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ','))
            << line;
}

}  // namespace prove_test
}  // namespace gnomon
