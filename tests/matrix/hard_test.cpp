// The hard cases in scenes/hard keep what they promise.

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "matrix/hard_run.h"
#include "matrix/lab.h"
#include "predict/causes.h"
#include "scenes.h"

namespace gnomon {
namespace hard_test {

const std::filesystem::path kScenes = kSource / "scenes";

Scene hardScene(const std::string& id) {
    return loadScene(findScene(id, kScenes));
}

/// The result of one promise, and the command that shows it.
struct Kept {
    Cell cell{};
    std::string command{};
};

Kept keep(Lab& lab, const HardCell& promise) {
    return {run(lab, resolve(promise, kSource / "profiles")),
            lab.scene().id + " " + argumentsOf(promise) + " (line " + std::to_string(promise.line) + ")"};
}

/// The cause of most wrong pixels.
std::string mainCause(const Cell& cell) {
    const auto most = std::max_element(cell.causes.begin(), cell.causes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == cell.causes.end() ? "" : most->first;
}

class HardCases : public testing::TestWithParam<std::string> {};

TEST_P(HardCases, FailWhereTheySayAndAreExactWhereTheySay) {
    const Scene scene = hardScene(GetParam());
    ASSERT_TRUE(scene.hard);
    Lab lab(scene);
    for (const HardCell& promise : scene.hard->fails) {
        const auto [cell, command] = keep(lab, promise);
        EXPECT_TRUE(cell.verdict == Verdict::Wrong || cell.verdict == Verdict::Edge)
            << command << ": " << resultOf(cell);
        EXPECT_GT(cell.wrongEdge + cell.wrongInterior, 0) << command;
        EXPECT_EQ(mainCause(cell), promise.cause) << command << ": " << resultOf(cell);
        EXPECT_EQ(cell.unpredicted, 0) << command;
    }
    for (const HardCell& promise : scene.hard->exact) {
        const auto [cell, command] = keep(lab, promise);
        EXPECT_EQ(cell.verdict, Verdict::Exact) << command << ": " << resultOf(cell);
        EXPECT_EQ(cell.unpredicted, 0) << command;
    }
}

// Without a light there is no shadow that a method could miss.
TEST_P(HardCases, HaveAMethodThatMustBeWrongAndOneThatMustBeExact) {
    const Scene scene = hardScene(GetParam());
    ASSERT_TRUE(scene.hard);
    EXPECT_EQ(scene.hard->fails.empty(), scene.lights.empty());
    EXPECT_FALSE(scene.hard->exact.empty());
    EXPECT_EQ(scene.frames.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, HardCases, testing::ValuesIn(hardSceneIds(kScenes)), [](const auto& test) {
    std::string name = test.param.substr(5);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// The command line turns it into a line of the scene file (cli_test).
TEST(HardSuite, RefusesCausesThatNoPixelHas) {
    HardCell cell{.method = "heidmann", .cause = "eye inside a volume"};
    EXPECT_EQ(resolve(cell, kSource / "profiles").cause, Cause::EyeInside);
    cell.cause = "bad\nluck";
    try {
        resolve(cell, kSource / "profiles");
        ADD_FAILURE() << "taken";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "no such cause 'bad luck'");
    }
}

TEST(HardSuite, HasEveryFamily) {
    std::set<std::string> families;
    for (const std::string& id : hardSceneIds(kScenes)) families.insert(hardScene(id).hard->family);
    for (const char* family : {
             "-0.0 beside 0",
             "16-bit depth",
             "Moebius caster",
             "T-junctions",
             "caster behind the eye",
             "coordinates offset by 1e6",
             "coordinates scaled by 1e-4",
             "coordinates scaled by 1e6",
             "coplanar casters",
             "degenerate triangles",
             "duplicate triangles",
             "empty scene",
             "everything in shadow",
             "eye at the light",
             "eye inside a caster",
             "eye inside a volume",
             "eye inside several volumes",
             "eye on a side of a volume",
             "far caster, infinite volume",
             "five-bit mask, dithered",
             "five-bit mask, undithered",
             "grazing light",
             "inconsistently wound caster",
             "light at infinity",
             "light between eye and near plane",
             "light in the plane of a face",
             "light inside a caster",
             "light on a face",
             "light on the line of an edge",
             "many overlapping volumes",
             "near plane through a caster",
             "near plane through a volume",
             "nesting 1 to 12",
             "nesting 3",
             "nesting in five bits",
             "no caster",
             "no light",
             "non-convex layers",
             "non-manifold caster",
             "one-sided wall from behind",
             "open caster",
             "self-intersecting caster",
             "several lights",
             "shadow-map bias",
             "shadow-map resolution",
             "sky inside infinite volumes",
             "slivers",
             "stencil saturates at 255",
             "stencil wraps at 256",
             "sub-pixel casters",
             "view along the light",
             "wide view",
         })
        EXPECT_TRUE(families.erase(family)) << family;
    EXPECT_THAT(families, testing::IsEmpty()) << "not in this list";
}

// An empty scene, one without casters, one without lights: no method may fail there, whatever the chip.
TEST(HardSuite, DrawsNothingWithoutFailing) {
    for (const char* id : {"hard/empty", "hard/no-caster", "hard/no-light"}) {
        const Scene scene = hardScene(id);
        Lab lab(scene);
        for (const char* profile : {"ideal", "voodoo2"}) {
            for (const NamedMethod& method : namedMethods()) {
                const Cell cell = lab.run(chip(profile), method.axes, 64, 48, 0);
                EXPECT_TRUE(cell.verdict == Verdict::Exact || cell.verdict == Verdict::Refused)
                    << id << " " << method.id << " " << profile << ": " << resultOf(cell);
            }
        }
        for (const Silhouette silhouette : {Silhouette::Manifold, Silhouette::PerTriangle})
            EXPECT_EQ(resultOf(lab.run(chip("ideal"), with(method("carmack"), silhouette), 64, 48, 0)),
                      "exact 0/0")
                << id;
    }
}

TEST(HardSuite, ShowsTheAmbientPartWithoutALight) {
    const Scene scene = hardScene("hard/no-light");
    Lab lab(scene);
    Pictures pictures;
    lab.run(chip("ideal"), method("carmack"), 64, 48, 0, &pictures);
    const Object& floor = scene.objects[0];
    const std::size_t bottom = (std::size_t(47) * 64 + 32) * 3;
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(pictures.image.data[bottom + std::size_t(k)], floor.colour[k] * scene.ambient * 255, 1);
    EXPECT_EQ(pictures.mask.data, std::vector<std::uint8_t>(64 * 48, 255));
    EXPECT_EQ(pictures.truth.data, pictures.mask.data);
    EXPECT_EQ(pictures.judgement.pixels.size(), 64u * 48);
}

}  // namespace hard_test
}  // namespace gnomon
