#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <optional>

#include "scenes.h"
#include "truth/truth.h"

// A second tracer, written for nothing but to be plainly right: every triangle, every ray, in one number
// type.

namespace gnomon {
namespace brute_force_test {

using Rational = boost::multiprecision::cpp_rational;

template <class T>
using Vec = std::array<T, 3>;
template <class T>
Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
    return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}
template <class T>
T dot(const Vec<T>& a, const Vec<T>& b) {
    return T(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class T>
Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
    return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T, class V>
Vec<T> vec(const V& v) {
    return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
class BruteForce {
  public:
    BruteForce(const Scene& scene, const glm::vec4& light)
        : m_light(vec<T>(light)), m_directional(light.w == 0) {
        for (const Object& object : scene.objects) {
            for (const glm::uvec3& t : object.mesh.triangles) {
                Triangle triangle;
                for (int k = 0; k < 3; ++k) triangle.p[k] = vec<T>(object.mesh.positions[t[k]]);
                triangle.normal = cross(triangle.p[1] - triangle.p[0], triangle.p[2] - triangle.p[0]);
                const T side = dot(triangle.normal, m_directional ? m_light : m_light - triangle.p[0]);
                triangle.light = side > 0 ? 1 : side < 0 ? -1 : 0;
                triangle.casts =
                    object.casts && (triangle.light > 0 || (object.twoSided && triangle.light < 0));
                m_triangles.push_back(triangle);
            }
        }
    }

    struct Result {
        Shadow shadow = Shadow::Background;
        bool facesAway = false, blocked = false;
        int own = -1;
        T t = 0;
    };

    Result see(const glm::dvec3& eyePoint, const glm::dvec3& direction, double nearPlane) const {
        const Vec<T> eye = vec<T>(eyePoint), d = vec<T>(direction);
        Result result;
        for (int i = 0; i < static_cast<int>(m_triangles.size()); ++i) {
            const auto t = hit(m_triangles[i], eye, d);
            if (t && *t >= T(nearPlane) && (result.own < 0 || *t < result.t)) {
                result.own = i;
                result.t = *t;
            }
        }
        if (result.own < 0) return result;
        const Triangle& own = m_triangles[result.own];
        const int eyeSide = dot(own.normal, eye - own.p[0]) > 0 ? 1 : -1;
        result.facesAway = own.light != eyeSide;
        result.blocked = (own.casts && result.facesAway) || crossings(at(eye, d, result.t), result.own) > 0;
        result.shadow = result.facesAway || result.blocked ? Shadow::InShadow : Shadow::Lit;
        return result;
    }

    /// How many casting triangles, without @p own, hide the light from @p x.
    int crossings(const Vec<T>& x, int own) const {
        const Vec<T> way = m_directional ? m_light : m_light - x;
        int count = 0;
        for (int i = 0; i < static_cast<int>(m_triangles.size()); ++i) {
            if (i == own || !m_triangles[i].casts) continue;
            const auto t = hit(m_triangles[i], x, way);
            count += t && *t > 0 && (m_directional || *t < 1);
        }
        return count;
    }

    static Vec<T> at(const Vec<T>& eye, const Vec<T>& d, const T& t) {
        return {T(eye[0] + t * d[0]), T(eye[1] + t * d[1]), T(eye[2] + t * d[2])};
    }

  private:
    struct Triangle {
        Vec<T> p[3], normal;
        int light = 0;
        bool casts = false;
    };

    /// The parameter of the crossing of the line with the triangle's inner or its edges.
    static std::optional<T> hit(const Triangle& triangle, const Vec<T>& origin, const Vec<T>& way) {
        int positive = 0, negative = 0;
        for (int k = 0; k < 3; ++k) {
            const T side = dot(cross(triangle.p[k] - origin, triangle.p[(k + 1) % 3] - origin), way);
            positive += side > 0;
            negative += side < 0;
            if (positive > 0 && negative > 0) return {};
        }
        const T slope = dot(triangle.normal, way);
        if (slope == 0) return {};
        return T(dot(triangle.normal, triangle.p[0] - origin) / slope);
    }

    Vec<T> m_light;
    bool m_directional;
    std::vector<Triangle> m_triangles;
};

struct World {
    Scene scene;
    glm::vec4 light;
    View view;
};

World randomWorld(unsigned seed, int size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    const glm::vec3 point(coordinate(random), coordinate(random), coordinate(random));
    World world{.scene = soup(6, seed), .light = glm::vec4(2.0f * point, 1), .view = {}};
    if (seed % 3 == 0) world.light = glm::vec4(glm::normalize(point), 0);
    if (seed % 3 == 1) world.light = glm::vec4(0.3f * point, 1);  // among the triangles
    const Camera camera{.eye = {coordinate(random), coordinate(random), seed % 2 ? 3.0f : 0.5f},
                        .target = {0, 0, 0}};
    world.view = viewOf(camera, size, size);
    return world;
}

TEST(Tracer, AgreesWithRationalsOnEveryPixel) {
    int shadow = 0;
    for (unsigned seed = 0; seed < 6; ++seed) {
        const World world = randomWorld(seed, 16);
        const BruteForce<Rational> exact(world.scene, world.light);
        const Truth truth =
            Tracer(world.scene, Light{.position = world.light}).trace(world.view, depthTies(24));
        for (int i = 0; i < 16 * 16; ++i) {
            const auto seen =
                exact.see(world.view.eye, rayDirection(world.view, i % 16 + 0.5, 15 - i / 16 + 0.5),
                          world.view.nearPlane);
            ASSERT_EQ(truth.shadow[i], seen.shadow) << seed << " " << i;
            ASSERT_EQ(truth.facesAway[i], seen.facesAway) << seed << " " << i;
            ASSERT_EQ(truth.blocked[i], seen.blocked) << seed << " " << i;
            shadow += seen.shadow == Shadow::InShadow;
        }
    }
    EXPECT_GT(shadow, 100);
}

// Nearly all pixels take the tracer's quick way; long double decides here what that may have missed.
TEST(Tracer, TiesAgreeWithBruteForce) {
    using T = long double;
    int truthTies = 0, countTies = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        constexpr int kSize = 96;
        const World world = randomWorld(seed, kSize);
        const View& view = world.view;
        const BruteForce<T> exact(world.scene, world.light);
        const DepthTies ties = depthTies(seed % 2 ? 24 : 9);
        const Truth truth = Tracer(world.scene, Light{.position = world.light}).trace(view, ties);
        for (int i = 0; i < kSize * kSize; ++i) {
            const double x = i % kSize + 0.5, y = kSize - 1 - i / kSize + 0.5;
            const glm::dvec3 d = rayDirection(view, x, y);
            const auto seen = exact.see(view.eye, d, view.nearPlane);
            ASSERT_EQ(truth.shadow[i], seen.shadow) << seed << " " << i;
            ASSERT_EQ(truth.blocked[i], seen.blocked) << seed << " " << i;

            bool changes = false;
            for (const double dx : {-1.0 / 256, 1.0 / 256}) {
                for (const double dy : {-1.0 / 256, 1.0 / 256}) {
                    const auto moved =
                        exact.see(view.eye, rayDirection(view, x + dx, y + dy), view.nearPlane);
                    changes = changes || moved.shadow != seen.shadow;
                }
            }
            if (seen.own >= 0) {
                const auto t = static_cast<double>(seen.t);
                const double quantum = ties.truthQuantum * t * t / view.nearPlane;
                for (const double shift : {-std::min(quantum, t - view.nearPlane), quantum}) {
                    const auto p = BruteForce<T>::at(vec<T>(view.eye), vec<T>(d), seen.t + T(shift));
                    const bool hidden = seen.facesAway || exact.crossings(p, seen.own) > 0;
                    changes = changes || hidden != (seen.shadow == Shadow::InShadow);
                }
                // Another surface within one quantum behind.
                const auto next = exact.see(view.eye, d, std::nextafter(t, 1e9) * (1 + 1e-12));
                if (next.own >= 0 && next.t <= seen.t + T(quantum))
                    changes = changes || next.shadow != seen.shadow;
            }
            // A third surface within the quantum isn't looked for here.
            if (changes || seed % 2) {
                ASSERT_EQ(truth.tie[i] == Tie::Truth, changes) << seed << " " << i;
            }
            truthTies += changes;

            // With no side in the band, the count at its ends is the same (but for the surfaces on the ray).
            if (seen.own < 0 || changes) continue;
            const double depth = windowDepth(view, static_cast<double>(seen.t));
            const double first = distanceAtDepth(view, std::max(0.0, depth - ties.countBand));
            const auto count = [&](T t) {
                return exact.crossings(BruteForce<T>::at(vec<T>(view.eye), vec<T>(d), t), -1) > 0;
            };
            if (count(T(first)) != count(seen.t - T(1e-9))) {
                ASSERT_EQ(truth.tie[i], Tie::Count) << seed << " " << i;
            }
            countTies += truth.tie[i] == Tie::Count;
        }
    }
    EXPECT_GT(truthTies, 500);
    EXPECT_GT(countTies, 50);
}

}  // namespace brute_force_test
}  // namespace gnomon
