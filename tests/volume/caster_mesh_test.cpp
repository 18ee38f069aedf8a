#include "volume/caster_mesh.h"

#include <gmock/gmock.h>

#include <limits>
#include <map>

#include "bench/torus.h"
#include "shapes.h"
#include "volume/orient.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace gnomon {
namespace caster_mesh_test {

using ::testing::ElementsAre;

struct Case {
    std::string name;
    Mesh mesh;
};

/// Vertices on a small grid of integers: many lights lie in planes of faces, many triangles have no area.
Mesh gridSoup(unsigned seed) {
    Mesh mesh = soup(40, 300, seed);
    for (glm::vec3& p : mesh.positions) p = glm::round(2.0f * p);
    return mesh;
}

Mesh scaled(Mesh mesh, float factor, const glm::vec3& offset = glm::vec3(0)) {
    for (glm::vec3& p : mesh.positions) p = p * factor + offset;
    return mesh;
}

/// Triangles so long and thin that the rounded cross product of their edges points elsewhere, and one without
/// area.
Mesh slivers() {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    const auto vector = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    Mesh mesh{.positions = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, .triangles = {{0, 1, 2}}};
    for (std::uint32_t i = 3; i < 600; i += 3) {
        const glm::vec3 end = vector();
        mesh.positions.insert(mesh.positions.end(), {vector() * 1e-14f, end, end * 0.5f});
        mesh.triangles.push_back({i, i + 1, i + 2});
    }
    return mesh;
}

std::vector<Case> cases() {
    std::vector<Case> all{{"torus", torusGrid(24)},
                          {"shuffled torus", shuffled(torusGrid(24), 3)},
                          {"cube", cube({0, 0, 0}, 1)},
                          {"slivers", slivers()},
                          {"one", {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}}},
                          {"none", {}},
                          {"tiny", scaled(soup(40, 200, 5), 1e-20f)},
                          {"denormal", scaled(soup(40, 200, 6), 1e-42f)},
                          {"huge", scaled(soup(40, 200, 7), 1e18f)},
                          {"largest", scaled(soup(40, 200, 8), 3e38f)},
                          {"far", scaled(soup(40, 200, 9), 1, {1e6f, -2e6f, 3e6f})}};
    for (unsigned seed = 0; seed < 6; ++seed) {
        all.push_back({"grid soup", gridSoup(seed)});
        all.push_back({"soup", soup(30 + seed, 64 * seed + seed, seed)});
    }
    return all;
}

/// Outside, inside, on vertices, in planes of faces and one rounding beside them; near, far and directional.
std::vector<glm::vec4> lightsFor(const Mesh& mesh) {
    std::vector<glm::vec4> lights{{0, 0, 0, 1},         {3, 1, 2, 1},      {0, 1, 0, 0},
                                  {0.6f, 0, -0.8f, 0},  {1, 1, 1, 1},      {-1, 2, 0, 1},
                                  {1e10f, 1, 2, 1},     {1e-30f, 0, 1, 1}, {1e6f, -2e6f, 3e6f, 1},
                                  {1e38f, 3e38f, 0, 1}, {0, 1e-41f, 0, 1}};
    std::mt19937 random(4);
    for (int i = 0; i < 12 && !mesh.triangles.empty(); ++i) {
        const glm::uvec3 t = mesh.triangles[random() % mesh.triangles.size()];
        const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const glm::vec3 inPlane = a + (b - a) * 0.5f + (c - a) * 2.0f;
        lights.push_back({a, 1});
        lights.push_back({a * 0.5f + b * 0.5f, 1});
        lights.push_back({inPlane, 1});
        lights.push_back({inPlane.x, std::nextafter(inPlane.y, 9.0f), inPlane.z, 1});
        lights.push_back({inPlane.x * 1.000001f, inPlane.y, inPlane.z, 1});
        lights.push_back({b - a, 0});
    }
    std::erase_if(lights, [](const glm::vec4& l) {
        return !std::isfinite(l.x) || !std::isfinite(l.y) || !std::isfinite(l.z);
    });
    return lights;
}

TEST(Facing, HasTheExactSignsWithEveryInstructionSet) {
    for (const auto& [name, mesh] : cases()) {
        const CasterMesh casters(mesh.positions, mesh.triangles);
        for (const glm::vec4& light : lightsFor(mesh)) {
            for (const Kernels& with : kernels()) {
                Facing facing{.lit = {~0ull}, .away = {~0ull}};  // what was there doesn't matter
                casters.face(light, facing, with);
                for (std::uint32_t i = 0; i < 64 * facing.lit.size(); ++i) {
                    int side = 0;
                    if (i < mesh.triangles.size()) {
                        const glm::uvec3 t = mesh.triangles[i];
                        side =
                            orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], light);
                    }
                    ASSERT_EQ(holds(facing.lit, i), side > 0)
                        << with.name << ", " << name << ", triangle " << i << ", light " << light.x << " "
                        << light.y << " " << light.z << " " << light.w;
                    ASSERT_EQ(holds(facing.away, i), side < 0) << with.name << ", " << name << ", " << i;
                }
                ASSERT_GT(64 * facing.lit.size(), mesh.triangles.size());
            }
        }
    }
}

#if defined(__x86_64__)
TEST(Facing, IsExactWhereDenormalNumbersCountAsZero) {
    // As Embree asks its users to set the processor. Coordinates are normal numbers, their products are not.
    const Mesh mesh = scaled(soup(60, 2000, 11), 1e-37f, glm::vec3(5e-37f));
    const CasterMesh casters(mesh.positions, mesh.triangles);
    for (int i = 0; i < 20; ++i) {
        const glm::vec4 light(1e-37f * (glm::vec3(ringLight(i, 20)) + 5.0f), 1);
        Facing usual, flushed;
        casters.face(light, usual);
        for (const Kernels& with : kernels()) {
            const unsigned mode = _mm_getcsr();
            _mm_setcsr(mode | 0x8040);  // flush to zero, denormals are zero
            casters.face(light, flushed, with);
            _mm_setcsr(mode);
            ASSERT_EQ(flushed.lit, usual.lit) << with.name;
            ASSERT_EQ(flushed.away, usual.away) << with.name;
        }
    }
}
#endif

TEST(Outline, IsTheWalksOfCapsWithNoneAcrossWithEveryInstructionSet) {
    for (const auto& [name, mesh] : cases()) {
        const CasterMesh casters(mesh.positions, mesh.triangles);
        for (const glm::vec4& light : lightsFor(mesh)) {
            Facing facing;
            casters.face(light, facing);
            std::vector<std::uint32_t> expected;
            for (std::uint32_t walk = 0; walk < 3 * mesh.triangles.size(); ++walk) {
                if (holds(facing.lit, walk / 3) && !holds(facing.lit, casters.edges().across[walk]))
                    expected.push_back(walk);
            }
            for (const Kernels& with : kernels()) {
                std::vector<std::uint32_t> walks;
                casters.outline(facing.lit, walks, with);
                ASSERT_EQ(walks, expected) << with.name << ", " << name;
            }
        }
    }
}

TEST(List, IsTheSetInItsOrderWithEveryInstructionSet) {
    std::mt19937_64 random(1);
    const Mesh mesh = torusGrid(60);  // 7,200 triangles: more words than one call of a kernel takes
    const CasterMesh casters(mesh.positions, mesh.triangles);
    for (const int kind : {0, 1, 2}) {
        std::vector<std::uint64_t> set(mesh.triangles.size() / 64 + 1);
        for (std::uint64_t& word : set) word = kind == 0 ? random() : kind == 1 ? ~0ull : 0;
        std::vector<std::uint32_t> expected;
        for (std::uint32_t t = 0; t < 64 * set.size(); ++t) {
            if (holds(set, t)) expected.push_back(t);
        }
        for (const Kernels& with : kernels()) {
            std::vector<std::uint32_t> triangles;
            casters.list(set, triangles, with);
            ASSERT_EQ(triangles, expected) << with.name;
        }
    }
}

TEST(Kernels, EndWithThoseThatNeedNothing) {
    EXPECT_EQ(kernels().back().name, "portable");
}

TEST(CasterMesh, CountsCapsAtCrowdedEdges) {
    // Three fins walk the edge from 0 to 1 alike, one walks it back.
    const Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 1, 2}, {0, -1, 0}},
                    .triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}}};
    const CasterMesh casters(mesh.positions, mesh.triangles);
    const auto counts = [&](std::uint64_t caps, std::uint64_t turned) {
        std::vector<std::pair<int, int>> result;
        casters.count(std::span(&caps, 1), std::span(&turned, 1),
                      [&](const Adjacency::Crowded& edge, const CasterMesh::Count& count) {
                          EXPECT_EQ(edge.low, 0u);
                          EXPECT_EQ(edge.high, 1u);
                          result.emplace_back(count.forward, count.backward);
                      });
        return result;
    };
    EXPECT_THAT(counts(0b1111, 0), ElementsAre(std::pair(3, 1)));
    EXPECT_THAT(counts(0b0101, 0), ElementsAre(std::pair(2, 0)));
    EXPECT_THAT(counts(0b0001, 0b1110), ElementsAre(std::pair(2, 2)));
    EXPECT_THAT(counts(0, 0), ElementsAre(std::pair(0, 0)));
}

TEST(CasterMesh, NeedsAtMost64BytesForATriangle) {
    const auto bytesPerTriangle = [](const Mesh& mesh) {
        return double(CasterMesh(mesh.positions, mesh.triangles).bytes()) / double(mesh.triangles.size());
    };
    // The padding to whole words: under 1 % here.
    EXPECT_LE(bytesPerTriangle(torusGrid(100)), 40.4);
    // Each edge crowded by as few triangles as can be: two that walk it the same way.
    Mesh worst = torusGrid(100);
    for (std::size_t i = 0; i < worst.triangles.size(); i += 2) {
        worst.triangles[i + 1] = worst.triangles[i];
    }
    EXPECT_GT(bytesPerTriangle(worst), 63);
    EXPECT_LE(bytesPerTriangle(worst), 64.6);
}

}  // namespace caster_mesh_test
}  // namespace gnomon
