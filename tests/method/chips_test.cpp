// Which methods run on which chip: the verdicts of hardware.md, section 2(b), each by a plan and what the
// chip lacks for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "method/method.h"

namespace gnomon {
namespace chips_test {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::StartsWith;

Profile chip(const std::string& id) {
    return loadProfile(std::filesystem::path(GNOMON_SOURCE) / "profiles" / (id + ".toml"));
}

/// What @p chipId lacks for one light and three volumes, in a frame that every chip but PlayStation holds.
std::vector<Missing> lacks(const std::string& chipId, const std::string& method) {
    const FrameShape frame{.width = 256, .height = 192, .lights = {{.volumes = 3}}};
    const Profile profile = chip(chipId);
    return missing(profile, planFrame(findMethod(method)->axes, frame, profile));
}

/// Of the methods that need neither programs nor depth textures, those that run.
std::vector<std::string> methodsOf(const std::string& chipId) {
    std::vector<std::string> methods;
    for (const char* method : {"heidmann", "carmack", "roettger-alpha", "roettger-alpha-max",
                               "roettger-screen", "roettger-screen-max", "screen-texture", "screen-zfail"})
        if (lacks(chipId, method).empty()) methods.push_back(method);
    return methods;
}

struct Verdict2b {
    std::vector<std::string> chips{}, methods{};
};
void PrintTo(const Verdict2b& v, std::ostream* out) {
    *out << v.chips.front();
}

class ChipVerdict : public testing::TestWithParam<Verdict2b> {};

TEST_P(ChipVerdict, IsWhatThePlansNeedAndTheChipHas) {
    for (const std::string& id : GetParam().chips) EXPECT_EQ(methodsOf(id), GetParam().methods) << id;
}

const std::vector<std::string> kScreen{"roettger-screen", "screen-texture", "screen-zfail"};
const std::vector<std::string> kScreenAndAlpha{"roettger-alpha", "roettger-screen", "screen-texture",
                                               "screen-zfail"};
const std::vector<std::string> kAllButMaximum{"heidmann",        "carmack",        "roettger-alpha",
                                              "roettger-screen", "screen-texture", "screen-zfail"};
const std::vector<std::string> kAll{"heidmann",           "carmack",         "roettger-alpha",
                                    "roettger-alpha-max", "roettger-screen", "roettger-screen-max",
                                    "screen-texture",     "screen-zfail"};

INSTANTIATE_TEST_SUITE_P(
    Section2b, ChipVerdict,
    testing::Values(
        // "Screen variant only." A mask of 256 texels still fits a texture.
        Verdict2b{{"voodoo1", "voodoo2", "banshee", "voodoo3", "vsa100-16"}, kScreen},
        Verdict2b{{"i740", "ragepro", "gamecube-888", "tnt-565", "g400-565"}, kScreen},
        Verdict2b{{"geforce2mx-565", "xbox-565", "psp-565"},
                  {"roettger-screen", "roettger-screen-max", "screen-texture", "screen-zfail"}},
        // "Both variants", and a stencil to check them against.
        Verdict2b{{"vsa100-32", "tnt", "tnt2", "g200", "g400", "rage128"}, kAllButMaximum},
        Verdict2b{{"geforce256", "geforce2mx", "xbox", "o2", "realityengine"}, kAll},
        // Both, and no stencil.
        Verdict2b{{"dreamcast", "gamecube"}, kScreenAndAlpha},
        // Doubling by FIX, the mask over the scene only as a texture, no farther depth test.
        Verdict2b{{"ps2", "ps2-5551"}, {"screen-texture"}},
        // Its stencil is its alpha, which blending can't touch.
        Verdict2b{{"psp", "psp-4444", "psp-5551"},
                  {"heidmann", "carmack", "roettger-screen", "roettger-screen-max", "screen-texture",
                   "screen-zfail"}},
        // A stencil of four bits, no alpha, no textures.
        Verdict2b{{"elan"}, {"heidmann", "carmack", "roettger-screen", "screen-zfail"}},
        // No doubling, or none that is of use.
        Verdict2b{{"riva128", "n64", "n64-8888", "virge", "virge-888", "verite", "ds"}, {}},
        // No depth.
        Verdict2b{{"ps1"}, {}}),
    [](const auto& test) {
        std::string id = test.param.chips.front();
        std::replace(id.begin(), id.end(), '-', '_');
        return id;
    });

// Why not: the phrase with the source that says so.
TEST(ChipRefusals, SayWhatIsLackingAndWhoSaysSo) {
    const auto isMissing = [](const std::string& what, const std::string& source) {
        return Contains(
            testing::AllOf(Field(&Missing::what, what), Field(&Missing::source, StartsWith(source))));
    };
    EXPECT_THAT(lacks("ps1", "none"), isMissing("a depth buffer", "PSXSPX: no depth buffer"));
    EXPECT_THAT(lacks("riva128", "roettger-screen"), isMissing("blend dst_color one", "derived: ENVY"));
    EXPECT_THAT(lacks("virge", "roettger-screen"), isMissing("blend dst_color one", "86VIRGE"));
    EXPECT_THAT(lacks("ps2", "roettger-screen"),
                isMissing("blend dst_color zero with a varying source colour", "derived: PS2TEK"));
    EXPECT_THAT(lacks("ps2", "counter"), isMissing("depth function gequal", "PS2TEK"));
    EXPECT_THAT(lacks("psp", "roettger-alpha"), isMissing("blending of destination alpha", "PPSSPP"));
    EXPECT_THAT(lacks("voodoo1", "roettger-alpha"), isMissing("destination alpha beside depth", "GL-SST1"));
    EXPECT_THAT(lacks("gamecube-888", "roettger-alpha"), isMissing("destination alpha", "DOLPHIN"));
    EXPECT_THAT(lacks("gamecube", "heidmann"), isMissing("stencil", "DOLPHIN"));
    EXPECT_THAT(lacks("n64", "roettger-screen"),
                isMissing("blend dst_color zero with a varying source colour", "derived: ANGRY"));
}

TEST(ChipRefusals, NameTheFrameThatTheDsCantHold) {
    const FrameShape frame{.width = 320, .height = 240, .lights = {{.volumes = 3}}};
    const Profile ds = chip("ds");
    EXPECT_THAT(missing(ds, planFrame(findMethod("none")->axes, frame, ds)),
                ElementsAre(Field(&Missing::what, "a frame of 320x240 (256x192 at most)")));
}

// A scene without shadows needs nothing but depth.
TEST(Chips, DrawTheUnshadowedSceneIfTheyHaveDepth) {
    for (const std::string& id : profileIds(std::filesystem::path(GNOMON_SOURCE) / "profiles"))
        if (id == "ps1")
            EXPECT_THAT(lacks(id, "none"), testing::Not(IsEmpty()));
        else
            EXPECT_THAT(lacks(id, "none"), IsEmpty()) << id;
}

}  // namespace chips_test
}  // namespace gnomon
