#include "volume/orient.h"

#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace gnomon {
namespace orient_test {

using Rational = boost::multiprecision::cpp_rational;

int rationalOrientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& p) {
    Rational u[3], v[3], w[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = Rational(b[k]) - Rational(a[k]);
        v[k] = Rational(c[k]) - Rational(a[k]);
        w[k] = Rational(p[k]) - Rational(p.w) * Rational(a[k]);
    }
    const Rational d = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                       (u[0] * v[1] - u[1] * v[0]) * w[2];
    return d.sign();
}

TEST(Orientation, IsPositiveWhereTheTriangleIsCounterClockwise) {
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(0, 0, 1, 1)), 1);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(0, 0, -1, 1)), -1);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(5, 7, -0.0f, 1)), 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(0, 0, 1, 0)), 1);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(1, 1, 0, 0)), 0);
}

TEST(Orientation, SeesTheSmallestFloat) {
    const glm::vec3 a(0, 0, 0), b(1e-45f, 0, 0), c(0, 1e-45f, 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec4(0, 0, 1e-45f, 1)), 1);
    const float huge = 3e38f;
    EXPECT_EQ(orientation({huge, 0, 0}, {0, huge, 0}, {1e-45f, 1e-45f, huge}, glm::vec4(0, 0, 0, 1)),
              rationalOrientation({huge, 0, 0}, {0, huge, 0}, {1e-45f, 1e-45f, huge}, {0, 0, 0, 1}));
}

TEST(Orientation, AgreesWithRationalsNearThePlane) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> coordinate(-10, 10);
    std::uniform_int_distribution<int> step(-2, 2);
    const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    int zeros = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 a = point(), b = point(), c = point();
        // In the plane up to a few last places; the same as a direction.
        const float s = coordinate(random) / 10, t = coordinate(random) / 10;
        glm::vec3 p = a + s * (b - a) + t * (c - a);
        if (i % 4 == 0) p = i % 8 == 0 ? b : a;
        for (int k = 0; k < 3; ++k) {
            for (int n = step(random); n > 0; --n) p[k] = std::nextafter(p[k], 100.0f);
        }
        const int expected = rationalOrientation(a, b, c, glm::dvec4(p, 1));
        zeros += expected == 0;
        ASSERT_EQ(orientation(a, b, c, glm::vec4(p, 1)), expected);
        const glm::vec3 d = p - a;
        ASSERT_EQ(orientation(a, b, c, glm::vec4(d, 0)), rationalOrientation(a, b, c, glm::dvec4(d, 0)));

        const glm::dvec3 q = glm::dvec3(a) + double(s) * glm::dvec3(b - a) + double(t) * glm::dvec3(c - a);
        ASSERT_EQ(orientation(glm::dvec3(a), glm::dvec3(b), glm::dvec3(c), q),
                  rationalOrientation(a, b, c, glm::dvec4(q, 1)));
    }
    EXPECT_GT(zeros, 10);
}

TEST(Orientation, AgreesWithRationalsForDoublesOfAllSizes) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-60, 60);
    const auto number = [&] { return std::ldexp(mantissa(random), exponent(random)); };
    const auto point = [&] { return glm::dvec3(number(), number(), number()); };
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 a = point(), b = point(), c = i % 2 ? a + (b - a) * mantissa(random) : point();
        const glm::dvec3 p = i % 3 ? point() : a + mantissa(random) * (c - a);
        ASSERT_EQ(orientation(a, b, c, p), rationalOrientation(a, b, c, glm::dvec4(p, 1)));
    }
}

TEST(Orientation, IsAntisymmetric) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    const auto point = [&] {
        return glm::vec3(coordinate(random), coordinate(random), coordinate(random)) * 0.1f;
    };
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 a = point(), b = point(), c = point(), d = point();
        const int sign = orientation(a, b, c, glm::vec4(d, 1));
        ASSERT_EQ(orientation(b, c, a, glm::vec4(d, 1)), sign);
        ASSERT_EQ(orientation(b, a, c, glm::vec4(d, 1)), -sign);
        ASSERT_EQ(orientation(a, b, d, glm::vec4(c, 1)), -sign);
    }
}

}  // namespace orient_test
}  // namespace gnomon
