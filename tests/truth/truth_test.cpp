#include "truth/truth.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "scenes.h"

namespace gnomon {
namespace truth_test {

using ::testing::Each;

/// A rectangle at y = 1 over a floor at y = 0, and the answers that geometry gives.
struct RectangleOverFloor {
    glm::vec4 light{0.3f, 3, 0.2f, 1};
    float half = 0.5f;
    Camera camera{.eye = {2, 2.5f, 4}, .target = {0.3f, 0, 0}};

    Scene scene() const {
        Scene scene;
        scene.objects = {
            {.mesh = rectangle({-half, 1, -half}, {0, 0, 2 * half}, {2 * half, 0, 0})},
            floorOf(2),
        };
        return scene;
    }

    /// Whether the rectangle hides the light from @p x.
    bool blocks(const glm::dvec3& x) const {
        if (x.y >= 1) return false;
        const glm::dvec3 way = glm::dvec3(light) - double(light.w) * x;
        const glm::dvec3 at = x + (1 - x.y) / way.y * way;
        return std::abs(at.x) < half && std::abs(at.z) < half;
    }

    struct Seen {
        Shadow shadow = Shadow::Background;
        double t = 0;
        bool onFloor = false;
    };

    Seen see(const View& view, double x, double y) const {
        const glm::dvec3 d = rayDirection(view, x, y);
        const double up = (1 - view.eye.y) / d.y;
        const glm::dvec3 top = view.eye + up * d;
        if (up > 0 && std::abs(top.x) < half && std::abs(top.z) < half) return {Shadow::Lit, up};
        const double down = -view.eye.y / d.y;
        const glm::dvec3 at = view.eye + down * d;
        if (down < 0 || std::abs(at.x) > 2 || std::abs(at.z) > 2) return {};
        return {blocks(at) ? Shadow::InShadow : Shadow::Lit, down, true};
    }
};

/// Calls @p check(index, x, y) for each pixel's centre, y up.
template <class Check>
void forEachPixel(const Truth& truth, Check&& check) {
    for (int row = 0; row < truth.height; ++row) {
        for (int x = 0; x < truth.width; ++x)
            check(static_cast<std::size_t>(row) * truth.width + x, x + 0.5, truth.height - 1 - row + 0.5);
    }
}

Truth trace(const Scene& scene, const glm::vec4& light, const View& view,
            const DepthTies& ties = depthTies(24)) {
    return Tracer(scene, Light{.position = light}).trace(view, ties);
}

std::size_t countOf(const Truth& truth, Tie tie) {
    return static_cast<std::size_t>(std::count(truth.tie.begin(), truth.tie.end(), tie));
}

std::size_t countOf(const Truth& truth, Shadow shadow) {
    return static_cast<std::size_t>(std::count(truth.shadow.begin(), truth.shadow.end(), shadow));
}

TEST(DepthTies, AreOneQuantumAndEightOf24Bits) {
    EXPECT_EQ(depthTies(24).truthQuantum, std::ldexp(1.0, -24));
    EXPECT_EQ(depthTies(24).countBand, std::ldexp(8.0, -24));
    EXPECT_EQ(depthTies(32).countBand, std::ldexp(8.0, -24));
    EXPECT_EQ(depthTies(16).truthQuantum, std::ldexp(1.0, -16));
    EXPECT_EQ(depthTies(16).countBand, std::ldexp(1.0, -16) + std::ldexp(8.0, -24));
}

class TracerAtSize : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(TracerAtSize, ProjectsARectangleOnTheFloor) {
    for (const glm::vec4 light : {glm::vec4(0.3f, 3, 0.2f, 1), glm::vec4(0, 0.8f, 0.6f, 0)}) {
        const RectangleOverFloor world{.light = light};
        const View view = viewOf(world.camera, GetParam().first, GetParam().second);
        const Truth truth = trace(world.scene(), world.light, view);
        forEachPixel(truth, [&](std::size_t i, double x, double y) {
            if (truth.tie[i] == Tie::None) {
                ASSERT_EQ(truth.shadow[i], world.see(view, x, y).shadow) << x << " " << y;
            }
        });
        if (view.width > 1) {
            EXPECT_GT(countOf(truth, Shadow::Lit), 0u);
            EXPECT_GT(countOf(truth, Shadow::InShadow), 0u);
            EXPECT_GT(countOf(truth, Shadow::Background), 0u);
        }
        // Outlines of some pixels per row, each tied in 2/256 of them.
        EXPECT_LT(truth.shadow.size() - countOf(truth, Tie::None), 5 + truth.shadow.size() / 200);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TracerAtSize,
                         testing::Values(std::pair(1, 1), std::pair(64, 48), std::pair(333, 77),
                                         std::pair(256, 256)),
                         [](const auto& test) {
                             return std::to_string(test.param.first) + "x" +
                                    std::to_string(test.param.second);
                         });

// Also proves that the four corners of the square of 1/256 pixel around the sample are enough: a whole grid
// of points in it finds no other tie on straight boundaries.
TEST(TracerTies, AreWhereTheAnswerChangesNearby) {
    const RectangleOverFloor world;
    const View view = viewOf(world.camera, 700, 700);
    for (const double quantum : {0.0, std::ldexp(1.0, -24), std::ldexp(1.0, -16), std::ldexp(1.0, -12)}) {
        const Truth truth = trace(world.scene(), world.light, view, {quantum, 0});
        std::size_t tied = 0;
        forEachPixel(truth, [&](std::size_t i, double x, double y) {
            const auto seen = world.see(view, x, y);
            bool changes = false;
            for (int k = 0; k < 25; ++k) {
                const double dx = (k % 5 - 2) / 512.0, dy = (k / 5 - 2) / 512.0;
                changes = changes || world.see(view, x + dx, y + dy).shadow != seen.shadow;
            }
            if (seen.onFloor) {
                const double dz = quantum * seen.t * seen.t / view.nearPlane;
                for (const double shift : {-dz, dz}) {
                    const glm::dvec3 moved = view.eye + (seen.t + shift) * rayDirection(view, x, y);
                    changes = changes || world.blocks(moved) != (seen.shadow == Shadow::InShadow);
                }
            }
            // A point moved below the rectangle near its diagonal is hidden by the other half.
            if (quantum > 0 && seen.shadow == Shadow::Lit && !seen.onFloor && !changes) return;
            ASSERT_EQ(truth.tie[i] == Tie::Truth, changes) << x << " " << y << " " << quantum;
            tied += changes;
        });
        EXPECT_GT(tied, 5u);
    }
}

TEST(TracerTies, CountIsTiedWhereASideIsWithinTheBand) {
    const RectangleOverFloor world;
    const View view = viewOf(world.camera, 400, 400);
    for (const double band : {std::ldexp(1.0, -16), std::ldexp(1.0, -12), std::ldexp(1.0, -10)}) {
        const Truth truth = trace(world.scene(), world.light, view, {0, band});
        std::size_t missed = 0;
        forEachPixel(truth, [&](std::size_t i, double x, double y) {
            const auto seen = world.see(view, x, y);
            if (truth.tie[i] == Tie::Truth || !seen.onFloor) return;
            // One volume, so the count is 0 or 1, and a side in the band always matters.
            const double depth = windowDepth(view, seen.t);
            const glm::dvec3 d = rayDirection(view, x, y);
            const auto inside = [&](double at) {
                return world.blocks(view.eye + distanceAtDepth(view, at) * d);
            };
            bool changes = false;
            for (int k = -64; k <= 64 && !changes; ++k)
                changes = inside(depth + band * k / 64) != inside(depth);
            if (changes) {
                ASSERT_EQ(truth.tie[i], Tie::Count) << x << " " << y;
            }
            // Through a corner of the volume, a ray may pass between two of these points.
            missed += changes != (truth.tie[i] == Tie::Count);
        });
        EXPECT_LE(missed, 40u);
        EXPECT_GT(countOf(truth, Tie::Count), 0u);
    }
}

TEST(Tracer, SeesTheBackOfAOneSidedWallInShadow) {
    // The front looks to +z.
    Scene scene;
    scene.objects = {{.mesh = rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0})}};
    const View before = viewOf({.eye = {0, 0, 5}}, 16, 16), behind = viewOf({.eye = {0, 0, -5}}, 16, 16);
    const glm::vec4 front(1, 2, 4, 1), back(1, 2, -4, 1);

    EXPECT_THAT(trace(scene, front, before).shadow, Each(Shadow::Lit));
    const Truth away = trace(scene, front, behind);
    EXPECT_THAT(away.shadow, Each(Shadow::InShadow));
    EXPECT_THAT(away.facesAway, Each(true));
    EXPECT_THAT(away.blocked, Each(true));

    // Lit on its back, it casts nothing, but its front faces away.
    EXPECT_THAT(trace(scene, back, behind).shadow, Each(Shadow::Lit));
    const Truth unblocked = trace(scene, back, before);
    EXPECT_THAT(unblocked.shadow, Each(Shadow::InShadow));
    EXPECT_THAT(unblocked.blocked, Each(false));
    scene.objects[0].twoSided = true;
    EXPECT_THAT(trace(scene, back, before).blocked, Each(true));
}

TEST(Tracer, SeesTheUnderSideOfAReceiverFacingAwayUnblocked) {
    Scene scene;
    scene.objects = {floorOf(50)};
    const Truth truth =
        trace(scene, {0, 5, 0, 1}, viewOf({.eye = {0, -5, 0}, .target = {0, 0, 0.1f}}, 16, 16));
    EXPECT_THAT(truth.facesAway, Each(true));
    EXPECT_THAT(truth.blocked, Each(false));
    EXPECT_THAT(truth.shadow, Each(Shadow::InShadow));
    EXPECT_THAT(truth.tie, Each(Tie::None));
}

TEST(Tracer, LeavesTheBackgroundOutsideOfAnyShadow) {
    // The eye looks away from the wall along its infinite volume.
    Scene scene;
    scene.objects = {{.mesh = rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0})}};
    const Truth truth = trace(scene, {0, 0, 5, 1}, viewOf({.eye = {0, 0, -1}, .target = {0, 0, -9}}, 16, 16));
    EXPECT_THAT(truth.shadow, Each(Shadow::Background));
    EXPECT_THAT(truth.tie, Each(Tie::None));
    EXPECT_THAT(truth.blocked, Each(false));
}

TEST(Tracer, ClipsSurfacesNearerThanTheNearPlane) {
    Scene scene;
    scene.objects = {{.mesh = rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0})}};
    const Camera camera{.eye = {0, 0, 1}, .target = {0, 0, 0}, .nearPlane = 1.5f};
    EXPECT_THAT(trace(scene, {0, 0, 5, 1}, viewOf(camera, 8, 8)).shadow, Each(Shadow::Background));
    // Clipped, the wall still casts.
    scene.objects.push_back({.mesh = rectangle({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), .casts = false});
    const Truth truth = trace(scene, {0, 0, 5, 1}, viewOf(camera, 8, 8));
    EXPECT_THAT(truth.shadow, Each(Shadow::InShadow));
    EXPECT_THAT(truth.facesAway, Each(false));
}

TEST(Tracer, AnEmptySceneIsBackground) {
    EXPECT_THAT(trace({}, {0, 5, 0, 1}, viewOf({}, 4, 4)).shadow, Each(Shadow::Background));
}

TEST(Tracer, ALightInAFacesPlaneNeitherLightsNorCasts) {
    // A wall in the plane x = 0 that holds the light, on a floor.
    Scene scene;
    scene.objects = {{.mesh = rectangle({0, 0, -1}, {0, 2, 0}, {0, 0, 2}), .twoSided = true}, floorOf(4)};
    const View view = viewOf({.eye = {3, 3, 3}, .target = {0, 0.5f, 0}}, 64, 64);
    for (const glm::vec4 light : {glm::vec4(0, 4, 0.3f, 1), glm::vec4(-0.0f, 1, 0, 0)}) {
        const Truth truth = trace(scene, light, view);
        std::size_t wall = 0;
        forEachPixel(truth, [&](std::size_t i, double x, double y) {
            const glm::dvec3 d = rayDirection(view, x, y);
            const glm::dvec3 at = view.eye - view.eye.x / d.x * d;
            const bool onWall = at.y > 0 && at.y < 2 && std::abs(at.z) < 1;
            EXPECT_FALSE(truth.blocked[i]);
            if (truth.tie[i] == Tie::None) {
                ASSERT_EQ(truth.facesAway[i], onWall);
                ASSERT_EQ(truth.shadow[i] == Shadow::InShadow, onWall);
            }
            wall += onWall;
        });
        EXPECT_GT(wall, 100u);
    }
}

TEST(Tracer, AFineSphereHasNoCracksInItsShadow) {
    Scene scene;
    scene.objects = {{.mesh = sphere({0, 1.5f, 0}, 1, 180, 240)}, floorOf(3)};
    const glm::vec4 light(0, 6, 0, 1);
    const View view = viewOf({.eye = {4, 1.2f, 4}, .target = {0, 0.5f, 0}}, 256, 256);
    const Truth truth = trace(scene, light, view);
    // The sphere's cone of shadow: sin = 1 / 4.5. The facets lie within 1 - cos(pi/180) = 1.6e-4 inside.
    const double slope = std::tan(std::asin((1 - 3e-4) / 4.5));
    std::size_t inside = 0;
    forEachPixel(truth, [&](std::size_t i, double x, double y) {
        const glm::dvec3 d = rayDirection(view, x, y);
        const double t = -view.eye.y / d.y;
        const glm::dvec3 at = view.eye + t * d;
        if (t < 0 || truth.shadow[i] == Shadow::Background || std::hypot(at.x, at.z) > 6 * slope) return;
        ++inside;
        ASSERT_EQ(truth.shadow[i], Shadow::InShadow) << x << " " << y;
        ASSERT_TRUE(truth.blocked[i]);
    });
    EXPECT_GT(inside, 1000u);
}

TEST(Tracer, RaysThroughVerticesAndEdgesMissNothing) {
    // A grid in integers, seen so that eye rays run through its edges and vertices, lit so that shadow rays
    // do.
    Scene scene;
    Mesh grid;
    for (int y = 0; y <= 16; ++y) {
        for (int x = 0; x <= 16; ++x) grid.positions.push_back({x - 8, y - 8, 0});
    }
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
            const std::uint32_t a = y * 17 + x;
            grid.triangles.push_back({a, a + 1, a + 18});
            grid.triangles.push_back({a, a + 18, a + 17});
        }
    }
    scene.objects.push_back({.mesh = grid});
    scene.objects.push_back({.mesh = rectangle({-4, -4, -8}, {8, 0, 0}, {0, 8, 0}), .casts = false});
    // tan = 1 exactly enough: the basis is along the axes, and pixel centres are multiples of 1/2 of the
    // grid's step.
    View view;
    view.eye = {0, 0, 8};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.forward = {0, 0, -1};
    view.tanHalfX = view.tanHalfY = 15.0 / 16;
    view.width = view.height = 15;
    const Truth front = trace(scene, {0, 0, 8, 1}, view);
    EXPECT_THAT(front.shadow, Each(Shadow::Lit));
    // Through the grid, from behind it: all of the receiver is in shadow, whatever edge the segment meets.
    view.eye = {0, 0, -1};
    view.tanHalfX = view.tanHalfY = 0.25;
    for (const glm::vec4 light : {glm::vec4(0, 0, 8, 1), glm::vec4(0, 0, 1, 0)}) {
        const Truth shadow = trace(scene, light, view);
        EXPECT_THAT(shadow.shadow, Each(Shadow::InShadow));
        EXPECT_THAT(shadow.blocked, Each(true));
    }
}

TEST(Tracer, DoesNotDependOnTheOrderOfTriangles) {
    Scene scene = soup(20, 3);
    const View view = viewOf({.eye = {0.5f, 1, 4}}, 64, 64);
    const Truth before = trace(scene, {1, 3, 2, 1}, view);
    for (Object& object : scene.objects)
        std::shuffle(object.mesh.triangles.begin(), object.mesh.triangles.end(), std::mt19937(5));
    std::swap(scene.objects[0], scene.objects[1]);
    const Truth after = trace(scene, {1, 3, 2, 1}, view);
    EXPECT_EQ(after.shadow, before.shadow);
    EXPECT_EQ(after.tie, before.tie);
    EXPECT_EQ(after.blocked, before.blocked);
    EXPECT_EQ(after.facesAway, before.facesAway);
}

TEST(Tracer, TakesNegativeZeroForZero) {
    const auto traced = [](float zero) {
        Scene scene;
        scene.objects = {{.mesh = rectangle({-1, 1, zero}, {2, zero, zero}, {zero, zero, -1})}, floorOf(3)};
        for (Object& object : scene.objects) {
            for (glm::vec3& p : object.mesh.positions) {
                for (int k = 0; k < 3; ++k) p[k] = p[k] == 0 ? zero : p[k];
            }
        }
        return trace(scene, {zero, 4, zero, 1},
                     viewOf({.eye = {zero, 3, 4}, .target = {zero, zero, zero}}, 63, 63));
    };
    const Truth plus = traced(0.0f), minus = traced(-0.0f);
    EXPECT_EQ(plus.shadow, minus.shadow);
    EXPECT_EQ(plus.tie, minus.tie);
    EXPECT_GT(countOf(plus, Shadow::InShadow), 0u);
}

TEST(Tracer, AnEyeFarAwayLosesNothing) {
    // A ray in float from there would be off by a pixel.
    const RectangleOverFloor world{
        .camera = {.eye = {20000, 25000, 40000}, .target = {0, 0, 0}, .fovDegrees = 0.004f}};
    const View view = viewOf(world.camera, 128, 128);
    const Truth truth = trace(world.scene(), world.light, view, {0, 0});
    forEachPixel(truth, [&](std::size_t i, double x, double y) {
        if (truth.tie[i] == Tie::None) {
            ASSERT_EQ(truth.shadow[i], world.see(view, x, y).shadow) << x << " " << y;
        }
    });
    EXPECT_GT(countOf(truth, Shadow::InShadow), 100u);
}

/// A binary PLY of float positions and triangles, as in the Stanford repository.
Mesh readPly(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::size_t vertices = 0, faces = 0;
    for (std::string line; std::getline(in, line) && line != "end_header";) {
        std::istringstream words(line);
        std::string word, kind;
        words >> word >> kind;
        if (word == "element") words >> (kind == "vertex" ? vertices : faces);
    }
    Mesh mesh;
    mesh.positions.resize(vertices);
    in.read(reinterpret_cast<char*>(mesh.positions.data()), static_cast<std::streamsize>(12 * vertices));
    for (std::size_t i = 0; i < faces && in; ++i) {
        glm::uvec3 t;
        in.ignore(1);
        in.read(reinterpret_cast<char*>(&t), 12);
        mesh.triangles.push_back(t);
    }
    return mesh;
}

TEST(Tracer, TakesTheArmadillo) {
    const std::string path = GNOMON_SHARED "/data/meshes/armadillo.ply";
    if (!std::ifstream(path)) GTEST_SKIP() << "no " << path;
    Scene scene;
    scene.objects.push_back({.mesh = readPly(path)});
    ASSERT_EQ(triangleCount(scene), 345944u);
    const Truth truth =
        trace(scene, {100, 300, 150, 1}, viewOf({.eye = {-60, 90, 260}, .nearPlane = 4}, 512, 512));
    EXPECT_GT(countOf(truth, Shadow::InShadow), 10000u);
}

}  // namespace truth_test
}  // namespace gnomon
