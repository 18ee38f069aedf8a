// Pixels that triangles cover, against what must hold of any fill rule and against the driver's rasteriser.

#include "cost/coverage.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "gl/renderer.h"
#include "gl/surface.h"
#include "gl/tools.h"

namespace gnomon {
namespace coverage_test {

constexpr int kWidth = 64, kHeight = 48;
constexpr WindowRect kAll{0, 0, kWidth, kHeight};

/// Clip space of a window position, pixels, at distance @p w.
glm::vec4 at(double x, double y, double w = 1) {
    return glm::vec4(glm::dvec4(x / kWidth * 2 - 1, y / kHeight * 2 - 1, 0, 1) * w);
}

using Triangles = std::vector<glm::vec4>;

std::int64_t all(const SidesCovered& sides) {
    return sides.front + sides.back;
}

/// Centres inside a triangle, and those inside or on its edges; corners on whole subpixels, so that floating
/// point is exact.
struct Centres {
    std::int64_t inside = 0, closed = 0;
};
Centres centresOf(const glm::dvec2 (&p)[3], const WindowRect& rect) {
    Centres centres;
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (int x = rect.x; x < rect.x + rect.width; ++x) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            int left = 0, right = 0;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec2 edge = p[(k + 1) % 3] - p[k], to = centre - p[k];
                const double side = edge.x * to.y - edge.y * to.x;
                left += side > 0, right += side < 0;
            }
            centres.inside += left == 3 || right == 3;
            centres.closed += left == 0 || right == 0;
        }
    }
    return centres;
}

TEST(Coverage, HoldsAllPixelsOfAWindowThatTwoTrianglesFill) {
    const Triangles quad{at(0, 0), at(kWidth, 0),       at(kWidth, kHeight),
                         at(0, 0), at(kWidth, kHeight), at(0, kHeight)};
    EXPECT_EQ(covered(quad, kWidth, kHeight, kAll), (SidesCovered{kWidth * kHeight, 0}));
}

TEST(Coverage, TellsTheSidesOfTrianglesApart) {
    const Triangles front{at(8, 8), at(24, 8), at(8, 24)}, back{at(8, 8), at(8, 24), at(24, 8)};
    const SidesCovered seen = covered(front, kWidth, kHeight, kAll);
    EXPECT_GT(seen.front, 0);
    EXPECT_EQ(seen.back, 0);
    EXPECT_EQ(covered(back, kWidth, kHeight, kAll), (SidesCovered{0, seen.front}));
}

/// Centres that lie on edges and corners, which is where a fill rule decides.
TEST(Coverage, GivesEachCentreOnACommonEdgeToOneTriangle) {
    const Triangles fan{at(32.5, 24.5)};
    const std::vector<glm::dvec2> rim{{12.5, 4.5},  {32.5, 4.5},  {52.5, 4.5},  {52.5, 24.5},
                                      {52.5, 44.5}, {32.5, 44.5}, {12.5, 44.5}, {12.5, 24.5}};
    std::int64_t pixels = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const glm::dvec2 a = rim[i], b = rim[(i + 1) % rim.size()];
        pixels += covered(Triangles{fan[0], at(a.x, a.y), at(b.x, b.y)}, kWidth, kHeight, kAll).front;
    }
    EXPECT_EQ(pixels, 40 * 40);
}

TEST(Coverage, HoldsCentresOnTheLeftAndTheLowerEdge) {
    const Triangles quad{at(12.5, 4.5), at(52.5, 4.5),  at(52.5, 44.5),
                         at(12.5, 4.5), at(52.5, 44.5), at(12.5, 44.5)};
    const auto holds = [&](int x, int y) { return covered(quad, kWidth, kHeight, {x, y, 1, 1}).front; };
    EXPECT_EQ(holds(12, 4), 1);
    EXPECT_EQ(holds(12, 44), 0);
    EXPECT_EQ(holds(52, 4), 0);
}

/// A mesh of the window whose corners are moved at random: it stays without cracks and overlaps.
TEST(Coverage, CountsEachPixelOfARandomMeshOnce) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-0.45, 0.45), depth(0.5, 40);
    constexpr int kCells = 16;
    for (int run = 0; run < 20; ++run) {
        std::vector<glm::vec4> corners;
        for (int j = 0; j <= kCells; ++j)
            for (int i = 0; i <= kCells; ++i) {
                const bool inX = i > 0 && i<kCells, inY = j> 0 && j < kCells;
                corners.push_back(at((i + (inX ? jitter(random) : 0)) * kWidth / kCells,
                                     (j + (inY ? jitter(random) : 0)) * kHeight / kCells, depth(random)));
            }
        Triangles mesh;
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                const auto corner = [&](int di, int dj) {
                    return corners[std::size_t((j + dj) * (kCells + 1) + i + di)];
                };
                for (const auto& p : {corner(0, 0), corner(1, 0), corner(1, 1)}) mesh.push_back(p);
                for (const auto& p : {corner(0, 0), corner(1, 1), corner(0, 1)}) mesh.push_back(p);
            }
        const SidesCovered whole = covered(mesh, kWidth, kHeight, kAll);
        EXPECT_EQ(whole.front - whole.back, kWidth * kHeight) << "run " << run;
        // Rectangles that fill the window share no pixel either.
        const WindowRect left{0, 0, 23, kHeight}, right{23, 0, kWidth - 23, kHeight};
        SidesCovered parts = covered(mesh, kWidth, kHeight, left);
        parts += covered(mesh, kWidth, kHeight, right);
        EXPECT_EQ(parts, whole) << "run " << run;
    }
}

TEST(Coverage, HoldsTheCentresInsideARandomTriangle) {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> x(0, 256 * kWidth), y(0, 256 * kHeight);
    constexpr WindowRect kRect{5, 7, 40, 30};
    int firm = 0;
    for (int run = 0; run < 500; ++run) {
        glm::dvec2 p[3];
        for (glm::dvec2& corner : p) corner = glm::dvec2(x(random), y(random)) / 256.0;
        const Triangles one{at(p[0].x, p[0].y), at(p[1].x, p[1].y), at(p[2].x, p[2].y)};
        const Centres centres = centresOf(p, kRect);
        const std::int64_t pixels = all(covered(one, kWidth, kHeight, kRect));
        EXPECT_GE(pixels, centres.inside) << "run " << run;
        EXPECT_LE(pixels, centres.closed) << "run " << run;
        firm += centres.inside == centres.closed && pixels > 0;
    }
    EXPECT_GT(firm, 300) << "too few say it exactly";
}

TEST(Coverage, CutsWhatReachesBehindTheEye) {
    // A floor one unit below an eye that looks along it: it fills what is below the horizon.
    const auto floor = [](double x, double z) { return glm::vec4(x, -1, -z - 0.2, -z); };
    const Triangles quad{floor(-1e3, 5), floor(1e3, 5),    floor(1e3, -1e5),
                         floor(-1e3, 5), floor(1e3, -1e5), floor(-1e3, -1e5)};
    EXPECT_EQ(all(covered(quad, kWidth, kHeight, kAll)), kWidth * kHeight / 2);
}

/// Neighbours are cut in the same points, so that the cuts leave no cracks.
TEST(Coverage, CutsARandomMeshBehindTheEyeWithoutCracks) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> jitter(-0.45, 0.45);
    constexpr int kCells = 12;
    for (int run = 0; run < 50; ++run) {
        std::vector<glm::vec4> corners;
        for (int j = 0; j <= kCells; ++j)
            for (int i = 0; i <= kCells; ++i) {
                const bool inside = i > 0 && i < kCells && j > 0 && j < kCells;
                const double x = -20 + (i + (inside ? jitter(random) : 0)) * 40 / kCells,
                             z = 2 - (j + (inside ? jitter(random) : 0)) * 10 / kCells;
                corners.emplace_back(x, -1, -z - 0.2, -z);
            }
        Triangles mesh;
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                const int a = j * (kCells + 1) + i, above = a + kCells + 1;
                for (const int k : {a, a + 1, above + 1, a, above + 1, above})
                    mesh.push_back(corners[std::size_t(k)]);
            }
        const auto corner = [&](int j, int i) { return corners[std::size_t(j * (kCells + 1) + i)]; };
        const Triangles quad{corner(0, 0), corner(0, kCells),      corner(kCells, kCells),
                             corner(0, 0), corner(kCells, kCells), corner(kCells, 0)};
        const SidesCovered whole = covered(mesh, kWidth, kHeight, kAll);
        EXPECT_EQ(whole.front - whole.back, covered(quad, kWidth, kHeight, kAll).front) << "run " << run;
        EXPECT_GT(whole.front, kWidth * kHeight / 4);
    }
}

TEST(Coverage, HoldsWhatLiesBeforeTheNearPlaneOnlyUnderADepthClamp) {
    const Triangles near{{-1, -1, -2, 1}, {3, -1, -2, 1}, {-1, 3, -2, 1}};
    EXPECT_EQ(all(covered(near, kWidth, kHeight, kAll)), 0);
    EXPECT_EQ(all(covered(near, kWidth, kHeight, kAll, true)), kWidth * kHeight);
}

TEST(Coverage, IsNothingWithoutARectangleOrAnArea) {
    const Triangles quad{at(0, 0), at(kWidth, 0), at(kWidth, kHeight)};
    EXPECT_EQ(covered(quad, kWidth, kHeight, {}), SidesCovered{});
    EXPECT_EQ(covered(quad, kWidth, kHeight, {kWidth, 0, 8, 8}), SidesCovered{});
    EXPECT_EQ(covered(Triangles{at(3, 3), at(30, 30), at(9, 9)}, kWidth, kHeight, kAll), SidesCovered{});
    EXPECT_EQ(covered(Triangles{at(3, 3), at(30, 30), {0, 0, 0, 0}}, kWidth, kHeight, kAll), SidesCovered{});
    EXPECT_EQ(covered({}, kWidth, kHeight, kAll), SidesCovered{});
}

/// The same counted by the driver: each fragment of the faces that are not culled adds one to the stencil.
std::int64_t rasterised(std::span<const glm::vec4> triangles, int width, int height, GLenum culled) {
    Surface surface({.depth = 24, .stencil = 8}, width, height);
    surface.makeCurrent();
    const GlTable& gl = surface.driver();
    gl.Viewport(0, 0, width, height);
    gl.Clear(GL_STENCIL_BUFFER_BIT);
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_ALWAYS, 0, ~0u);
    gl.StencilOp(GL_KEEP, GL_INCR, GL_INCR);
    gl.Enable(GL_CULL_FACE);
    gl.CullFace(culled);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.VertexPointer(4, GL_FLOAT, 0, triangles.data());
    gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    gl.Finish();
    const Image counts = readStencil(surface);
    for (const std::uint8_t count : counts.data) EXPECT_LT(count, 255) << "the stencil is too small";
    return std::accumulate(counts.data.begin(), counts.data.end(), std::int64_t(0));
}

TEST(Coverage, IsWhatTheRasteriserDraws) {
    constexpr int kW = 320, kH = 240;
    for (const Scene& scene : {twoBoxes(), underASlab()}) {
        const Frame frame = frameOf(scene, kW, kH);
        std::vector<std::span<const glm::vec4>> lists{frame.surfaces.positions};
        for (int part = 0; part < kParts; ++part) lists.push_back(frame.volumes().all(Part(part)));
        for (const auto& list : lists) {
            const SidesCovered sides = covered(list, kW, kH, {0, 0, kW, kH});
            EXPECT_EQ(sides.front, rasterised(list, kW, kH, GL_BACK));
            EXPECT_EQ(sides.back, rasterised(list, kW, kH, GL_FRONT));
        }
    }
}

}  // namespace coverage_test
}  // namespace gnomon
