#include "predict/map_prediction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "scene/primitives.h"

namespace gnomon {
namespace map_prediction_test {

Object placed(Mesh mesh, const glm::vec3& at, bool casts = true) {
    for (glm::vec3& p : mesh.positions) p += at;
    return {.name = "", .mesh = std::move(mesh), .casts = casts};
}

/// A box over a floor, seen from above and the side, with some background at the top of the picture.
Scene boxOverFloor(const glm::vec4& light) {
    Scene scene;
    scene.objects = {placed(rectangle({9, 9}), {0, 0, 0}, false),
                     placed(box({1.3, 0.4, 1.1}), {0.21f, 0.83f, 0.17f})};
    scene.lights = {{.position = light}};
    scene.frames = {{.eye = {2.9f, 3.1f, 5.7f}, .target = {0, 0.6f, 0}, .fovDegrees = 50, .nearPlane = 0.5f}};
    return scene;
}

constexpr int kWidth = 96, kHeight = 72;

/// One light's mask and all that it was predicted from.
struct Predicted {
    Predicted(const Scene& s, int size, float bias, double shadowShare = 0)
        : scene(s), plan(planOf(size, bias, shadowShare)) {}

    static Plan planOf(int size, float bias, double shadowShare) {
        Plan plan;
        plan.width = kWidth, plan.height = kHeight;
        plan.mapSize = size, plan.mapBias = bias, plan.shadowShare = shadowShare;
        return plan;
    }

    std::size_t pixels() const { return std::size_t(kWidth) * kHeight; }

    const Scene& scene;
    View view = viewOf(scene.frames.front(), kWidth, kHeight);
    SeenWindow window{scene, view, depthTies(24)};
    Plan plan{};
    MapDepths depths{scene, scene.lights.front().position, plan.mapSize};
    MapPrediction mask{
        {.plan = plan, .window = window, .depths = depths, .arithmetic = {.format = {"", 8, 8, 8, 8}}}};
};

// Below: the same once more, by itself and as plainly as can be.

/// What a line meets first: its parameter, and where the triangle stands in the scene.
struct Hit {
    double t = std::numeric_limits<double>::infinity();
    std::size_t object = 0, triangle = 0;
    bool isAny() const { return t < std::numeric_limits<double>::infinity(); }
};

/// Moeller and Trumbore 1997, both sides.
double meets(const glm::dvec3 corners[3], const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], p = glm::cross(direction, v);
    const double determinant = glm::dot(u, p);
    if (determinant == 0) return std::numeric_limits<double>::infinity();
    const glm::dvec3 q = from - corners[0], r = glm::cross(q, u);
    const double s = glm::dot(q, p) / determinant, t = glm::dot(direction, r) / determinant;
    if (s < 0 || t < 0 || s + t > 1) return std::numeric_limits<double>::infinity();
    return glm::dot(v, r) / determinant;
}

/// @param light  null: of all triangles; else of those that cast a shadow of it
Hit firstOf(const Scene& scene, const glm::dvec3& from, const glm::dvec3& direction, double least,
            const glm::dvec4* light) {
    Hit first;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const Object& object = scene.objects[o];
        if (light && !object.casts) continue;
        for (std::size_t t = 0; t < object.mesh.triangles.size(); ++t) {
            glm::dvec3 corners[3];
            for (int k = 0; k < 3; ++k) corners[k] = object.mesh.positions[object.mesh.triangles[t][k]];
            const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            if (light && glm::dot(normal, glm::dvec3(*light) - light->w * corners[0]) <= 0) continue;
            const double at = meets(corners, from, direction);
            if (at >= least && at < first.t) first = {at, o, t};
        }
    }
    return first;
}

struct Lookup {
    bool shadow = false, background = false;
};

/// A point light's map.
Lookup lookUpCube(const Predicted& p, const glm::dvec3& seen) {
    const glm::dvec4 light = p.scene.lights.front().position;
    const glm::dvec3 d = seen - glm::dvec3(light), size = glm::abs(d);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Any axes of the face do as long as the texels' centres are the same.
    const auto centre = [&](int k) {
        const double texel = std::floor((d[k] / size[axis] * 0.5 + 0.5) * p.plan.mapSize);
        return (texel + 0.5) / p.plan.mapSize * 2 - 1;
    };
    glm::dvec3 ray;
    for (int k = 0; k < 3; ++k) ray[k] = k == axis ? (d[k] > 0 ? 1.0 : -1.0) : centre(k);
    const Hit blocker =
        firstOf(p.scene, glm::dvec3(light), ray, p.depths.map().faces.front().nearPlane, &light);
    return {.shadow = size[axis] > blocker.t * (1 + double(p.plan.mapBias))};
}

/// A directional light's map.
Lookup lookUpSquare(const Predicted& p, const glm::dvec3& seen) {
    const glm::dvec4 light = p.scene.lights.front().position;
    const View& map = p.depths.map().faces.front();
    const double half = map.tanHalfX;
    const auto centre = [&](const glm::dvec3& axis) {
        const double at = glm::dot(seen - map.eye, axis) / half;
        const double texel = std::floor((at * 0.5 + 0.5) * p.plan.mapSize);
        return ((texel + 0.5) / p.plan.mapSize * 2 - 1) * half;
    };
    const glm::dvec3 from = map.eye + centre(map.right) * map.right + centre(map.up) * map.up;
    const Hit blocker = firstOf(p.scene, from, map.forward, 0, &light);
    return {.shadow = glm::dot(seen - map.eye, map.forward) / (2 * half) >
                      blocker.t / (2 * half) + double(p.plan.mapBias)};
}

Lookup lookUp(const Predicted& p, std::size_t pixel) {
    const double x = double(pixel % kWidth) + 0.5, y = kHeight - double(pixel / kWidth) - 0.5;
    const glm::dvec3 direction = rayDirection(p.view, x, y);
    const Hit hit = firstOf(p.scene, p.view.eye, direction, p.view.nearPlane, nullptr);
    if (!hit.isAny()) return {.background = true};
    const glm::dvec3 seen = p.view.eye + hit.t * direction;
    return p.depths.map().parallel ? lookUpSquare(p, seen) : lookUpCube(p, seen);
}

struct MapCase {
    std::string name;
    glm::vec4 light;
    int size;
    float bias;
};
void PrintTo(const MapCase& c, std::ostream* out) {
    *out << c.name;
}

class MapPredictionOf : public testing::TestWithParam<MapCase> {};

TEST_P(MapPredictionOf, BoxOverFloorIsWhatAPlainSearchFinds) {
    const auto& [name, light, size, bias] = GetParam();
    const Scene scene = boxOverFloor(light);
    const Predicted p(scene, size, bias);
    int differing = 0, shadows = 0, open = 0;
    for (std::size_t pixel = 0; pixel < p.pixels(); ++pixel) {
        const Lookup plain = lookUp(p, pixel);
        open += p.mask.isOpen(pixel);
        shadows += p.mask.shadow(pixel);
        // Where depths decide within rounding the plain search may come to either.
        if (!p.mask.isOpen(pixel)) differing += p.mask.shadow(pixel) != plain.shadow;
    }
    EXPECT_EQ(differing, 0);
    EXPECT_GT(shadows, 50) << "a case without a shadow shows nothing";
    EXPECT_LT(open, int(p.pixels()) / 20) << "a prediction that allows all is none";
}

INSTANTIATE_TEST_SUITE_P(Maps, MapPredictionOf,
                         testing::Values(MapCase{"Cube64", {0.4f, 4.3f, 0.7f, 1}, 64, 0.02f},
                                         MapCase{"Cube256", {0.4f, 4.3f, 0.7f, 1}, 256, 0.001f},
                                         MapCase{"CubeNoBias", {0.4f, 4.3f, 0.7f, 1}, 64, 0},
                                         MapCase{"CubeLowLight", {-2.3f, 1.1f, 1.7f, 1}, 128, 0.01f},
                                         MapCase{"Square64", {0.36f, 0.8f, 0.48f, 0}, 64, 0.02f},
                                         MapCase{"Square512", {0.36f, 0.8f, 0.48f, 0}, 512, 0.001f},
                                         MapCase{"SquareNoBias", {0.36f, 0.8f, 0.48f, 0}, 64, 0}),
                         [](const auto& test) { return test.param.name; });

// The one texel of the face below the light looks straight down onto the box: as deep as the box's top for
// all the floor, whatever stands between it and the light.
TEST(MapPrediction, OneTexelShadowsTheWholeFloor) {
    const Scene scene = boxOverFloor({0.21f, 9.3f, 0.17f, 1});
    const Predicted p(scene, 1, 0.02f);
    const double boxTop = 0.83f + 0.2;
    int floor = 0, onBox = 0;
    for (std::size_t pixel = 0; pixel < p.pixels(); ++pixel) {
        const double x = double(pixel % kWidth) + 0.5, y = kHeight - double(pixel / kWidth) - 0.5;
        const glm::dvec3 direction = rayDirection(p.view, x, y);
        const Hit hit = firstOf(scene, p.view.eye, direction, p.view.nearPlane, nullptr);
        if (p.window.at(pixel).size() > 1) continue;  // at a silhouette
        if (!hit.isAny()) {
            EXPECT_TRUE(p.mask.allows(pixel, 255) && !p.mask.allows(pixel, 0)) << "background is lit";
            continue;
        }
        if (hit.object == 0) {
            floor += 1;
            EXPECT_TRUE(p.mask.allows(pixel, 0)) << "at " << x << ", " << y;
        } else if (p.view.eye.y + hit.t * direction.y > boxTop - 1e-3) {
            onBox += 1;
            EXPECT_TRUE(p.mask.allows(pixel, 255)) << "at " << x << ", " << y;
        }
    }
    EXPECT_GT(floor, 1000);
    EXPECT_GT(onBox, 50);
}

TEST(MapPrediction, ShadowsKeepTheirShare) {
    const Scene scene = boxOverFloor({0.21f, 9.3f, 0.17f, 1});
    const Predicted p(scene, 64, 0.02f, 0.5);
    int shadows = 0;
    for (std::size_t pixel = 0; pixel < p.pixels(); ++pixel) {
        if (!p.mask.shadow(pixel) || p.mask.isOpen(pixel)) continue;
        ++shadows;
        EXPECT_TRUE(p.mask.allows(pixel, 128));
        EXPECT_FALSE(p.mask.allows(pixel, 0));
        EXPECT_FALSE(p.mask.allows(pixel, 255));
    }
    EXPECT_GT(shadows, 50);
}

/// The causes of all pixels that are not as truth has them, other than by rounding.
std::vector<Cause> causesOf(const Predicted& p) {
    const Truth truth = Tracer(p.scene, p.scene.lights.front()).trace(p.view, depthTies(24));
    std::vector<Cause> causes;
    for (std::size_t pixel = 0; pixel < p.pixels(); ++pixel) {
        if (truth.tie[pixel] != Tie::None || truth.facesAway[pixel] || p.mask.isOpen(pixel)) continue;
        if (p.mask.shadow(pixel) != truth.blocked[pixel])
            causes.push_back(p.mask.causeOf(pixel, truth.blocked[pixel]));
    }
    return causes;
}

TEST(MapPrediction, CoarseMapIsWrongByItsResolution) {
    const Scene scene = boxOverFloor({0.4f, 4.3f, 0.7f, 1});
    const std::vector<Cause> causes = causesOf(Predicted(scene, 32, 0));
    EXPECT_GT(causes.size(), 10u);
    EXPECT_THAT(causes, testing::Each(Cause::MapResolution));
}

// The box's own top, which the light grazes.
TEST(MapPrediction, WithoutABiasASurfaceShadowsItself) {
    const Scene scene = boxOverFloor({4.4f, 1.6f, 0.7f, 1});
    const std::vector<Cause> causes = causesOf(Predicted(scene, 64, 0));
    EXPECT_THAT(causes, testing::Contains(Cause::MapBias));
}

// The floor is less than 1.5 times as far from the light as the box.
TEST(MapPrediction, LargeBiasLosesTheShadow) {
    const Scene scene = boxOverFloor({0.4f, 4.3f, 0.7f, 1});
    const std::vector<Cause> causes = causesOf(Predicted(scene, 1024, 0.5f));
    EXPECT_GT(causes.size(), 50u);
    EXPECT_THAT(causes, testing::Each(Cause::MapBias));
}

// The light is nearer to the box's top than 2/1000 of the scene's radius, where the map begins.
TEST(MapPrediction, CasterBeforeTheMapsNearPlaneIsLeftOut) {
    const Scene scene = boxOverFloor({0.21f, 1.033f, 0.17f, 1});
    const std::vector<Cause> causes = causesOf(Predicted(scene, 64, 0.02f));
    EXPECT_GT(std::count(causes.begin(), causes.end(), Cause::NearPlaneCuts), 50);
    EXPECT_EQ(std::count(causes.begin(), causes.end(), Cause::Unexplained), 0);
}

}  // namespace map_prediction_test
}  // namespace gnomon
