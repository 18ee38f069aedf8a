#include "volume/nesting.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "scene/load.h"
#include "shapes.h"

namespace gnomon {
namespace nesting_test {

/// The volumes of a light by their definition: what a triangle hides from the light, and the sides that bound
/// it. In double precision, face by face.
class BruteForce {
  public:
    BruteForce(const Scene& scene, const std::vector<LitCaster>& lit, const glm::vec4& light,
               const View& view, CountedFrom from)
        : m_light(light), m_view(view), m_from(from) {
        int volume = 0;
        for (const LitCaster& caster : lit) {
            const auto at = [&](std::uint32_t v) {
                return glm::dvec3(scene.objects[caster.object].mesh.positions[v]);
            };
            for (std::size_t i = 0; i < caster.lit.size(); ++i) {
                const glm::uvec3 t = caster.lit[i];
                m_caps.push_back({volume + (caster.perTriangle ? int(i) : 0), {at(t.x), at(t.y), at(t.z)}});
            }
            for (std::size_t i = 0; i < caster.sides.size(); ++i) {
                const Side s = caster.sides[i];
                m_sides.push_back(
                    {volume + (caster.perTriangle ? int(i) / 3 : 0), at(s.from), at(s.to), s.weight});
            }
            volume += caster.perTriangle ? int(caster.lit.size()) : 1;
        }
    }

    /// The largest counts along the ray through a window position.
    Nesting at(double x, double y) const {
        const glm::dvec3 d = rayDirection(m_view, x, y);
        std::vector<Event> events;
        double surface = std::numeric_limits<double>::infinity();
        for (const Cap& cap : m_caps) {
            if (m_from == CountedFrom::Eye && hides(cap, m_view.eye + m_view.nearPlane * d))
                events.push_back({m_view.nearPlane, cap.volume, 1, 1});
            if (const auto t = crossing(cap.corners, m_view.eye, d); t && *t > m_view.nearPlane) {
                const bool isFront = glm::dot(d, normal(cap)) < 0;
                if (m_from == CountedFrom::Infinity) events.push_back({*t, cap.volume, isFront ? 1 : -1, 1});
                surface = std::min(surface, *t);
            }
            if (m_light.w == 0) continue;
            const glm::dvec3 l(m_light);
            if (crossing({cap.corners[0] - l, cap.corners[1] - l, cap.corners[2] - l}, glm::dvec3(0), d))
                events.push_back({1e300, cap.volume, -1, 1});
        }
        for (const SideFace& side : m_sides) {
            const glm::dvec3 l(m_light), away = m_light.w == 0 ? -l : side.from - l;
            const glm::dvec3 n = glm::cross(away, side.to - side.from);  // outwards
            const double slope = glm::dot(n, d);
            if (slope == 0) continue;
            const double t = glm::dot(n, side.from - m_view.eye) / slope;
            if (t <= m_view.nearPlane || !isBehindEdge(side, m_view.eye + t * d)) continue;
            events.push_back({t, side.volume, slope < 0 ? 1 : -1, side.weight});
        }
        if (m_from == CountedFrom::Infinity)
            for (Event& e : events) e.t = -e.t, e.enters = -e.enters;
        return along(events, m_from == CountedFrom::Eye ? surface : 0);
    }

    Nesting everywhere() const {
        Nesting most;
        for (int y = 0; y < m_view.height; ++y)
            for (int x = 0; x < m_view.width; ++x) most = deepest(most, at(x + 0.5, y + 0.5));
        return most;
    }

  private:
    struct Cap {
        int volume = 0;
        std::array<glm::dvec3, 3> corners{};
    };
    struct SideFace {
        int volume = 0;
        glm::dvec3 from{}, to{};
        int weight = 1;
    };
    struct Event {
        double t = 0;
        int volume = 0;
        int enters = 1;  ///< or -1
        int weight = 1;
    };

    static glm::dvec3 normal(const Cap& cap) {
        return glm::cross(cap.corners[1] - cap.corners[0], cap.corners[2] - cap.corners[0]);
    }

    /// Where the ray from @p from along @p d goes through the triangle.
    static std::optional<double> crossing(const std::array<glm::dvec3, 3>& c, const glm::dvec3& from,
                                          const glm::dvec3& d) {
        const glm::dvec3 u = c[1] - c[0], v = c[2] - c[0], n = glm::cross(d, v);
        const double det = glm::dot(u, n);
        if (det == 0) return {};
        const glm::dvec3 s = from - c[0], q = glm::cross(s, u);
        const double a = glm::dot(s, n) / det, b = glm::dot(d, q) / det, t = glm::dot(v, q) / det;
        if (a < 0 || b < 0 || a + b > 1 || t <= 0) return {};
        return t;
    }

    bool hides(const Cap& cap, const glm::dvec3& point) const {
        const glm::dvec3 toLight = m_light.w == 0 ? glm::dvec3(m_light) : glm::dvec3(m_light) - point;
        const auto t = crossing(cap.corners, point, toLight);
        return t && (m_light.w == 0 || *t < 1);
    }

    /// Whether a point of the side's plane lies on the side.
    bool isBehindEdge(const SideFace& side, const glm::dvec3& p) const {
        const glm::dvec3 l(m_light);
        const glm::dvec3 a = m_light.w == 0 ? side.to - side.from : side.from - l;
        const glm::dvec3 b = m_light.w == 0 ? -l : side.to - l;
        const glm::dvec3 c = m_light.w == 0 ? p - side.from : p - l;
        // c = u a + v b, by the products with a and b.
        const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
        const double ca = glm::dot(c, a), cb = glm::dot(c, b), det = aa * bb - ab * ab;
        if (det == 0) return false;
        const double u = (ca * bb - cb * ab) / det, v = (cb * aa - ca * ab) / det;
        return m_light.w == 0 ? u >= 0 && u <= 1 && v >= 0 : u >= 0 && v >= 0 && u + v >= 1;
    }

    /// @param end  of what can be seen: what light caps hide is in volumes that were never entered
    static Nesting along(std::vector<Event>& events, double end) {
        std::stable_sort(events.begin(), events.end(),
                         [](const Event& a, const Event& b) { return a.t < b.t; });
        Nesting most;
        std::map<int, std::pair<int, int>> volumes;  // entries, exits
        for (std::size_t i = 0; i < events.size(); ++i) {
            const Event& e = events[i];
            auto& [entries, exits] = volumes[e.volume];
            (e.enters > 0 ? entries : exits) += e.weight;
            (e.enters > 0 ? most.fronts : most.backs) += e.weight;
            most.ownFronts = std::max(most.ownFronts, entries);
            // Sides of two volumes that coincide are crossed at once.
            const bool more = i + 1 < events.size() && events[i + 1].t - e.t <= 1e-9 * std::abs(e.t);
            if (more || e.t >= end) continue;
            int holding = 0, level = 0;
            for (const auto& [volume, counts] : volumes) {
                level = std::max(level, holding + counts.first);
                holding += counts.first - counts.second;
            }
            most.overlap = std::max(most.overlap, holding);
            most.levels = std::max(most.levels, level);
        }
        return most;
    }

    glm::dvec4 m_light;
    View m_view;
    CountedFrom m_from;
    std::vector<Cap> m_caps{};
    std::vector<SideFace> m_sides{};
};

constexpr CountedFrom kBothEnds[] = {CountedFrom::Eye, CountedFrom::Infinity};

/// "3 3 1 2 3": fronts, backs, own fronts, overlap, levels.
std::string text(const Nesting& n) {
    return fmt::format("{} {} {} {} {}", n.fronts, n.backs, n.ownFronts, n.overlap, n.levels);
}

bool holds(const Nesting& bound, const Nesting& truth) {
    return deepest(bound, truth) == bound;
}

/// Several casters of all kinds, seen from among them.
struct RandomWorld {
    Scene scene{};
    glm::vec4 light{};
    View view{};
    Silhouette silhouette{};
};

RandomWorld randomWorld(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-2, 2);
    const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
    RandomWorld world;
    const int objects = 1 + int(random() % 4);
    for (int i = 0; i < objects; ++i) {
        Object object;
        switch (random() % 5) {
            case 0:
                object.mesh = cube(point(), 0.2f + 0.1f * float(random() % 6));
                break;
            case 1:
                object.mesh = blob(point(), 0.8f, 3, 5, 0.4f, seed + unsigned(i));
                break;
            case 2:  // open
                object.mesh = cube(point(), 0.7f);
                object.mesh.triangles.resize(5 + random() % 4);
                break;
            case 3:  // non-manifold, not of one winding
                object.mesh = soup(6, 8, seed + unsigned(i));
                break;
            default:  // one triangle, often so close that the near plane cuts it
                object.mesh = {{point(), point(), point()}, {{0, 1, 2}}};
        }
        object.twoSided = random() % 3 == 0;
        world.scene.objects.push_back(std::move(object));
    }
    world.light = random() % 3 == 0 ? glm::vec4(glm::normalize(point()), 0) : glm::vec4(1.5f * point(), 1);
    world.view = viewOf(
        {.eye = point(), .target = point(), .fovDegrees = 70, .nearPlane = random() % 2 ? 0.6f : 0.05f}, 16,
        12);
    constexpr Silhouette kKinds[] = {Silhouette::Winding, Silhouette::PerTriangle, Silhouette::Triangular,
                                     Silhouette::Visible};
    world.silhouette = kKinds[random() % 4];
    return world;
}

TEST(Nesting, IsNeverBelowTheTrueMaximum) {
    int violations = 0, deep = 0, around = 0, equal = 0, all = 0;
    for (unsigned seed = 0; seed < 3000; ++seed) {
        const RandomWorld world = randomWorld(seed);
        const auto lit = litCasters(world.scene, world.light, world.silhouette);
        for (const CountedFrom from : kBothEnds) {
            const Nesting bound = nesting(world.scene, lit, world.light, world.view, from);
            const BruteForce truth(world.scene, lit, world.light, world.view, from);
            const Nesting most = truth.everywhere();
            if (!holds(bound, most) && ++violations <= 5)
                ADD_FAILURE() << seed << " " << int(from) << ": " << text(bound) << " < " << text(most);
            ++all;
            deep += most.overlap > 2;
            equal += bound == most;
            around += most.ownFronts > 1;
        }
    }
    EXPECT_EQ(violations, 0);
    EXPECT_GT(deep, all / 20);
    EXPECT_GT(around, all / 20);
    EXPECT_GT(equal, all * 3 / 4);
}

TEST(Nesting, HoldsWhereARasteriserRoundsTo) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-0.7 / 256, 0.7 / 256);
    for (unsigned seed = 3000; seed < 3400; ++seed) {
        const RandomWorld world = randomWorld(seed);
        const auto lit = litCasters(world.scene, world.light, world.silhouette);
        const Nesting bound = nesting(world.scene, lit, world.light, world.view);
        const BruteForce truth(world.scene, lit, world.light, world.view, CountedFrom::Eye);
        for (int y = 0; y < world.view.height; ++y)
            for (int x = 0; x < world.view.width; ++x) {
                const Nesting there = truth.at(x + 0.5 + off(random), y + 0.5 + off(random));
                ASSERT_TRUE(holds(bound, there)) << seed << ": " << text(bound) << " < " << text(there);
            }
    }
}

/// Boxes one below the other in slanting light: each lies in the shadows of all above it.
Scene stack(int boxes) {
    Scene scene;
    for (int i = 0; i < boxes; ++i) {
        Mesh box = cube({0, 0, 0}, 1);
        for (glm::vec3& p : box.positions)
            p = {(1 + 0.05f * float(i)) * p.x, 0.07f * p.y - 0.3f * float(i), (1 + 0.05f * float(i)) * p.z};
        scene.objects.push_back({.mesh = box});
    }
    return scene;
}

TEST(Nesting, IsExactForNestedBoxes) {
    const View view = viewOf({.eye = {2.3f, 1.7f, 7.1f}, .target = {0.13f, -2, 0}}, 96, 72);
    const glm::vec4 light(0.31f, 6.1f, 0.47f, 1);
    for (int boxes = 1; boxes <= 12; ++boxes) {
        const Scene scene = stack(boxes);
        const auto lit = litCasters(scene, light, Silhouette::Winding);
        for (const CountedFrom from : kBothEnds) {
            const Nesting bound = nesting(scene, lit, light, view, from);
            EXPECT_EQ(text(bound), text(BruteForce(scene, lit, light, view, from).everywhere())) << boxes;
            EXPECT_EQ(bound.overlap, boxes);
        }
    }
}

TEST(Nesting, IsAtMostTwiceTheTruthOnShippedScenes) {
    for (const char* id : {"boxes", "knot", "roettger"}) {
        const Scene scene =
            loadScene(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (std::string(id) + ".toml"));
        const View view = viewOf(scene.frames[0], 80, 60);
        const glm::vec4 light = scene.lights[0].position;
        const auto lit = litCasters(scene, light, Silhouette::Winding);
        for (const CountedFrom from : kBothEnds) {
            const Nesting bound = nesting(scene, lit, light, view, from);
            const Nesting truth = BruteForce(scene, lit, light, view, from).everywhere();
            EXPECT_TRUE(holds(bound, truth)) << id;
            EXPECT_LE(bound.fronts, 2 * truth.fronts) << id;
            EXPECT_LE(bound.overlap, 2 * truth.overlap) << id;
            EXPECT_LE(bound.levels, 2 * truth.levels) << id;
        }
    }
}

/// Fronts of an upright wedge that ends at @p x in the window, at the left of it.
int frontsOfWedgeUpTo(double x) {
    const View view = viewOf({.eye = {0, 0, 5}, .target = {0, 0, 0}, .fovDegrees = 90}, 16, 12);
    const glm::dvec3 tip = view.eye + 5.0 * rayDirection(view, x, 6);
    const Mesh wedge{{{tip.x, 10, 0}, {-50, 10, -0.5f}, {-50, 10, 0.5f}}, {{0, 1, 2}}};
    const Scene scene = sceneOf(wedge);
    const glm::vec4 above(0, 1, 0, 0);
    return nesting(scene, litCasters(scene, above, Silhouette::Winding), above, view).fronts;
}

TEST(Nesting, CountsWhatEndsLessThanARoundingBesideACentre) {
    EXPECT_EQ(frontsOfWedgeUpTo(0.5 + 0.5 / 256), 1);
    EXPECT_EQ(frontsOfWedgeUpTo(0.5 - 0.7 / 256), 1);
    EXPECT_EQ(frontsOfWedgeUpTo(0.5 - 1.5 / 256), 0);
}

TEST(Nesting, OfNothingIsNothing) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects[0].casts = false;
    const View view = viewOf({.eye = {0, 0, 7}}, 16, 12);
    EXPECT_EQ(nesting(scene, {}, {0, 5, 0, 1}, view), Nesting{});
}

TEST(Nesting, CountsASideAsOftenAsItHangsThere) {
    // Three triangles that walk their common edge alike.
    const Mesh fan{{{0, 0, -1}, {0, 0, 1}, {1, 0, 0.3f}, {1, 0.3f, 0}, {1, 0.6f, -0.3f}},
                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
    const Scene scene = sceneOf(fan);
    const glm::vec4 light(0.4f, 5, 0.1f, 1);
    const View view = viewOf({.eye = {-5, -1.3f, 0.2f}, .target = {0, -1.5f, 0}}, 32, 24);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    EXPECT_EQ(nesting(scene, lit, light, view).ownFronts, 3);
}

}  // namespace nesting_test
}  // namespace gnomon
