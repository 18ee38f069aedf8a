#include "needs/reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "predict/crossings.h"
#include "random_scenes.h"
#include "scene/load.h"
#include "volume/near_cap.h"

namespace gnomon {
namespace reach_test {

/// Where a volume comes from.
struct VolumeOrigin {
    std::uint32_t caster = 0, triangle = 0;
};

/// Of each volume, as the predictor and FrameVolumes::ordinals number them.
std::vector<VolumeOrigin> volumesOf(std::span<const LitCaster> lit) {
    std::vector<VolumeOrigin> origins;
    for (std::uint32_t c = 0; c < lit.size(); ++c) {
        const std::size_t volumes = lit[c].perTriangle ? lit[c].lit.size() : !lit[c].lit.empty();
        for (std::uint32_t t = 0; t < volumes; ++t) origins.push_back({c, t});
    }
    return origins;
}

/// What is reached in one frame, and by which volumes.
struct Reached {
    std::vector<LitCaster> lit{};
    std::vector<VolumeOrigin> origins{};
    Reach reach{};
};

Reached reachedIn(const Scene& scene, const View& view, const DepthTies& ties, Silhouette silhouette) {
    const glm::vec4 light = scene.lights.front().position;
    Reached out{.lit = litCasters(scene, light, silhouette)};
    out.origins = volumesOf(out.lit);
    const SeenWindow window(scene, view, ties);
    out.reach = reachOf(scene, out.lit, light, view, Receivers(window));
    return out;
}

/// The scene with the casters of one object only.
Scene alone(Scene scene, std::size_t object) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        scene.objects[i].casts = scene.objects[i].casts && i == object;
    return scene;
}

struct Kept {
    int volumes = 0, culled = 0;
    std::int64_t checked = 0, blocked = 0, wrong = 0;
};

bool holdsAny(std::span<const WindowRect> windows, int x, int y) {
    return std::any_of(windows.begin(), windows.end(), [&](const WindowRect& w) { return w.holds(x, y); });
}

/// Calls @p visit(x, y) for each pixel that is in shadow, also by a tie; y from below.
template <class Visit>
void eachBlocked(const Truth& truth, const Visit& visit) {
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const auto pixel = std::size_t((truth.height - 1 - y) * truth.width + x);
            if (truth.blocked[pixel]) visit(x, y);
        }
    }
}

/// Holds the windows of each object's volumes against truth: outside of them, nothing that is seen may lie in
/// the object's shadow.
void compare(const Scene& scene, const View& view, const DepthTies& ties, Silhouette silhouette, Kept& kept) {
    const Reached reached = reachedIn(scene, view, ties, silhouette);
    ASSERT_EQ(reached.reach.windows.size(), reached.origins.size());
    const Light& light = scene.lights.front();
    const DepthTies none{};  // they are not asked for, and take most of the tracer's time
    const Truth all = Tracer(scene, light, silhouette).trace(view, none);
    kept.checked += std::int64_t(all.blocked.size());
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        std::vector<WindowRect> windows;
        for (std::size_t v = 0; v < reached.origins.size(); ++v)
            if (reached.lit[reached.origins[v].caster].object == object)
                windows.push_back(reached.reach.windows[v]);
        if (windows.empty()) continue;
        kept.volumes += int(windows.size());
        kept.culled +=
            int(std::count_if(windows.begin(), windows.end(), [](const auto& w) { return w.empty(); }));
        // Only where there is some shadow it may be this one's.
        bool isAnyOutside = false;
        eachBlocked(all, [&](int x, int y) {
            ++kept.blocked;
            isAnyOutside = isAnyOutside || !holdsAny(windows, x, y);
        });
        if (!isAnyOutside) continue;
        const Scene one = alone(scene, object);
        eachBlocked(Tracer(one, light, silhouette).trace(view, none),
                    [&](int x, int y) { kept.wrong += !holdsAny(windows, x, y); });
    }
}

// A thousand scenes each, so that several can run side by side.
class ReachOfRandomScenes : public testing::TestWithParam<unsigned> {};

TEST_P(ReachOfRandomScenes, LeavesOutNothingThatIsInShadow) {
    RandomScenes scenes(GetParam());
    Kept kept;
    for (int i = 0; i < 1000; ++i) {
        const Scene scene = scenes.next();
        const View view = viewOf(scene.frames.front(), 16, 10);
        const Silhouette silhouette = i % 4 == 0 ? Silhouette::PerTriangle : Silhouette::Winding;
        const std::int64_t before = kept.wrong;
        compare(scene, view, depthTies(i % 3 == 0 ? 16 : 24), silhouette, kept);
        EXPECT_EQ(kept.wrong, before) << "scene " << i;
    }
    RecordProperty("volumes", kept.volumes);
    RecordProperty("culled", kept.culled);
    std::cout << kept.culled << " of " << kept.volumes << " volumes culled, " << kept.blocked << " of "
              << kept.checked << " pixels in shadow\n";
    // Or nothing was tried.
    EXPECT_GT(kept.culled, kept.volumes / 10);
    EXPECT_GT(kept.blocked, kept.checked / 50);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReachOfRandomScenes, testing::Range(1u, 11u));

/// What the crossings of one volume come to before the surface that is seen.
struct Counted {
    int net = 0;                ///< in exact arithmetic, without caps towards the light
    int caps = 0;               ///< these
    bool isInDoubt = false;     ///< some face that counts may lie before the surface or not
    bool mayBeInDoubt = false;  ///< the same of a face that is not there in exact arithmetic

    bool matters() const { return isInDoubt || (net != 0 && net + caps != 0); }
};

/// Faces that may not be drawn at a pixel stand there in exact arithmetic or not; otherwise they end there at
/// another, to the bit, that is drawn instead or is not there either.
Counted counted(std::span<const Crossing> crossings) {
    Counted out;
    for (const Crossing& c : crossings) {
        const bool mayCount = c.possible & (kBefore | kAt);
        bool counts = c.exact == kBefore;
        switch (c.piece) {
            case Piece::Side:
                if (mayCount && (c.possible & kBehind))
                    (c.exact == kAbsent ? out.mayBeInDoubt : out.isInDoubt) = true;
                counts = counts || c.exact == kAt;
                break;
            case Piece::NearCap:  // drawn where the surface is behind it
                out.isInDoubt = out.isInDoubt || ((c.possible & kBefore) && (c.possible & kAt));
                break;
            case Piece::FarCap:  // counts before the background
                counts = c.exact == kAt;
                break;
            case Piece::LightCap:
                // Is a surface, and none lies before the one that is seen; but that one may be seen only
                // where this is not drawn.
                if (c.exact == kBefore && !(c.possible & (kAt | kBehind))) out.caps += c.front ? 1 : -1;
                continue;
            default:
                continue;
        }
        if (counts) out.net += c.front ? 1 : -1;
    }
    return out;
}

struct Outside {
    std::int64_t crossed = 0;  ///< volumes by pixels outside of their windows
    std::int64_t wrong = 0;    ///< those that matter there
    /// Those with a face that may be drawn there though it ends before: crossingsOf() lengthens the tips of
    /// slivers by far more than a rasteriser may move corners.
    std::int64_t beside = 0;
};

/// Holds the windows against all crossings of all rays.
void compareCrossings(const Scene& scene, const View& view, const DepthTies& ties, Silhouette silhouette,
                      Outside& outside) {
    const Reached reached = reachedIn(scene, view, ties, silhouette);
    const Crossings crossings = crossingsOf(scene, reached.lit, scene.lights.front().position, view, ties);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            crossings.each(std::uint32_t((view.height - 1 - y) * view.width + x), [&](std::uint32_t id) {
                const Signature& all = crossings.signatures[id];
                for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
                    while (last < all.size() && all[last].volume == all[first].volume) ++last;
                    if (reached.reach.windows[all[first].volume].holds(x, y)) continue;
                    const Counted one = counted(std::span(all).subspan(first, last - first));
                    ++outside.crossed;
                    outside.wrong += one.matters();
                    outside.beside += one.mayBeInDoubt;
                }
            });
        }
    }
}

TEST(ReachOf, LeavesOutOnlyWhatCancelsHoweverItIsDrawn) {
    Outside outside;
    for (const std::string id : {"roettger", "boxes"}) {
        const Scene scene = loadScene(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (id + ".toml"));
        for (std::size_t frame = 0; frame < scene.frames.size(); frame += 20)
            compareCrossings(scene, viewOf(scene.frames[frame], 160, 120), depthTies(frame == 0 ? 24 : 16),
                             Silhouette::Winding, outside);
        EXPECT_EQ(outside.wrong, 0) << id;
    }
    EXPECT_GT(outside.crossed, 10'000);
    RandomScenes scenes(77);
    for (int i = 0; i < 3000; ++i) {
        const Scene scene = scenes.next();
        const std::int64_t before = outside.wrong;
        compareCrossings(scene, viewOf(scene.frames.front(), 64, 48), depthTies(i % 3 == 0 ? 16 : 24),
                         i % 4 == 0 ? Silhouette::PerTriangle : Silhouette::Winding, outside);
        EXPECT_EQ(outside.wrong, before) << "scene " << i;
    }
    EXPECT_LT(outside.beside, 10);
    EXPECT_GT(outside.crossed, 1'000'000);
}

/// Looks down on a floor from 10 above, 10 by 10 units in 80x80 pixels: 8 pixels are a unit, 40 is its
/// middle.
Camera fromAbove() {
    return {.eye = {0, 10, 0},
            .target = {0, 0, 0},
            .up = {0, 0, -1},
            .fovDegrees = float(2 * std::atan(0.5) * 180 / std::numbers::pi),
            .nearPlane = 1};
}

Object boxAt(const glm::dvec3& size, const glm::vec3& at) {
    Object object{.mesh = box(size)};
    for (glm::vec3& p : object.mesh.positions) p += at;
    return object;
}

std::vector<WindowRect> windowsFromAbove(std::vector<Object> objects, const glm::vec4& light) {
    Scene scene;
    scene.objects = std::move(objects);
    scene.lights = {{.position = light}};
    scene.frames = {fromAbove()};
    return reachedIn(scene, viewOf(scene.frames[0], 80, 80), depthTies(24), Silhouette::Winding)
        .reach.windows;
}

const glm::vec4 kFromTheLeft(-0.8f, 0.6f, 0, 0);  // what is 3 high has a shadow 4 long

TEST(ReachOf, IsAStripWhereTheShadowFallsIntoTheWindow) {
    // A bar far to the left of the window, 3 to 3.2 above the floor: its shadow lies from x = 2 to x = 2.5.
    const auto windows =
        windowsFromAbove({floorOf(20), boxAt({0.2, 0.2, 4}, {-1.9 - 4, 3.1, 0})}, kFromTheLeft);
    ASSERT_EQ(windows.size(), 1u);
    const WindowRect& w = windows[0];
    EXPECT_FALSE(w.empty());
    // Its shadow begins near (-6, 3) + 4 and ends near (-5.8, 3.2) + 4.27; from z = -2 to z = 2.
    EXPECT_TRUE(w.holds(40 - 16 + 1, 40 - 15)) << w.x << " " << w.y;
    EXPECT_TRUE(w.holds(40 - 16 + 1, 40 + 15));
    // No more than the blocks in which it lies.
    EXPECT_LE(w.width, 16);
    EXPECT_LE(w.height, 48);
}

TEST(ReachOf, IsEmptyWhereTheShadowFallsBesideTheWindow) {
    const auto windows = windowsFromAbove({floorOf(40), boxAt({0.2, 0.2, 4}, {7, 3, 0})}, kFromTheLeft);
    EXPECT_THAT(windows, testing::ElementsAre(WindowRect{}));
}

TEST(ReachOf, IsEmptyWhereNothingIsSeenInTheVolume) {
    // Only air below: the floor ends left of the shadow.
    Object strip = floorOf(1);
    for (glm::vec3& p : strip.mesh.positions) p.x -= 3.5f;
    const auto windows = windowsFromAbove({strip, boxAt({0.2, 0.2, 4}, {-6, 3, 0})}, kFromTheLeft);
    EXPECT_THAT(windows, testing::ElementsAre(WindowRect{}));
}

TEST(ReachOf, IsEmptyOfACasterBehindAWall) {
    // The slab hides the box below it and its shadow too. (Its diagonal does not pass through pixel centres:
    // there a rasteriser might draw neither of two triangles, for all that SeenSurfaces says.)
    Object slab = boxAt({31, 0.2, 30}, {0.33f, 2, 0.21f});
    slab.casts = false;
    const auto windows = windowsFromAbove({floorOf(20), slab, boxAt({1, 1, 1}, {0, 1, 0})}, kFromTheLeft);
    EXPECT_THAT(windows, testing::ElementsAre(WindowRect{}));
}

TEST(ReachOf, LeavesOutSurfacesThatShadowOnlyWhatIsBehindThem) {
    // A floor that casts: its volume holds what is below. What it holds would be the whole window.
    Object floor = floorOf(20);
    floor.casts = true;
    const auto windows = windowsFromAbove({floor}, {1, 5, 2, 1});
    EXPECT_THAT(windows, testing::ElementsAre(WindowRect{}));
    // The same from below is all in its own shadow.
    const auto lit = windowsFromAbove({floor}, {1, -5, 2, 1});
    EXPECT_THAT(lit, testing::IsEmpty());  // one-sided
    floor.twoSided = true;
    EXPECT_THAT(windowsFromAbove({floor}, {1, -5, 2, 1}), testing::ElementsAre(WindowRect{0, 0, 80, 80}));
}

TEST(ReachOf, KeepsTheEdgesOfASurfaceThatItSees) {
    // A sheet in the air, lit from above: nothing that is seen lies in its shadow, but at its edges its sides
    // begin at its own depth.
    Object sheet = floorOf(2.5f + 1.0f / 16);  // the edges pass through pixel centres
    sheet.casts = true;
    const auto windows = windowsFromAbove({sheet}, {0, 1, 0, 0});
    ASSERT_EQ(windows.size(), 1u);
    EXPECT_TRUE(windows[0].holds(19, 19));
    EXPECT_TRUE(windows[0].holds(60, 60));
    EXPECT_LE(windows[0].width, 48);
}

/// The least distance between random points of a volume and of the near rectangle: no less than the true one.
double sampledNearDistance(const Scene& scene, const LitCaster& caster, const View& view,
                           RandomScenes& random) {
    const glm::vec4 light = scene.lights.front().position;
    const auto share = [&] { return double(random.point(1).x); };
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 300; ++i) {
        const glm::uvec3& t = caster.lit[std::size_t(i) % caster.lit.size()];
        const double u = std::abs(share()), v = std::abs(share()) * (1 - u);
        const auto at = [&](std::uint32_t k) {
            return glm::dvec3(scene.objects[caster.object].mesh.positions[k]);
        };
        const glm::dvec3 on = (1 - u - v) * at(t.x) + u * at(t.y) + v * at(t.z);
        const glm::dvec3 away = light.w == 0 ? -glm::dvec3(light) : on - glm::dvec3(light);
        const double far = std::abs(share());
        const glm::dvec3 held = on + far * far * 10 * away;
        // The nearest point of the rectangle.
        const glm::dvec3 from = held - view.eye;
        const double halfX = view.nearPlane * view.tanHalfX, halfY = view.nearPlane * view.tanHalfY;
        const glm::dvec3 least = view.nearPlane * view.forward +
                                 std::clamp(glm::dot(from, view.right), -halfX, halfX) * view.right +
                                 std::clamp(glm::dot(from, view.up), -halfY, halfY) * view.up;
        nearest = std::min(nearest, glm::distance(from, least));
    }
    return nearest;
}

TEST(NearDistances, AreNoMoreThanThoseOfAnyPointsAndZeroWhereTheVolumeMayTouch) {
    RandomScenes scenes(5);
    int touching = 0, apart = 0, close = 0;
    for (int i = 0; i < 1000; ++i) {
        const Scene scene = scenes.next();
        const glm::vec4 light = scene.lights.front().position;
        const View view = viewOf(scene.frames.front(), 16, 12);
        const Reached reached =
            reachedIn(scene, view, depthTies(24), i % 4 == 0 ? Silhouette::PerTriangle : Silhouette::Winding);
        for (std::size_t v = 0; v < reached.origins.size(); ++v) {
            LitCaster caster = reached.lit[reached.origins[v].caster];
            if (caster.perTriangle) caster.lit = {caster.lit[reached.origins[v].triangle]};
            const double distance = reached.reach.nearDistances[v];
            const bool touches = touchesNearRectangle(scene, caster, light, view);
            ASSERT_EQ(distance == 0, touches) << i;
            ++(touches ? touching : apart);
            if (touches) continue;
            const double sampled = sampledNearDistance(scene, caster, view, scenes);
            ASSERT_LE(distance, sampled) << i;
            close += distance > 0.5 * sampled;
        }
    }
    EXPECT_GT(touching, 100);
    EXPECT_GT(close, apart / 2);  // so the bound is of use
}

TEST(NearDistances, OfAShadowBesideTheEyeIsItsDistance) {
    Scene scene;
    scene.objects = {floorOf(20), boxAt({2, 1, 2}, {4, 6, 0})};
    scene.lights = {{.position = {0, 1, 0, 0}}};
    scene.frames = {{.eye = {0, 2, 0}, .target = {0, 2, -1}, .fovDegrees = 90, .nearPlane = 1}};
    const View view = viewOf(scene.frames[0], 100, 100);  // the near rectangle is 2 wide
    const Reached reached = reachedIn(scene, view, depthTies(24), Silhouette::Winding);
    EXPECT_THAT(reached.reach.nearDistances, testing::ElementsAre(testing::DoubleNear(2, 1e-9)));
}

double surfaceDistanceOf(const std::vector<Object>& objects) {
    Scene scene;
    scene.objects = objects;
    return surfaceDistance(scene, viewOf(fromAbove(), 80, 80));
}

TEST(SurfaceDistance, IsThatOfWhatTheWindowShows) {
    EXPECT_NEAR(surfaceDistanceOf({floorOf(20)}), 9, 1e-9);
    EXPECT_NEAR(surfaceDistanceOf({floorOf(20), boxAt({1, 1, 1}, {0, 3, 0})}), 5.5, 1e-6);
    // Beside the window, and behind the near plane.
    EXPECT_NEAR(surfaceDistanceOf({floorOf(20), boxAt({1, 1, 1}, {7, 7, 0})}), 9, 1e-9);
    EXPECT_NEAR(surfaceDistanceOf({floorOf(20), boxAt({0.1, 0.1, 0.1}, {0, 9.5f, 0})}), 9, 1e-9);
}

TEST(SurfaceDistance, IsZeroOfWhatReachesTheNearPlane) {
    EXPECT_EQ(surfaceDistanceOf({floorOf(20), boxAt({0.1, 4, 0.1}, {0, 8, 0})}), 0);
    // Not if it does so beside the window.
    EXPECT_GT(surfaceDistanceOf({floorOf(20), boxAt({0.1, 4, 0.1}, {4, 8, 0})}), 1);
}

TEST(SurfaceDistance, IsInfiniteWhereNothingIsSeen) {
    EXPECT_EQ(surfaceDistanceOf({}), std::numeric_limits<double>::infinity());
    EXPECT_EQ(surfaceDistanceOf({boxAt({1, 1, 1}, {0, 20, 0})}), std::numeric_limits<double>::infinity());
}

}  // namespace reach_test
}  // namespace gnomon
