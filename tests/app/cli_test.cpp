// The program as a user runs it: what it prints where, and its exit status.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image.h"
#include "method/method.h"
#include "program.h"
#include "scene/load.h"

namespace gnomon {
namespace cli_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Json = nlohmann::json;

const std::filesystem::path kShared = GNOMON_SHARED;

class Program : public ProgramTest {};

constexpr const char* kCommands[] = {"matrix",   "report",  "render", "plan", "advise", "reproduce", "prove",
                                     "profiles", "methods", "scenes", "mesh", "cost",   "devices",   "check"};

TEST_F(Program, ListsEveryCommandInItsHelp) {
    const Outcome help = run({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    for (const char* command : kCommands)
        EXPECT_THAT(help.out, HasSubstr(std::string("\n  ") + command + " "));
    EXPECT_THAT(help.out, HasSubstr("exit status: 0"));
}

TEST_F(Program, HasAHelpWithAnExampleOfUseForEveryCommand) {
    for (const char* command : kCommands) {
        const Outcome help = run({command, "--help"});
        EXPECT_EQ(help.status, 0) << command;
        EXPECT_THAT(help.out, AllOf(HasSubstr(std::string("gnomon ") + command), HasSubstr("--format")))
            << command;
    }
}

TEST_F(Program, HasEveryFlagOfTheDesign) {
    for (const char* command : {"matrix", "render", "plan"}) {
        const std::string help = run({command, "--help"}).out;
        for (const char* flag :
             {"--scene", "--profile", "--method", "--size", "--format", "--store", "--arithmetic", "--levels",
              "--count", "--silhouette", "--mask-scale", "--apply", "--shade", "--light", "--eye", "--target",
              "--fov", "--near", "--ground"})
            EXPECT_THAT(help, HasSubstr(std::string("  ") + flag)) << command;
    }
    const std::string matrix = run({"matrix", "--help"}).out, render = run({"render", "--help"}).out;
    for (const char* flag : {"--frames", "--jobs", "--fidelity"}) EXPECT_THAT(matrix, HasSubstr(flag));
    for (const char* flag : {"-o,", "--mask ", "--steps", "--fidelity"}) EXPECT_THAT(render, HasSubstr(flag));
    EXPECT_THAT(run({"reproduce", "--help"}).out, AllOf(HasSubstr("--table"), HasSubstr("roettger2002")));
}

// libglvnd finds its drivers by files; where there are none, EGL has nothing to draw with.
TEST_F(Program, RefusesADeviceWithoutADriverBeforeItDraws) {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/no/such/file.json", 1);
    const std::vector<Outcome> refused{run({"render", "boxes", "--device", "egl"}),
                                       run({"matrix", "boxes", "--device", "egl"}),
                                       run({"advise", "boxes", "--device", "egl"})};
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    for (const Outcome& outcome : refused) expectRefused(outcome, "--device egl: ");
}

TEST_F(Program, NamesTheDefaultDeviceAndTheDriversOfAll) {
    const Json devices = Json::parse(run({"devices", "--format", "json"}).out);
    ASSERT_EQ(devices.size(), 2u);
    EXPECT_EQ(devices[0]["device"], "osmesa");
    EXPECT_EQ(devices[1]["device"], "egl");
    EXPECT_EQ((devices[0]["default"] == "yes") + (devices[1]["default"] == "yes"), 1);
    for (const Json& device : devices)
        EXPECT_THAT(device["driver"].get<std::string>(),
                    testing::AnyOf(HasSubstr(", OpenGL "), HasSubstr("none: ")));
}

TEST_F(Program, ListsEveryNamedMethod) {
    const std::string list = run({"methods"}).out;
    for (const NamedMethod& method : namedMethods())
        EXPECT_THAT(list, AllOf(HasSubstr("\n" + method.id + " "), HasSubstr(method.source)));
}

TEST_F(Program, ShowsTheFactsOfAChipWithSources) {
    const Outcome shown = run({"profiles", "voodoo2"});
    EXPECT_EQ(shown.status, 0);
    EXPECT_THAT(shown.out,
                AllOf(HasSubstr("alpha_excludes_depth"), HasSubstr("[GL-CVG"), HasSubstr("Sources")));
}

TEST_F(Program, ShowsTheGradeOfEvidence) {
    EXPECT_THAT(run({"profiles", "voodoo2"}).out,
                testing::ContainsRegex("\nblend_units +emulator +voodoo_mame, voodoo_86box\n +\\[MAME"));
    const Json tnt = Json::parse(run({"profiles", "tnt", "--format", "json"}).out);
    bool seen = false;
    for (const Json& fact : tnt[0]["facts"]) {
        if (fact["key"] != "blend_units") continue;
        EXPECT_EQ(fact["grade"], "guess");
        seen = true;
    }
    EXPECT_TRUE(seen);
}

struct BadArguments {
    std::string name;
    std::vector<std::string> arguments;
    std::string what;  ///< the line must name it
};
void PrintTo(const BadArguments& c, std::ostream* out) {
    *out << c.name;
}

class BadArgument : public Program, public testing::WithParamInterface<BadArguments> {};

TEST_P(BadArgument, IsRefusedInOneLine) {
    expectRefused(run(GetParam().arguments), GetParam().what);
}

TEST_F(Program, TakesASceneAfterAListOption) {
    EXPECT_EQ(run({"plan", "--method", "carmack", "boxes"}).status, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Cli, BadArgument,
    testing::Values(
        BadArguments{"NoCommand", {}, "subcommand"}, BadArguments{"UnknownCommand", {"matrx"}, "'matrx'"},
        BadArguments{"UnknownFlag", {"matrix", "--colour"}, "--colour"},
        BadArguments{"UnknownProfile", {"matrix", "--profile", "voodoo9"}, "'voodoo9' (known: "},
        BadArguments{"UnknownProfileShown", {"profiles", "voodoo9"}, "'voodoo9'"},
        BadArguments{"UnknownMethod", {"matrix", "--method", "carmak"}, "'carmak' (known: "},
        BadArguments{"UnknownMethodShown", {"methods", "carmak"}, "'carmak'"},
        BadArguments{"UnknownScene", {"matrix", "--scene", "boxen"}, "boxen: "},
        BadArguments{"UnknownSceneAmongKnown", {"matrix", "boxes,boxen"}, "boxen: "},
        BadArguments{"UnknownStore", {"matrix", "--store", "tape"}, "--store: no such value 'tape'"},
        BadArguments{
            "UnknownArithmetic", {"plan", "--arithmetic", "triple"}, "--arithmetic: no such value 'triple'"},
        BadArguments{"UnknownCount", {"render", "--count", "zmaybe"}, "--count: no such value 'zmaybe'"},
        BadArguments{"UnknownSilhouette", {"matrix", "--silhouette", "round"}, "'round'"},
        BadArguments{"UnknownMaskScale", {"matrix", "--mask-scale", "1/3"}, "'1/3'"},
        BadArguments{"UnknownApply", {"matrix", "--apply", "glue"}, "'glue'"},
        BadArguments{"UnknownShade", {"render", "--shade", "grey"}, "'grey'"},
        BadArguments{"LevelsOfNoMethodThatDoubles",
                     {"render", "--method", "carmack", "--levels", "3"},
                     "--levels: none of these methods doubles"},
        BadArguments{
            "MapSizeOfNoDepthMap", {"render", "--method", "carmack", "--map-size", "256"}, "--map-size"},
        BadArguments{
            "MapSizeBeyondTheRange", {"render", "--method", "williams", "--map-size", "0"}, "--map-size"},
        BadArguments{
            "MapBiasBeyondTheRange", {"render", "--method", "williams", "--map-bias", "1"}, "--map-bias"},
        BadArguments{"CountOfNoVolumes", {"render", "--store", "none", "--count", "zfail"}, "--count: none"},
        BadArguments{"UnknownStart", {"render", "--start", "top"}, "--start: no such value 'top'"},
        BadArguments{"StartOfABlend",
                     {"render", "--store", "alpha", "--arithmetic", "double", "--start", "middle"},
                     "of a count"},
        BadArguments{"NegativeOffset", {"render", "--method", "carmack", "--offset=-1"}, "--offset"},
        BadArguments{"OffsetWithoutALightCap", {"render", "--method", "heidmann", "--offset", "1"}, "zfail"},
        BadArguments{"MoreLightsThanThereAre", {"render", "boxes", "--lights", "2"}, "--lights: boxes has 1"},
        BadArguments{"NoLights", {"render", "boxes", "--lights", "0"}, "--lights"},
        BadArguments{"LevelsBeyondTheRange", {"matrix", "--levels", "9"}, "--levels: 9"},
        BadArguments{
            "ContradictionsOnly", {"matrix", "--store", "stencil", "--arithmetic", "double"}, "no method"},
        BadArguments{"UnknownFormat", {"matrix", "--format", "xml"}, "xml"},
        BadArguments{"Fidelity", {"matrix", "--fidelity", "console"}, "no such value 'console'"},
        BadArguments{"TwoFidelitiesToRender", {"render", "--fidelity", "gl,chip"}, "--fidelity"},
        BadArguments{"DitherOfOpenGl", {"render", "--dither", "on"}, "fidelity chip"},
        BadArguments{"NoSuchDevice", {"matrix", "--device", "glx"}, "--device: no such value 'glx' (known: "},
        BadArguments{"BlendUnitOfOpenGl", {"render", "--blend-unit", "ideal_round"}, "fidelity chip"},
        BadArguments{"BlendUnit", {"render", "--fidelity", "chip", "--blend-unit", "fast"}, "'fast'"},
        BadArguments{"BlendUnitOfAnotherChip",
                     {"render", "--fidelity", "chip", "--profile", "tnt", "--blend-unit", "gs"},
                     "no chosen profile lists gs"},
        BadArguments{"NoJobs", {"matrix", "--jobs", "0"}, "--jobs"},
        BadArguments{"SizeZero", {"matrix", "--size", "0x0"}, "0x0"},
        BadArguments{"SizeOfNoWidth", {"render", "--size", "0x240"}, "0x240"},
        BadArguments{"SizeHuge", {"matrix", "--size", "100000x100000"}, "100000x100000"},
        BadArguments{"SizeBeyondIntegers", {"matrix", "--size", "99999999999x2"}, "99999999999"},
        BadArguments{"SizeOfOneNumber", {"plan", "--size", "320"}, "320"},
        BadArguments{"SizeOfLetters", {"matrix", "--size", "320xabc"}, "abc"},
        BadArguments{"SizeNegative", {"matrix", "--size", "-320x240"}, "-320x240"},
        BadArguments{"SizeBadAmongGood", {"matrix", "--size", "64x64,0x0"}, "0x0"},
        BadArguments{"FrameNegative", {"render", "--frame", "-1"}, "0 to 59"},
        BadArguments{"FrameBeyondThePath", {"render", "--frame", "60"}, "0 to 59"},
        BadArguments{"FrameOfPlanBeyondThePath", {"plan", "--frame", "60"}, "0 to 59"},
        BadArguments{"FramesNegative", {"matrix", "--frames", "-1"}, "'-1'"},
        BadArguments{"FramesBackwards", {"matrix", "--frames", "5-3"}, "'5-3'"},
        BadArguments{"EmptyLight", {"render", "boxes", "--light", ""}, "--light"},
        BadArguments{"EmptyOutput", {"render", "boxes", "-o", ""}, "-o"},
        BadArguments{"OutputThatIsNoPng", {"render", "boxes", "--mask", "mask.jpg"}, "mask.jpg"},
        BadArguments{"OutputNamedTwice", {"render", "boxes", "-o", "a.png", "--mask", "a.png"}, "a.png"},
        BadArguments{"OutputWhereThePictureOfCausesGoes",
                     {"render", "boxes", "-o",
                      "./../" + std::filesystem::current_path().filename().string() + "/a-causes.png",
                      "--mask", "a.png"},
                     "a-causes.png"},
        BadArguments{
            "OutputInNoFolder", {"render", "boxes", "-o", "a.png", "--mask", "nowhere/a.png"}, "nowhere"},
        BadArguments{"HairlineFieldOfView", {"render", "boxes", "--fov", "1e-6"}, "0.01"},
        BadArguments{"FramesBeyondThePath", {"matrix", "--frames", "60-80"}, "0 to 59"},
        BadArguments{"MissingFile", {"matrix", "/nowhere/mesh.ply"}, "/nowhere/mesh.ply"},
        BadArguments{
            "MissingProfileFile", {"matrix", "--profile", "/nowhere/chip.toml"}, "/nowhere/chip.toml"},
        BadArguments{"FolderAsScene", {"render", "--scene", "/tmp"}, "/tmp"},
        BadArguments{"DeviceAsScene", {"render", "/dev/null"}, "/dev/null"},
        BadArguments{"LightOfTwoNumbers", {"render", "--light", "1,2"}, "--light"},
        BadArguments{"LightOfLetters", {"render", "--light", "a,b,c"}, "'a'"},
        BadArguments{"LightWithoutDirection", {"render", "--light", "0,0,0,0"}, "light"},
        BadArguments{"LightBeyondFloat", {"render", "--light", "1e39,0,0"}, "1e39"},
        BadArguments{"EyeOfFourNumbers", {"render", "--eye", "1,2,3,4"}, "--eye"},
        BadArguments{"EyeNotANumber", {"render", "--eye", "nan,0,0"}, "nan"},
        BadArguments{"EyeAtTarget", {"render", "--eye", "1,2,3", "--target", "1,2,3"}, "eye"},
        BadArguments{"FovZero", {"render", "--fov", "0"}, "fov"},
        BadArguments{"FovStraight", {"render", "--fov", "180"}, "fov"},
        BadArguments{"FovOfLetters", {"render", "--fov", "wide"}, "--fov"},
        BadArguments{"NearZero", {"render", "--near", "0"}, "near"},
        BadArguments{"NearNegative", {"render", "--near", "-1"}, "near"},
        BadArguments{"NearInfinite", {"matrix", "--near", "inf"}, "near"},
        BadArguments{"GroundUnknown", {"render", "--ground", "perhaps"}, "perhaps"},
        BadArguments{"UnknownProfileToProve", {"prove", "--profile", "voodoo9"}, "'voodoo9' (known: "},
        BadArguments{
            "UnknownStoreToProve", {"prove", "--store", "stencil"}, "--store: no such value 'stencil'"},
        BadArguments{
            "UnknownArithmeticToProve", {"prove", "--arithmetic", "triple"}, "'triple' (known: double"},
        BadArguments{"UnknownOrder", {"prove", "--order", "random"}, "--order: no such value 'random'"},
        BadArguments{"LevelsToProveBeyondTheRange", {"prove", "--levels", "9"}, "--levels: 9"},
        BadArguments{"LevelsToProveNoNumber", {"prove", "--levels", "two"}, "--levels"},
        BadArguments{"PaperUnknown", {"reproduce", "crow1977"}, "crow1977"},
        BadArguments{"PaperMissing", {"reproduce"}, "paper"},
        BadArguments{
            "TableUnknown", {"reproduce", "roettger2002", "--table", "3"}, "only tables 1 and 2 are"},
        BadArguments{"TwoTablesAsCsv", {"reproduce", "roettger2002", "--format", "csv"}, "--format: "},
        BadArguments{"HostTimeNoNumber", {"plan", "--explain", "--host-ms", "nan"}, "--host-ms"},
        BadArguments{"HostTimeNegative", {"plan", "--explain", "--host-ms", "-1"}, "--host-ms"},
        BadArguments{"TwoMethodsToRender", {"render", "--method", "none,heidmann"}, "one method"},
        BadArguments{"TwoChipsToRender", {"render", "--profile", "tnt,voodoo2"}, "--profile: 2"},
        BadArguments{"TwoScenesToPlan", {"plan", "boxes,knot"}, "--scene: 2"},
        BadArguments{"TwoSizesToRender", {"render", "--size", "64x64,32x32"}, "--size: 2"}),
    [](const auto& test) { return test.param.name; });

TEST_F(Program, ChecksThePromisesOfAHardCaseWithTheirLine) {
    const auto caseOf = [&](const std::string& fails, const std::string& exact) {
        return write("case.toml",
                     "lights = []\nobjects = []\n[camera]\neye = [0, 0, 5]\n"
                     "[hard]\nfamily = \"f\"\nwhat = \"w\"\nsource = \"ours\"\nfails = [" +
                         fails + "]\nexact = [\n    { method = \"carmack\" },\n    " + exact + "\n]\n");
    };
    const auto hard = [&](const std::string& promise) { return caseOf("", "{ " + promise + " },"); };
    const std::string file = hard("method = \"nosuch\"");
    expectRefused(run({"scenes", file}), file + ":12: no such method 'nosuch'");
    for (const char* promise :
         {"method = \"carmack\", profile = \"nosuch\"", "method = \"carmack\", silhouette = \"blob\"",
          "method = \"carmack\", dither = true", "method = \"carmack\", frame = 1"})
        expectRefused(run({"scenes", hard(promise)}), file + ":12: ");
    expectRefused(run({"scenes", caseOf("\n    { method = \"heidmann\", cause = \"bad luck\" },\n", "")}),
                  file + ":10: no such cause 'bad luck'");
    expectRefused(run({"scenes", caseOf("\n    { method = \"heidmann\", cause = \"bad\\nluck\" },\n", "")}),
                  file + ":10: 'cause' must be one line");
    EXPECT_THAT(run({"scenes", hard("method = \"heidmann\"")}).out,
                HasSubstr("gnomon render " + file + " --method heidmann"));
}

TEST_F(Program, RefusesAMalformedSceneFileWithItsLine) {
    const std::string file = write("bad.toml", "title = \"x\"\nambient = \n");
    expectRefused(run({"matrix", file}), file + ":2: ");
    const std::string unknown = write("unknown.toml", "title = \"x\"\nambiant = 0.2\n");
    expectRefused(run({"render", unknown}), unknown + ":2: ");
}

TEST_F(Program, RefusesAMalformedProfileFileWithItsLine) {
    const std::string file = write("chip.toml", "title = \"x\"\nyear = 1998\nstencil_bits = [\n");
    expectRefused(run({"matrix", "--profile", file}), file + ":");
    const std::string unknown = write("unknown.toml", "title = \"x\"\nstencil_bitz = 8\n");
    expectRefused(run({"render", "--profile", unknown}), unknown + ":2: ");
}

TEST_F(Program, RefusesATruncatedMesh) {
    const std::string whole =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(run({"scenes", write("whole.ply", whole)}).status, 0);
    for (const std::size_t length : {0u, 3u, 60u, 150u, 165u, 172u, 178u}) {
        const std::string file = write("cut.ply", whole.substr(0, length));
        SCOPED_TRACE(length);
        expectRefused(run({"render", "--size", "16x16", file}), file);
    }
}

std::vector<std::filesystem::path> malformedFiles() {
    std::vector<std::filesystem::path> files;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(kShared / "data/malformed", missing))
        if (entry.path().extension() != ".bin") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class MalformedFile : public Program, public testing::WithParamInterface<std::filesystem::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MalformedFile);

TEST_P(MalformedFile, IsRefusedInOneLine) {
    expectRefused(run({"matrix", "--scene", GetParam()}), GetParam().string() + ":");
    expectRefused(run({"render", GetParam(), "--size", "16x16"}), GetParam().string() + ":");
}

INSTANTIATE_TEST_SUITE_P(Shared, MalformedFile, testing::ValuesIn(malformedFiles()), [](const auto& test) {
    std::string name = test.param.filename();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

TEST_F(Program, TakesNegativeCoordinates) {
    EXPECT_EQ(
        run({"render", "--size", "16x16", "--eye", "-1,2,3", "--target", "-.5,1,-2", "--light", "-1,9,-2"})
            .err,
        "");
}

// One array and nothing else, whatever is drawn.
TEST_F(Program, PrintsOneJsonArray) {
    const std::vector<std::pair<std::vector<std::string>, std::size_t>> runs{
        {{"matrix", "boxes,roettger", "--size", "32x24", "--frames", "0,1", "--method", "none,heidmann",
          "--profile", "ideal,tnt,voodoo2"},
         2 * 2 * 2 * 3},
        {{"render", "--size", "32x24"}, 1},
        {{"plan", "--size", "32x24"}, 1},
        {{"plan", "--shade", "black,ambient,attenuated"}, 3},
        {{"plan", "--profile", "voodoo1", "--size", "1024x1024"}, 0},
        {{"profiles"}, profileIds(std::filesystem::path(GNOMON_SOURCE) / "profiles").size()},
        {{"prove", "--profile", "voodoo1", "--arithmetic", "parity"}, 2 * 2 * 5 * 3},
        {{"prove", "--profile", "tnt", "--store", "screen,alpha", "--arithmetic", "count"}, 2 * 3},
        {{"methods"}, namedMethods().size()},
        {{"scenes"}, 3 + hardSceneIds(std::filesystem::path(GNOMON_SOURCE) / "scenes").size()},
        {{"reproduce", "roettger2002", "--table", "1"}, 8}};
    for (auto [arguments, length] : runs) {
        arguments.insert(arguments.end(), {"--format", "json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << arguments[0];
        EXPECT_EQ(outcome.err, "") << arguments[0];
        const Json json = Json::parse(outcome.out, nullptr, false);
        ASSERT_TRUE(json.is_array()) << arguments[0] << ": " << outcome.out.substr(0, 300);
        EXPECT_EQ(json.size(), length) << arguments[0];
    }
}

// "hard" stands for all hard cases, "all" for these and the shipped scenes; without either there are three.
TEST_F(Program, ListsHardCasesUnderAHeadingOfTheirOwn) {
    const auto hard = hardSceneIds(std::filesystem::path(GNOMON_SOURCE) / "scenes").size();
    const auto scenesOf = [&](const std::string& id) {
        return Json::parse(run({"scenes", id, "--format", "json"}).out).size();
    };
    EXPECT_EQ(scenesOf("hard"), hard);
    EXPECT_EQ(scenesOf("all"), hard + 3);
    const Json cells = Json::parse(run({"matrix", "--method", "none", "--profile", "ideal", "--size", "16x12",
                                        "--frames", "0", "--format", "json"})
                                       .out);
    EXPECT_EQ(cells.size(), 3u);

    const std::string list = run({"scenes"}).out;
    EXPECT_LT(list.find("roettger"), list.find("hard case"));
    EXPECT_LT(list.find("hard case"), list.find("hard/eye-inside-one"));

    const std::string one = run({"scenes", "hard/eye-inside-one"}).out;
    EXPECT_THAT(
        one,
        HasSubstr("\nmust be wrong\n  gnomon render hard/eye-inside-one --method heidmann --profile ideal\n"
                  "    eye inside a volume\n"));
    EXPECT_THAT(
        one,
        HasSubstr("\nmust be exact\n  gnomon render hard/eye-inside-one --method carmack --profile ideal\n"));
    expectRefused(run({"scenes", "hard/eye-inside-on"}),
                  "hard/eye-inside-on: no such hard case, known: hard/");
}

// Nothing to see, nothing that casts, nothing that lights: every command answers, and sensibly.
TEST_F(Program, TakesScenesWithoutObjectsCastersOrLights) {
    for (const std::string id : {"hard/empty", "hard/no-caster", "hard/no-light"}) {
        for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
                 {"scenes", id},
                 {"plan", id},
                 {"plan", id, "--profile", "voodoo2"},
                 {"render", id, "--size", "32x24", "-o", pathOf("o.png"), "--mask", pathOf("m.png"),
                  "--truth", pathOf("t.png")},
                 {"render", id, "--size", "32x24", "--method", "atomiczp", "--steps", pathOf("steps")},
                 {"render", id, "--size", "32x24", "--eye", "1,2,3", "--light", "0,1,0,0"},
                 {"matrix", id, "--size", "32x24"}}) {
            const Outcome outcome = run(command);
            EXPECT_EQ(outcome.status, 0) << id << " " << command[0] << ": " << outcome.err;
        }
    }
    EXPECT_EQ(run({"mesh", "hard/no-light"}).status, 0);
    expectRefused(run({"mesh", "hard/empty"}), "hard/empty: no object casts a shadow");
    expectRefused(run({"mesh", "hard/no-caster"}), "hard/no-caster: no object casts a shadow");
    expectRefused(run({"render", "hard/empty", "--ground", "yes"}),
                  "ground: nothing is there to put a floor below");
    expectRefused(run({"render", "hard/no-light", "--lights", "1"}), "--lights: hard/no-light has 0");
}

// Messages of CLI11 aside, a file's notes go to standard error.
TEST_F(Program, KeepsNotesOffTheJson) {
    const std::string mesh = write(
        "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 1 2\n");
    const Outcome outcome = run({"matrix", mesh, "--size", "16x16", "--method", "heidmann", "--profile",
                                 "ideal", "--format", "json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("degenerate"));
    EXPECT_TRUE(Json::accept(outcome.out));
}

TEST_F(Program, ReproducesTheTableOfThePaper) {
    const Outcome outcome = run({"reproduce", "roettger2002", "--table", "1", "--format", "json"});
    EXPECT_EQ(outcome.status, 0);
    std::vector<std::string> rows;
    for (const Json& row : Json::parse(outcome.out)) {
        EXPECT_EQ(row["counted"], row["published"]) << row;
        EXPECT_EQ(row["planned"], row["published"]) << row;
        EXPECT_EQ(row["agrees"], true);
        rows.push_back(row["buffer"].get<std::string>() + " " + row["shade"].get<std::string>() +
                       (row["maximum"] ? " max " : " ") + row["counted"]["scene"].dump() + "/" +
                       row["counted"]["rectangle"].dump());
    }
    EXPECT_THAT(rows, testing::UnorderedElementsAre("alpha black 1/4", "alpha ambient 2/4",
                                                    "alpha attenuated 1/4", "alpha attenuated max 1/2",
                                                    "screen black 2/3", "screen ambient 3/3",
                                                    "screen attenuated 2/3", "screen attenuated max 2/1"));
    const Outcome text = run({"reproduce", "roettger2002", "--table", "1"});
    EXPECT_EQ(text.status, 0);
    EXPECT_THAT(text.out, AllOf(HasSubstr("agrees"), Not(HasSubstr("DIFFERS"))));
}

// Which orders of the columns of Table 2 the model has as published, and how near it comes: the README says
// so.
TEST_F(Program, ModelsTheRatesOfThePaper) {
    const Outcome outcome = run({"reproduce", "roettger2002", "--format", "json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json all = Json::parse(outcome.out);
    ASSERT_EQ(all.size(), 8u + 1u) << "the rows of Table 1, and Table 2";
    const Json& table = all.back();
    EXPECT_EQ(table["table"], 2);
    std::map<std::string, std::vector<std::string>> differs;
    for (const Json& fit : table["fits"]) {
        std::vector<std::string>& lines = differs[fit["fit"].get<std::string>()];
        for (const Json& line : fit["orders"])
            if (!line["as_published"])
                lines.push_back(fmt::format("{} {} {}", line["window"].get<int>(),
                                            line["slower"].get<std::string>(),
                                            line["faster"].get<std::string>()));
    }
    // Volumes are limited by fill, so that fewer bytes of a stencil fragment count for little, and alpha
    // draws three rectangles more. A smaller mask takes less of the chip at any size: the half-size mask can
    // be behind only by what its second pass of the scene takes of the host, which fit E alone knows.
    const std::vector<std::string> stencil{"512 stencil alpha", "1024 stencil alpha"};
    const std::vector<std::string> half{"256 half screen", "256 half alpha", "256 half stencil"};
    std::vector<std::string> inTurn{"256 stencil alpha"}, beside{"256 screen alpha"};
    for (auto* of : {&inTurn, &beside}) {
        of->insert(of->end(), stencil.begin(), stencil.end());
        of->insert(of->end(), half.begin(), half.end());
    }
    EXPECT_EQ(differs["A"], inTurn);
    EXPECT_EQ(differs["B"], beside);
    EXPECT_EQ(differs["D"], beside);
    EXPECT_EQ(differs["E"],
              (std::vector<std::string>{"512 stencil alpha", "1024 stencil alpha", "256 half screen"}));
    // exp(rms) - 1: 35 % with one free number, 15 % with two.
    EXPECT_NEAR(table["fits"][0]["rms_ln_time"].get<double>(), std::log(1.352), 0.01);
    EXPECT_NEAR(table["fits"][2]["rms_ln_time"].get<double>(), std::log(1.147), 0.01);
    EXPECT_NEAR(table["fits"][3]["rms_ln_time"].get<double>(), std::log(1.147), 0.01);
}

TEST_F(Program, WritesPicturesOfTheRightSize) {
    const std::string image = pathOf("image.png"), mask = pathOf("mask.png"), truth = pathOf("truth.png");
    const Outcome outcome = run({"render", "boxes", "--size", "97x61", "-o", image, "--mask", mask, "--truth",
                                 truth, "--steps", pathOf("steps")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Image picture = readImage(image), shadows = readImage(mask);
    EXPECT_EQ(std::tuple(picture.width, picture.height, picture.channels), std::tuple(97, 61, 3));
    EXPECT_EQ(std::tuple(shadows.width, shadows.height, shadows.channels), std::tuple(97, 61, 1));
    EXPECT_EQ(readImage(truth).data.size(), 97u * 61u);
    // White lit, black in shadow, nothing between, and some of both.
    const auto black = std::count(shadows.data.begin(), shadows.data.end(), 0);
    const auto white = std::count(shadows.data.begin(), shadows.data.end(), 255);
    EXPECT_EQ(black + white, 97 * 61);
    EXPECT_GT(std::min(black, white), 100);
    // Top left is sky, and rows come from the top.
    EXPECT_EQ(shadows.data.front(), 255);
    // The causes stand beside the mask, with a legend below.
    const Image causes = readImage(pathOf("mask-causes.png"));
    EXPECT_EQ(causes.channels, 3);
    EXPECT_GT(causes.height, 61);

    const Json plan = Json::parse(run({"plan", "boxes", "--size", "97x61", "--format", "json"}).out);
    std::size_t steps = 0;
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("steps")))
        steps += entry.path().string().ends_with("-colour.png");
    EXPECT_EQ(steps, plan[0]["passes"].size());
}

// The Voodoo2 has no stencil, so that what is chosen there counts elsewhere than the method's usual axes say.
TEST_F(Program, WritesTheBuffersOfWhatIsChosen) {
    const Outcome outcome = run({"render", "boxes", "--size", "48x36", "--profile", "voodoo2", "--method",
                                 "auto", "--steps", pathOf("steps")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json plan = Json::parse(run({"plan", "boxes", "--size", "48x36", "--profile", "voodoo2", "--method",
                                       "auto", "--format", "json"})
                                      .out);
    std::size_t steps = 0;
    for (const auto& entry : std::filesystem::directory_iterator(pathOf("steps"))) {
        steps += entry.path().string().ends_with("-colour.png");
        EXPECT_THAT(entry.path().string(), Not(HasSubstr("stencil")));
    }
    EXPECT_EQ(steps, plan[0]["passes"].size());
}

TEST_F(Program, RefusesToRenderWhatTheChipCantNamingWhatIsMissing) {
    const Outcome outcome =
        run({"render", "--profile", "voodoo2", "--method", "roettger-alpha", "-o", pathOf("image.png")});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("refused"), HasSubstr("destination alpha beside depth")));
    EXPECT_THAT(leftBehind(), IsEmpty());

    const Outcome tooLarge =
        run({"render", "--profile", "voodoo1", "--size", "1024x768", "--format", "json"});
    EXPECT_EQ(tooLarge.status, 1);
    EXPECT_EQ(tooLarge.out, "");
    EXPECT_THAT(tooLarge.err, AllOf(HasSubstr("640x480 at most"), HasSubstr("can run none")));
}

TEST_F(Program, LeavesNothingBehindWhereItCantWrite) {
    const std::string file = write("plain", "mine");
    for (const std::vector<std::string>& output :
         {std::vector<std::string>{"-o", pathOf("nowhere/image.png")},
          {"--mask", pathOf("image.kind")},
          {"-o", file + "/image.png"},
          {"--truth", pathOf("")},
          {"--steps", file},
          {"--steps", file + "/steps"}}) {
        std::vector<std::string> arguments{"render", "--size", "16x16", "--method", "heidmann"};
        arguments.insert(arguments.end(), output.begin(), output.end());
        SCOPED_TRACE(output[0] + " " + output[1]);
        expectRefused(run(arguments), output[1]);
        EXPECT_THAT(leftBehind(), testing::ElementsAre("plain"));
        EXPECT_EQ(contentOf(file), "mine");
    }
}

TEST_F(Program, SaysWhichPathAChipTakesAndWhyNotTheOthers) {
    const auto wordsOf = [&](const std::string& profile) {
        return run({"render", "--size", "32x24", "--profile", profile}).out;
    };
    EXPECT_THAT(wordsOf("tnt"), AllOf(HasSubstr("heidmann: chosen for tnt"), Not(HasSubstr("lacks"))));
    EXPECT_THAT(
        wordsOf("voodoo2"),
        AllOf(HasSubstr("heidmann: not on voodoo2, which lacks\n  stencil ["),
              HasSubstr("roettger-alpha: not on voodoo2, which lacks\n  destination alpha beside depth ["),
              HasSubstr("roettger-screen: chosen for voodoo2")));
    EXPECT_THAT(wordsOf("ps2"),
                AllOf(HasSubstr("heidmann: not on ps2"), HasSubstr("blending of destination alpha ["),
                      HasSubstr("roettger-screen: not on ps2"), HasSubstr("with a varying source colour ["),
                      HasSubstr("screen-texture: chosen for ps2")));
}

TEST_F(Program, MarksThePathInTheMatrix) {
    const Outcome outcome = run({"matrix", "roettger", "--size", "32x24", "--frames", "0", "--profile",
                                 "ideal,tnt,geforce2mx,voodoo1,voodoo2,voodoo3,ps2", "--format", "json"});
    std::vector<std::string> chosen;
    for (const Json& cell : Json::parse(outcome.out))
        if (cell["chosen"])
            chosen.push_back(cell["profile"].get<std::string>() + " " + cell["method"].get<std::string>());
    EXPECT_THAT(chosen, testing::UnorderedElementsAre("ideal heidmann", "tnt heidmann", "geforce2mx heidmann",
                                                      "voodoo1 roettger-screen", "voodoo2 roettger-screen",
                                                      "voodoo3 roettger-screen", "ps2 screen-texture"));
}

}  // namespace cli_test
}  // namespace gnomon
