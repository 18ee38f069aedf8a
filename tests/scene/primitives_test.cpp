#include "scene/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/weld.h"
#include "tools.h"

namespace gnomon {
namespace primitives_test {

struct Shape {
    std::string name;
    Mesh mesh;
    double volume;     ///< of the smooth shape
    double tolerance;  ///< relative: a faceted shape is smaller
};
void PrintTo(const Shape& shape, std::ostream* out) {
    *out << shape.name;
}

class ClosedPrimitive : public testing::TestWithParam<Shape> {};

TEST_P(ClosedPrimitive, IsClosed) {
    EXPECT_EQ(openEdges(GetParam().mesh), 0);
}

// A mesh turned inside out would have the negative volume.
TEST_P(ClosedPrimitive, IsCounterClockwiseSeenFromOutside) {
    EXPECT_NEAR(signedVolume(GetParam().mesh), GetParam().volume, GetParam().tolerance * GetParam().volume);
}

TEST_P(ClosedPrimitive, HasNoDegenerateTriangleAndNoVertexTwice) {
    const Mesh& mesh = GetParam().mesh;
    Dropped dropped;
    const Mesh welded = weld(mesh.positions, mesh.triangles, dropped);
    EXPECT_EQ(describe(dropped), "");
    EXPECT_EQ(welded.positions.size(), mesh.positions.size());
}

constexpr double kPi = std::numbers::pi;

// 64 segments lose up to 1 - sin(x)/x of the area, x = 2 pi/64: 0.16 %, and twice that for two roundings; a
// tube's volume is its section times the length of its centre line (Pappus), 14.776 here by numerical
// integration.
INSTANTIATE_TEST_SUITE_P(
    Shapes, ClosedPrimitive,
    testing::Values(Shape{"box", box({1, 2, 3}), 6, 1e-6},
                    Shape{"cylinder", cylinder(0.5, 3, 64), kPi * 0.25 * 3, 0.002},
                    Shape{"coarsestCylinder", cylinder(1, 1, 3), 3 * std::sqrt(3) / 4, 1e-6},
                    Shape{"sphere", sphere(2, 64, 32), 4.0 / 3 * kPi * 8, 0.006},
                    Shape{"coarsestSphere", sphere(1, 4, 2), 4.0 / 3, 1e-6},
                    Shape{"torus", torus(2, 0.5, 64, 64), 2 * kPi* kPi * 2 * 0.25, 0.004},
                    Shape{"trefoil", torusKnot({.segments = 256, .sides = 32}), kPi * 0.15 * 0.15 * 14.776,
                          0.01}),
    [](const auto& test) { return test.param.name; });

TEST(Rectangle, FacesUp) {
    for (const Mesh mesh = rectangle({3, 5}); const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        EXPECT_GT(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a).y, 0);
    }
}

TEST(Box, HasTheSizeGiven) {
    EXPECT_EQ(box({1, 2, 3}).positions.back(), glm::vec3(0.5f, 1, 1.5f));
}

}  // namespace primitives_test
}  // namespace gnomon
