// The cells that users come for: exact where a method must be, wrong with the right cause where it must be,
// and refused for the right reasons.

#include "matrix/lab.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "scene/primitives.h"
#include "scenes.h"

namespace gnomon {
namespace lab_test {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Pair;
using testing::SizeIs;

const std::filesystem::path kData = std::filesystem::path(GNOMON_SHARED) / "data";

std::vector<std::string> lacks(const Cell& cell) {
    std::vector<std::string> whats;
    for (const Missing& m : cell.missing) whats.push_back(m.what);
    return whats;
}

struct FrameCase {
    std::string scene;
    int width, height, frame;
};
void PrintTo(const FrameCase& c, std::ostream* out) {
    *out << c.scene << c.width << "x" << c.height << "_" << c.frame;
}
std::string nameOf(const testing::TestParamInfo<FrameCase>& info) {
    return testing::PrintToString(info.param);
}

class ShippedFrame : public testing::TestWithParam<FrameCase> {
  protected:
    Cell run(const std::string& profile, const Axes& axes) {
        const FrameCase& c = GetParam();
        return m_lab.run(chip(profile), axes, c.width, c.height, c.frame);
    }
    /// Tied pixels are below 0.5 % of a frame, as the design says; more would hide leaks.
    static bool tiesAreFew(const Cell& cell) { return (cell.tiedTruth + cell.tiedCount) * 200 < cell.pixels; }

    Lab m_lab{shippedScene(GetParam().scene)};
};

class ConvexCasters : public ShippedFrame {};

TEST_P(ConvexCasters, AreExactWithEveryStoreThatTheChipHas) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> paths{
        {"ideal",
         {"heidmann", "roettger-alpha", "roettger-screen", "roettger-alpha-max", "roettger-screen-max"}},
        {"tnt", {"heidmann", "roettger-alpha", "roettger-screen"}},
        {"geforce2mx", {"heidmann", "roettger-alpha", "roettger-screen"}},
        {"voodoo1", {"roettger-screen"}},
        {"voodoo2", {"roettger-screen"}},
        {"voodoo3", {"roettger-screen"}},
        {"ps2", {"screen-texture"}}};
    for (const auto& [profile, methods] : paths) {
        for (const std::string& id : methods) {
            const Cell cell = run(profile, method(id));
            EXPECT_EQ(resultOf(cell), "exact 0/0") << cell.id();
            EXPECT_TRUE(tiesAreFew(cell)) << cell.id() << ": " << cell.tiedTruth << " + " << cell.tiedCount;
        }
    }
}

// The unshadowed frame is wrong in every shadow, so a comparison that sees nothing fails here.
TEST_P(ConvexCasters, AreWrongWithoutShadows) {
    const Cell cell = run("ideal", method("none"));
    EXPECT_EQ(cell.verdict, Verdict::Wrong);
    EXPECT_GT(cell.wrongInterior, 100);
    EXPECT_THAT(cell.causes, ElementsAre(Pair("no shadow is drawn", cell.wrongEdge + cell.wrongInterior)));
}

INSTANTIATE_TEST_SUITE_P(Frames, ConvexCasters,
                         testing::Values(FrameCase{"roettger", 256, 256, 0},
                                         FrameCase{"roettger", 320, 240, 11},
                                         FrameCase{"roettger", 256, 256, 23},
                                         FrameCase{"roettger", 320, 240, 42}, FrameCase{"boxes", 256, 256, 0},
                                         FrameCase{"boxes", 320, 240, 7}, FrameCase{"boxes", 256, 256, 29},
                                         FrameCase{"boxes", 320, 240, 51}),
                         nameOf);

class Knot : public ShippedFrame {};

// The stencil counts without limits, so what is wrong in other stores is the arithmetic's doing.
TEST_P(Knot, IsExactInTheStencil) {
    const Cell cell = run("ideal", method("heidmann"));
    EXPECT_EQ(resultOf(cell), "exact 0/0");
    EXPECT_TRUE(tiesAreFew(cell));
}

// Three fronts of one volume come before its first back.
TEST_P(Knot, ClampsDoublingOfTwoLevels) {
    for (const char* id : {"roettger-screen", "roettger-alpha", "screen-texture"}) {
        const Cell cell = run("ideal", method(id));
        EXPECT_EQ(cell.verdict, Verdict::Wrong) << id;
        EXPECT_THAT(cell.causes, ElementsAre(Pair("mask clamps", cell.wrongEdge + cell.wrongInterior))) << id;
    }
    EXPECT_EQ(run("voodoo2", method("roettger-screen")).verdict, Verdict::Wrong);
}

TEST_P(Knot, ClampsLessWithMoreLevels) {
    int before = GetParam().width * GetParam().height;
    for (const int levels : {1, 2, 4, 7}) {
        Axes axes = method("roettger-screen");
        axes.levels = levels;
        const Cell cell = run("ideal", axes);
        EXPECT_LT(cell.wrongEdge + cell.wrongInterior, before) << levels;
        EXPECT_THAT(cell.causes, ElementsAre(Pair("mask clamps", cell.wrongEdge + cell.wrongInterior)))
            << levels;
        before = cell.wrongEdge + cell.wrongInterior;
    }
}

// A colour of 8 bits sticks at 1 of 255 after eight fronts.
TEST_P(Knot, UnderflowsHalving) {
    for (const char* id : {"roettger-screen-max", "roettger-alpha-max"}) {
        const Cell cell = run("ideal", method(id));
        EXPECT_EQ(cell.verdict, Verdict::Wrong) << id;
        EXPECT_THAT(cell.causes, ElementsAre(Pair("mask underflows", cell.wrongEdge + cell.wrongInterior)))
            << id;
    }
}

INSTANTIATE_TEST_SUITE_P(Frames, Knot,
                         testing::Values(FrameCase{"knot", 256, 256, 0}, FrameCase{"knot", 256, 256, 22},
                                         FrameCase{"knot", 320, 240, 41}),
                         nameOf);

class KnotByTriangles : public ShippedFrame {};

// A triangle's volume is convex: no front before its own back but one.
TEST_P(KnotByTriangles, IsMendedByAVolumePerTriangle) {
    for (const char* id : {"heidmann", "roettger-screen", "roettger-alpha"})
        EXPECT_EQ(resultOf(run("ideal", with(method(id), Silhouette::PerTriangle))), "exact 0/0") << id;
}

INSTANTIATE_TEST_SUITE_P(Frames, KnotByTriangles,
                         testing::Values(FrameCase{"knot", 256, 256, 7}, FrameCase{"knot", 256, 256, 22},
                                         FrameCase{"knot", 256, 256, 41}),
                         nameOf);

/// A floor under a box that shades it, and an eye in the shadow between them that looks out of it.
Scene eyeInShadow() {
    Scene scene;
    scene.id = "eye-in-shadow";
    Object floor{.name = "floor", .mesh = rectangle({20, 20}), .casts = false};
    Object lid{.name = "lid", .mesh = box({2.3, 0.4, 2.1})};
    for (glm::vec3& p : lid.mesh.positions) p += glm::vec3(0.13f, 3.07f, 0.11f);
    Object post{.name = "post", .mesh = box({0.7, 1.3, 0.6})};
    for (glm::vec3& p : post.mesh.positions) p += glm::vec3(0.37f, 0.71f, -3.93f);
    scene.objects = {floor, lid, post};
    scene.lights = {{.position = {0.47f, 9.31f, 0.73f, 1}}};
    scene.frames = {{.eye = {0.17f, 1.61f, 0.29f}, .target = {0.31f, 0.47f, -4.13f}, .fovDegrees = 67}};
    return scene;
}

TEST(EyeInsideAVolume, MakesZpassWrongEverywhereAndNearCapMendsIt) {
    Lab lab(eyeInShadow());
    const Cell zpass = lab.run(chip("ideal"), method("heidmann"), 256, 256, 0);
    EXPECT_EQ(zpass.verdict, Verdict::Wrong);
    EXPECT_GT(zpass.wrongInterior, zpass.pixels / 4);
    EXPECT_THAT(zpass.causes,
                ElementsAre(Pair("eye inside a volume", zpass.wrongEdge + zpass.wrongInterior)));

    for (const char* id : {"heidmann", "roettger-alpha", "roettger-screen"}) {
        const Cell cell = lab.run(chip("ideal"), with(method(id), Count::ZpassCap), 256, 256, 0);
        EXPECT_EQ(resultOf(cell), "exact 0/0") << id;
        EXPECT_LT((cell.tiedTruth + cell.tiedCount) * 200, cell.pixels) << id;
    }
}

TEST(EyeInsideAVolume, GivesTheStencilPathANearCap) {
    Lab inside(eyeInShadow()), outside(shippedScene("boxes"));
    EXPECT_EQ(inside.path(chip("tnt"), 64, 64, 0).back().axes.count, Count::ZpassCap);
    EXPECT_EQ(outside.path(chip("tnt"), 64, 64, 0).back().axes.count, Count::Zpass);
}

struct Refusal {
    std::string profile, method;
    std::vector<std::string> reasons;  ///< each begins one of the phrases that name what is missing
};
void PrintTo(const Refusal& r, std::ostream* out) {
    *out << r.profile << "/" << r.method;
}

class RefusedMethod : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedMethod, NamesWhatTheChipLacks) {
    static Lab lab(shippedScene("roettger"));
    const Cell cell = lab.run(chip(GetParam().profile), method(GetParam().method), 320, 240, 0);
    EXPECT_EQ(cell.verdict, Verdict::Refused);
    EXPECT_THAT(lacks(cell), SizeIs(GetParam().reasons.size()));
    for (const std::string& reason : GetParam().reasons)
        EXPECT_THAT(lacks(cell), Contains(testing::StartsWith(reason)));
    for (const Missing& m : cell.missing) EXPECT_FALSE(m.source.empty()) << m.what;
    EXPECT_EQ(cell.digest, "");
}

std::vector<Refusal> refusals() {
    std::vector<Refusal> all{
        {"tnt", "roettger-alpha-max", {"blend equation max"}},
        {"tnt", "roettger-screen-max", {"blend equation max"}},
        {"ps2", "heidmann", {"stencil"}},
        {"ps2", "roettger-alpha", {"blending of destination alpha"}},
        {"ps2", "roettger-screen", {"blend dst_color zero with a varying source colour"}},
        {"ps2",
         "roettger-screen-max",
         {"blend equation max", "blend dst_color zero with a varying source colour"}}};
    for (const char* voodoo : {"voodoo1", "voodoo2", "voodoo3"}) {
        all.push_back({voodoo, "heidmann", {"stencil"}});
        all.push_back(
            {voodoo,
             "roettger-alpha",
             {"destination alpha beside depth", "alpha blend factors dst_color one",
              "alpha blend factors dst_color zero", "alpha blend factors one_minus_dst_color zero"}});
        all.push_back({voodoo, "roettger-screen-max", {"blend equation max"}});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(Chips, RefusedMethod, testing::ValuesIn(refusals()), [](const auto& test) {
    std::string name = test.param.profile + "_" + test.param.method;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Refused, FramesBeyondTheChipWithTheNumbers) {
    Lab lab(shippedScene("roettger"));
    const Cell cell = lab.run(chip("voodoo1"), method("roettger-screen"), 1024, 768, 0);
    EXPECT_EQ(cell.verdict, Verdict::Refused);
    EXPECT_THAT(lacks(cell), Contains(AllOf(HasSubstr("1024x768"), HasSubstr("640x480"))));
}

TEST(Refused, MasksBeyondTheLargestTextureWithTheNumbers) {
    Lab lab(shippedScene("roettger"));
    const Cell cell = lab.run(chip("voodoo2"), method("screen-texture"), 320, 240, 0);
    EXPECT_EQ(cell.verdict, Verdict::Refused);
    EXPECT_THAT(lacks(cell), ElementsAre(AllOf(HasSubstr("512x256"), HasSubstr("256 at most"))));
    EXPECT_EQ(lab.run(chip("voodoo2"), method("roettger-half"), 320, 240, 0).missing, std::vector<Missing>{});
}

// Two chips with the same buffers see the same plan, and pictures are drawn anew where they are asked for.
TEST(Lab, GivesTheSameResultWhetherDrawnOrKnown) {
    Lab lab(shippedScene("boxes"));
    const Cell drawn = lab.run(chip("ideal"), method("roettger-screen"), 96, 64, 3);
    const Cell known = lab.run(chip("tnt"), method("roettger-screen"), 96, 64, 3);
    Pictures pictures;
    const Cell again = lab.run(chip("tnt"), method("roettger-screen"), 96, 64, 3, &pictures);
    EXPECT_EQ(known.profile, "tnt");
    EXPECT_EQ(known.digest, drawn.digest);
    EXPECT_EQ(again.digest, drawn.digest);
    EXPECT_EQ(pictures.image.width, 96);
    EXPECT_EQ(pictures.mask.data.size(), 96u * 64u);
    EXPECT_EQ(resultOf(again), resultOf(drawn));
}

// The knot's shadow volume is folded over itself; the stencil has room for that, doubling has not.
TEST(Lab, WarnsWhereVolumesMayNestDeeperThanTheMethodCounts) {
    Lab lab(shippedScene("knot"));
    const auto cellOf = [&](const std::string& profile, const std::string& id) {
        return lab.run(chip(profile), method(id), 160, 120, 0);
    };
    for (const char* id : {"roettger-screen", "screen-zfail"}) {
        const Cell deep = cellOf("ideal", id);
        EXPECT_GT(deep.nesting.levels, 2) << id;
        EXPECT_THAT(deep.warnings, testing::ElementsAre(testing::StartsWith("resolves 2 levels; up to ")))
            << id;
        EXPECT_EQ(cellOf("tnt", id).warnings, deep.warnings) << id;
    }
    EXPECT_GT(cellOf("ideal", "heidmann").nesting.fronts, 2);
    EXPECT_THAT(cellOf("ideal", "heidmann").warnings, testing::IsEmpty());
    EXPECT_EQ(cellOf("ideal", "none").nesting, Nesting{});
    EXPECT_EQ(cellOf("voodoo2", "heidmann").nesting, Nesting{});  // refused
}

TEST(Lab, TellsFramesMethodsAndSizesApart) {
    Lab lab(shippedScene("boxes"));
    const Cell first = lab.run(chip("ideal"), method("roettger-screen"), 96, 64, 3);
    EXPECT_NE(lab.run(chip("ideal"), method("none"), 96, 64, 3).digest, first.digest);
    EXPECT_NE(lab.run(chip("voodoo2"), method("roettger-screen"), 96, 64, 3).digest, first.digest) << "565";
    EXPECT_NE(lab.run(chip("ideal"), method("roettger-screen"), 96, 64, 4).digest, first.digest);
    EXPECT_NE(lab.run(chip("ideal"), method("roettger-screen"), 64, 96, 3).digest, first.digest);
    EXPECT_EQ(lab.run(chip("ideal"), method("roettger-screen"), 96, 64, 3).digest, first.digest);
}

TEST(Lab, FailsTheCellWhoseDrawingThrowsAndNotTheNext) {
    Lab lab(shippedScene("roettger"));
    const auto run = [&](const std::function<void(Surface&, std::size_t)>& afterPass) {
        return lab.run(chip("ideal"), method("heidmann"), 64, 64, 0, nullptr, afterPass);
    };
    const Cell failed = run([](Surface&, std::size_t) { throw std::runtime_error("disk full"); });
    EXPECT_EQ(resultOf(failed), "failed 0/0disk full");
    EXPECT_EQ(run({}).verdict, Verdict::Exact);
}

/// The objects with their triangles, and the corners of each triangle, in another order.
Scene permuted(Scene scene) {
    std::mt19937 random(7);
    for (Object& object : scene.objects) {
        std::shuffle(object.mesh.triangles.begin(), object.mesh.triangles.end(), random);
        for (glm::uvec3& t : object.mesh.triangles)
            if (random() % 2) t = {t.y, t.z, t.x};
    }
    std::shuffle(scene.objects.begin(), scene.objects.end(), random);
    return scene;
}

TEST(OrderOfTriangles, ChangesNoUntiedPixel) {
    for (const char* id : {"boxes", "knot"}) {
        Lab lab(shippedScene(id)), other(permuted(shippedScene(id)));
        for (const char* m : {"heidmann", "screen-texture"}) {
            Pictures a, b;
            lab.run(chip("ideal"), method(m), 256, 256, 22, &a);
            other.run(chip("ideal"), method(m), 256, 256, 22, &b);
            EXPECT_EQ(a.truth, b.truth);
            int different = 0;
            for (std::size_t i = 0; i < a.mask.data.size(); ++i) {
                const bool tied = a.judgement.pixels[i] == PixelVerdict::Tied ||
                                  b.judgement.pixels[i] == PixelVerdict::Tied;
                different += !tied && a.mask.data[i] != b.mask.data[i];
            }
            EXPECT_EQ(different, 0) << id << " " << m;
        }
    }
}

struct MeshCase {
    std::string file;
    int knownInterior = 0;  ///< wrong pixels away from the boundary that are known and not yet explained
};
void PrintTo(const MeshCase& c, std::ostream* out) {
    *out << c.file;
}

class RealMesh : public testing::TestWithParam<MeshCase> {};

// The prototype left 2 of 262,144 pixels outside of its ties on the armadillo: single pixels where faces of
// several triangles meet within the depth buffer's interpolation. A leak would be more, and inside.
TEST_P(RealMesh, IsExactInTheStencilButForSinglePixels) {
    const std::filesystem::path file = kData / GetParam().file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    Scene scene = loadScene(file);
    scene.lights.resize(1);  // the crypt's 248 take minutes
    Lab lab(scene);
    const Cell cell = lab.run(chip("ideal"), with(method("heidmann"), Count::ZpassCap), 256, 256, 0);
    ASSERT_NE(cell.verdict, Verdict::Refused) << resultOf(cell);
    ASSERT_NE(cell.verdict, Verdict::Failed) << resultOf(cell);
    EXPECT_LE(cell.wrongInterior, GetParam().knownInterior) << resultOf(cell);
    EXPECT_LE(cell.wrongEdge + cell.wrongInterior, 3) << resultOf(cell);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealMesh,
                         testing::Values(MeshCase{"meshes/armadillo.ply"},
                                         MeshCase{"meshes/bunny_zipper.ply"},
                                         MeshCase{"scenes/sponza_crytek.glb", 1},
                                         MeshCase{"scenes/lost_empire.glb"},
                                         MeshCase{"scenes/crypt_248lights.glb"}),
                         [](const auto& test) {
                             std::string name = test.param.file;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

}  // namespace lab_test
}  // namespace gnomon
