#include "needs/reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "predict/crossings.h"
#include "random_scenes.h"
#include "scene/load.h"

namespace gnomon {
namespace {

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

}  // namespace
}  // namespace gnomon
