// Faces as cones of directions, against a ray and face test in doubles that is written for nothing but to be
// plainly right; and in exact arithmetic where rays pass through borders.

#include "predict/cone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon {
namespace cone_test {

constexpr int kWidth = 40, kHeight = 30;

/// What a ray must do with a face; how far from another answer it is, in the face's own coordinates.
struct Expected {
    bool holds = false;
    double margin = 0;
    double distance = 0;  ///< along forward
};

/// d as a sum of three directions.
glm::dvec3 solve(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::inverse(glm::dmat3(a, b, c)) * d;
}

double least(const glm::dvec3& v) {
    return std::min({v.x, v.y, v.z});
}

/// A positive multiple of the ray, shares of a triangle that sum to 1.
Expected ofTriangle(const EyeRay& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 weights = solve(a - ray.eye, b - ray.eye, c - ray.eye, ray.direction);
    const double distance = 1 / (weights.x + weights.y + weights.z);
    return {least(weights) > 0, std::abs(least(weights)), distance};
}

/// A point of the edge's plane away from the light: the same direction as a point of the edge, and farther.
Expected ofSide(const EyeRay& ray, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light) {
    const glm::dvec3 l(light);
    const bool directional = light.w == 0;
    // The ray's parameter, then the place along the edge and away from the light.
    const glm::dvec3 away = directional ? -l : from - l;
    const glm::dvec3 solved = solve(ray.direction, from - to, -away, from - ray.eye);
    const double t = solved.x;
    if (directional) {
        const double margin = std::min({t, solved.y, 1 - solved.y, solved.z});
        return {margin > 0, std::abs(margin), t};
    }
    const glm::dvec3 hit = ray.eye + t * ray.direction - l;
    // Out of the plane any direction does.
    const glm::dvec3 shares = solve(from - l, to - l, glm::cross(from - l, to - l), hit);
    const double margin = std::min({t, shares.x, shares.y, shares.x + shares.y - 1});
    return {margin > 0, std::abs(margin), t};
}

Expected ofFarCap(const EyeRay& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  const glm::dvec4& light) {
    const glm::dvec3 l(light);
    const double margin = least(solve(a - l, b - l, c - l, ray.direction));
    return {margin > 0, std::abs(margin)};
}

/// The near plane's point, seen by the light behind the triangle.
Expected ofNearCap(const EyeRay& ray, double near, const glm::dvec3& a, const glm::dvec3& b,
                   const glm::dvec3& c, const glm::dvec4& light) {
    const glm::dvec3 point = ray.eye + near * ray.direction, l(light);
    const glm::dvec3 towards = light.w == 0 ? l : l - point;
    const glm::dvec3 weights = solve(a - point, b - point, c - point, towards);
    // A crossing between the point and the light lies at 1 / sum of the way.
    const double sum = weights.x + weights.y + weights.z;
    const double margin = std::min(least(weights), light.w == 0 ? 1.0 : sum - 1);
    return {margin > 0, std::abs(margin)};
}

struct Drawing {
    std::mt19937 random{5};

    double number(double size = 1) { return std::uniform_real_distribution<double>(-size, size)(random); }
    glm::vec3 point(double size = 1) { return {number(size), number(size), number(size)}; }
    /// Every other one directional.
    glm::vec4 light(bool directional) {
        if (!directional) return {point(3), 1};
        return {glm::normalize(point()), 0};
    }
    View view() {
        Camera camera;
        camera.eye = point(2);
        camera.target = point(0.3);
        camera.fovDegrees = 70;
        return viewOf(camera, kWidth, kHeight);
    }
};

/// Where doubles can't tell; the cone can.
constexpr double kTooClose = 1e-7;

/// Holds the cone in every pixel against what it must be; counts the pixels that it has.
template <class Expect>
int held(const Cone& cone, const View& view, bool hasDistance, const Expect& expect) {
    int count = 0;
    for (int row = 0; row < kHeight; ++row) {
        const double y = row + 0.5;
        const auto [first, last] = cone.columns(y, 0, kWidth);
        for (int column = 0; column < kWidth; ++column) {
            const double x = column + 0.5;
            const EyeRay ray{view.eye, rayDirection(view, x, y)};
            const Expected expected = expect(ray);
            if (expected.margin < kTooClose) continue;
            EXPECT_EQ(cone.holds(ray, x, y), expected.holds) << x << " " << y << " " << expected.margin;
            EXPECT_EQ(cone.inside(x, y) > 0, expected.holds);
            if (!expected.holds) continue;
            ++count;
            EXPECT_TRUE(first <= column && column < last);
            EXPECT_FALSE(cone.missesWindow(kWidth, kHeight, 0));
            if (!hasDistance) continue;
            EXPECT_NEAR(cone.inverseDistance().at(x, y) * expected.distance, 1, 1e-6);
        }
    }
    return count;
}

constexpr int kFaces = 150;

TEST(Cone, HoldsTheRaysThatCrossATriangle) {
    Drawing draw;
    int count = 0;
    for (int i = 0; i < kFaces; ++i) {
        const View view = draw.view();
        const glm::dvec3 a = draw.point(), b = draw.point(), c = draw.point();
        const Cone cone = Cone::triangle(view, a, b, c);
        EXPECT_EQ(cone.isFront(), glm::dot(glm::cross(b - a, c - a), view.eye - a) > 0);
        count += held(cone, view, true, [&](const EyeRay& ray) { return ofTriangle(ray, a, b, c); });
    }
    EXPECT_GT(count, 1000);
}

TEST(Cone, HoldsTheRaysThatCrossASideToInfinity) {
    for (const bool directional : {false, true}) {
        Drawing draw;
        int count = 0;
        for (int i = 0; i < kFaces; ++i) {
            const View view = draw.view();
            const glm::dvec3 from = draw.point(), to = draw.point();
            const glm::dvec4 light = draw.light(directional);
            const Cone cone = Cone::side(view, from, to, light);

            // Of a triangle that the light sees counter-clockwise, the third corner lies inside of the side.
            glm::dvec3 third = draw.point();
            const glm::dvec3 towards = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - from;
            if (glm::dot(glm::cross(to - from, third - from), towards) < 0) third = 2.0 * from - third;
            const glm::dvec3 normal = glm::cross(to - from, towards);
            EXPECT_EQ(cone.isFront(), glm::dot(normal, view.eye - from) * glm::dot(normal, third - from) < 0);
            count += held(cone, view, true, [&](const EyeRay& ray) { return ofSide(ray, from, to, light); });
        }
        EXPECT_GT(count, 1000) << directional;
    }
}

TEST(Cone, HoldsTheRaysThatEndInAFarCap) {
    Drawing draw;
    int count = 0;
    for (int i = 0; i < kFaces; ++i) {
        const View view = draw.view();
        const glm::dvec4 light = draw.light(false);
        glm::dvec3 a = draw.point(), b = draw.point(), c = draw.point();
        if (glm::dot(glm::cross(b - a, c - a), glm::dvec3(light) - a) < 0) std::swap(b, c);
        const Cone cone = Cone::farCap(view, a, b, c, light);
        EXPECT_FALSE(cone.isFront());
        count += held(cone, view, false, [&](const EyeRay& ray) { return ofFarCap(ray, a, b, c, light); });
    }
    EXPECT_GT(count, 500);
}

TEST(Cone, HoldsTheRaysThatStartInANearCap) {
    for (const bool directional : {false, true}) {
        Drawing draw;
        int count = 0;
        for (int i = 0; i < kFaces; ++i) {
            View view = draw.view();
            view.nearPlane = 1;
            const glm::vec4 light = draw.light(directional);
            glm::vec3 a = draw.point(2), b = draw.point(2), c = draw.point(2);
            const glm::vec3 towards = light.w == 0 ? glm::vec3(light) : glm::vec3(light) - a;
            if (glm::dot(glm::cross(b - a, c - a), towards) < 0) std::swap(b, c);
            const Cone cone = Cone::nearCap(view, a, b, c, light);
            EXPECT_TRUE(cone.isFront());
            count +=
                held(cone, view, false, [&](const EyeRay& ray) { return ofNearCap(ray, 1, a, b, c, light); });
        }
        EXPECT_GT(count, 300) << directional;
    }
}

// ---- Borders ----

/// An eye far up the axis z, whose ray through the window's middle is the axis to the bit.
View downTheAxis(const glm::dvec3& eye) {
    View view =
        viewOf({.eye = glm::vec3(eye), .target = glm::vec3(eye) - glm::vec3(0, 0, 1)}, kWidth, kHeight);
    return view;
}

int holdsMiddle(const Cone& cone, const View& view) {
    if (cone.isEmpty()) return 0;
    const double x = kWidth / 2.0, y = kHeight / 2.0;
    return cone.holds({view.eye, rayDirection(view, x, y)}, x, y);
}

TEST(ConeBorder, LetsExactlyOneOfTwoTrianglesHaveTheRayThroughTheirEdge) {
    const View view = downTheAxis({0, 0, 5});
    for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), {0, 1, 0}, {1, 1, 0}, {-2, 1, 0.5}, {3, -1, -1}}) {
        for (const glm::dvec3 third : {glm::dvec3(-1, 2, 0.25), {1, 3, -0.5}, {-3, 4, 0}}) {
            const glm::dvec3 p = -way, q = 2.0 * way;
            EXPECT_EQ(holdsMiddle(Cone::triangle(view, p, q, third), view) +
                          holdsMiddle(Cone::triangle(view, q, p, -third), view),
                      1)
                << way.x << " " << way.y << ", " << third.x << " " << third.y;
        }
    }
}

TEST(ConeBorder, LetsExactlyOneTriangleOfAFanHaveTheRayThroughItsHub) {
    const View view = downTheAxis({0, 0, 5});
    for (const int spokes : {3, 4, 6, 8}) {
        std::vector<glm::dvec3> rim;
        for (int i = 0; i < spokes; ++i) {
            const double angle = 6.283185307179586 * i / spokes;
            rim.push_back({std::cos(angle), std::sin(angle), 0.125 * (i % 3)});
        }
        int count = 0;
        for (int i = 0; i < spokes; ++i)
            count += holdsMiddle(
                Cone::triangle(view, {0, 0, 0}, rim[std::size_t(i)], rim[std::size_t((i + 1) % spokes)]),
                view);
        EXPECT_EQ(count, 1) << spokes;
    }
}

// Cap, sides and far cap close a volume, so that an eye outside enters as often as it leaves. Whole numbers
// put many corners, edges and edges at infinity on the ray.
TEST(ConeBorder, LetsNoVolumeLeakAtCornersAndEdges) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> whole(-2, 2);
    const auto point = [&] { return glm::dvec3(whole(random), whole(random), whole(random)); };
    int tested = 0, onBorders = 0;
    for (int i = 0; i < 20000; ++i) {
        const bool directional = i % 2 == 0;
        const glm::dvec3 at = directional ? point() : point() + glm::dvec3(0, 3, 0);
        const glm::dvec4 light(at, directional ? 0 : 1);
        const glm::dvec3 a = point(), b = point(), c = point();
        const View view = downTheAxis({0, 0, 3});
        const glm::dvec3 towards = directional ? at : at - a;
        if (!(glm::dot(glm::cross(b - a, c - a), towards) > 0)) continue;

        std::vector<Cone> cones{Cone::triangle(view, a, b, c), Cone::side(view, a, b, light),
                                Cone::side(view, b, c, light), Cone::side(view, c, a, light)};
        bool isDegenerate = false;
        for (const Cone& cone : cones) isDegenerate = isDegenerate || cone.isEmpty();
        if (!directional) cones.push_back(Cone::farCap(view, a, b, c, light));
        if (isDegenerate) continue;

        int net = 0, border = 0;
        for (const Cone& cone : cones) {
            border += std::abs(cone.inside(kWidth / 2.0, kHeight / 2.0)) <= cone.insideError();
            if (holdsMiddle(cone, view)) net += cone.isFront() ? 1 : -1;
        }
        // Inside of all planes of the volume: behind the cap and each side.
        bool inside = true;
        for (int k = 0; k < 4; ++k) inside = inside && !cones[std::size_t(k)].isFront();
        // A ray along the light ends in the one point at infinity of a directional volume.
        const bool alongLight = directional && at.x == 0 && at.y == 0;
        if (alongLight) continue;
        EXPECT_EQ(net, inside ? -1 : 0) << i;
        ++tested;
        onBorders += border > 0;
    }
    EXPECT_GT(tested, 2000);
    EXPECT_GT(onBorders, 500);
}

TEST(Cone, IsEmptyWhereTheEyeLiesInItsPlane) {
    const View view = downTheAxis({0, 0, 5});
    EXPECT_TRUE(Cone::triangle(view, {-1, 0, 0}, {1, 0, 0}, {0, 0, 2}).isEmpty());
    EXPECT_TRUE(Cone::side(view, {1, 0, 0}, {1, 0, 2}, {3, 0, 1, 1}).isEmpty());
    EXPECT_FALSE(Cone::side(view, {1, 0, 0}, {1, 1, 2}, {3, 0, 1, 1}).isEmpty());
}

}  // namespace cone_test
}  // namespace gnomon
