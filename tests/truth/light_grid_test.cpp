#include "truth/light_grid.h"

#include <gmock/gmock.h>

#include <map>
#include <random>

#include "scenes.h"
#include "truth/world.h"

namespace gnomon {
namespace light_grid_test {

std::vector<LitTriangle> trianglesOf(const Scene& scene, const glm::vec4& light) {
    return World(scene, light, Silhouette::Winding).triangles;
}

RayPoint pointAt(const glm::dvec3& p) {
    return RayPoint(EyeRay{p, {0.3, 0.5, 0.7}}, 0.0);
}

/// What the grid visits for a point: the surest answer by triangle; nothing where it can't say.
std::optional<std::map<std::uint32_t, Answer>> visited(const LightGrid& grid, const RayPoint& point,
                                                       double radius) {
    std::map<std::uint32_t, Answer> found;
    const bool says =
        grid.visit(point.position(), point.error(), radius, [&](std::uint32_t index, Answer crossed) {
            if (found[index] != Answer::Yes) found[index] = crossed;
            return true;
        });
    if (!says) return {};
    return found;
}

struct LightCase {
    std::string name;
    glm::vec4 light;
};
void PrintTo(const LightCase& c, std::ostream* out) {
    *out << c.name;
}

class LightGridUnder : public testing::TestWithParam<LightCase> {
  protected:
    glm::vec4 light() const { return GetParam().light; }
};

// Points are drawn near the corners and edges of the cube around the light, too, where its sides meet.
TEST_P(LightGridUnder, FindsEveryTriangleThatIsCrossedNearby) {
    int crossings = 0, sure = 0, unsaid = 0, queries = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        const std::vector<LitTriangle> triangles = trianglesOf(soup(seed % 2 ? 60 : 8, seed), light());
        const LightGrid grid(triangles, light());
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
        for (int i = 0; i < 200; ++i) {
            glm::dvec3 p(coordinate(random), coordinate(random), coordinate(random));
            if (i % 4 == 0 && light().w != 0) {
                const double far = std::abs(p.x);
                p = glm::dvec3(light()) + far * glm::dvec3(1, p.y < 0 ? 1 : -1, p.z);
            }
            const double radius = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-5 : 1e-4;
            ++queries;
            const auto found = visited(grid, pointAt(p), radius);
            unsaid += !found;
            if (!found) continue;
            for (std::uint32_t t = 0; t < triangles.size(); ++t) {
                if (!triangles[t].casts) continue;
                int crossed = 0;
                for (int k = 0; k < 9; ++k) {
                    const glm::dvec3 way(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
                    const glm::dvec3 beside = k == 8 ? p : p + 0.57 * radius * way;
                    crossed += crossesExactly(triangles[t], light(), pointAt(beside));
                }
                const auto at = found->find(t);
                if (crossed > 0) {
                    ASSERT_TRUE(at != found->end()) << "seed " << seed << ", point " << i << ", " << t;
                }
                if (at != found->end() && at->second == Answer::Yes) {
                    ASSERT_EQ(crossed, 9) << "seed " << seed << ", point " << i << ", " << t;
                    ++sure;
                }
                crossings += crossed > 0;
            }
        }
    }
    EXPECT_GT(crossings, 500);
    EXPECT_GT(sure, crossings / 2);
    EXPECT_LT(unsaid, queries / 20);
}

INSTANTIATE_TEST_SUITE_P(Lights, LightGridUnder,
                         testing::Values(LightCase{"Outside", {1.9f, 2.3f, 1.1f, 1}},
                                         LightCase{"Among", {0.1f, 0.2f, -0.3f, 1}},
                                         LightCase{"FarOff", {3000, 9000, -4000, 1}},
                                         LightCase{"AtInfinity", {0.48f, 0.64f, 0.6f, 0}},
                                         LightCase{"AtInfinityAlongAxis", {0, 0, -1, 0}}),
                         [](const auto& test) { return test.param.name; });

// Else it would be no better than to look at all of them.
TEST(LightGrid, VisitsFewTrianglesOfAFineMesh) {
    Scene scene;
    scene.objects.push_back({.mesh = sphere({0, 0, 0}, 1, 80, 80)});
    const glm::vec4 light(0.3f, 4, 0.2f, 1);
    const LightGrid grid(trianglesOf(scene, light), light);
    std::size_t visits = 0;
    for (int i = 0; i < 100; ++i) {
        const auto found = visited(grid, pointAt({-0.5 + 0.01 * i, -1.5, 0.013 * i - 0.6}), 1e-6);
        ASSERT_TRUE(found.has_value()) << i;
        EXPECT_THAT(*found, testing::Not(testing::IsEmpty())) << i;
        visits += found->size();
    }
    // One, and two at an edge.
    EXPECT_LT(visits, 110u);
}

TEST(LightGrid, SaysNothingWhereTooManyTrianglesLie) {
    Scene scene;
    for (int i = 0; i < 300; ++i)
        scene.objects.push_back({.mesh = rectangle({-1, 1, -1}, {0, 0, 2}, {2, 0, 0})});
    const glm::vec4 light(0, 3, 0, 1);
    const LightGrid grid(trianglesOf(scene, light), light);
    EXPECT_EQ(visited(grid, pointAt({0.2, 0, 0.1}), 0), std::nullopt);
    EXPECT_THAT(visited(grid, pointAt({9, 2, 0}), 0), testing::Optional(testing::IsEmpty()));
}

TEST(LightGrid, SaysNothingAtTheLight) {
    const glm::vec4 light(0.1f, 0.2f, 0.3f, 1);
    const LightGrid grid(trianglesOf(soup(20, 1), light), light);
    EXPECT_EQ(visited(grid, pointAt(glm::dvec3(light)), 0), std::nullopt);
}

TEST(LightGrid, IsEmptyWithoutCasters) {
    Scene scene;
    scene.objects.push_back(floorOf(2));
    const glm::vec4 light(0, 3, 0, 1);
    const LightGrid grid(trianglesOf(scene, light), light);
    EXPECT_THAT(visited(grid, pointAt({0.2, 0, 0.1}), 0), testing::Optional(testing::IsEmpty()));
}

}  // namespace light_grid_test
}  // namespace gnomon
