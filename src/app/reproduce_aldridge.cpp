#include "report/reproduce_aldridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/options.h"
#include "app/reproduce.h"
#include "app/terminal.h"
#include "matrix/lab.h"
#include "volume/mesh_facts.h"

namespace gnomon {
namespace {

constexpr int kRingLights = 16;        ///< around a scene that has but one
constexpr std::size_t kMostTimed = 4;  ///< lights; each costs a mask of the whole scene

/// At most kMostTimed of them, evenly spread.
std::vector<Light> timedOf(const std::vector<Light>& lights) {
    const std::size_t count = std::min(lights.size(), kMostTimed);
    std::vector<Light> some;
    for (std::size_t i = 0; i < count; ++i) some.push_back(lights[i * lights.size() / count]);
    return some;
}

}  // namespace

int reproduceAldridge(const ReproduceOptions& options) {
    const Profile ideal = ProfileOption{}.load({"ideal"}).front();
    Scene scene = theOnly("--scene", scenesOf(options, {"knot"}));
    if (std::none_of(scene.objects.begin(), scene.objects.end(), [](const Object& o) { return o.casts; }))
        throw UsageError(fmt::format("{}: no object casts a shadow", scene.id));
    const bool isRing = scene.lights.size() < 2;
    const MeshFacts facts = meshFacts(scene, isRing ? kRingLights : 0);
    const auto set = std::find_if(facts.lightSets.begin(), facts.lightSets.end(),
                                  [&](const LightSet& s) { return s.id == (isRing ? "ring" : "scene"); });
    scene.lights = timedOf(set->lights);
    scene.frames.resize(1);

    const Size size = options.size.value_or(Size{});
    AldridgeRun run{.scene = scene.id,
                    .triangles = facts.byObject.triangles,
                    .crowdedEdges = facts.byObject.nonManifoldEdges(),
                    .mostAtAnEdge = facts.byObject.maxValence(),
                    .lights = set->lights.size(),
                    .where = set->title,
                    .timedLights = int(scene.lights.size()),
                    .width = size.width,
                    .height = size.height,
                    .repeats = options.repeats.value_or(5),
                    .device = measuredOn(options.device),
                    .rows = aldridgeSection4()};
    const auto polygonsOf = [](const VolumeCount& count) { return count.polygons(); };
    std::vector<TimedWay> ways;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
        const Silhouette silhouette = i == 0 ? Silhouette::Winding : Silhouette::PerTriangle;
        run.rows[i].edges = i == 0 ? facts.byObject.edges : 3 * facts.byObject.triangles;
        run.rows[i].polygons = spread(*set, silhouette, polygonsOf).sum;
        Axes axes = findMethod("carmack")->axes;
        axes.silhouette = silhouette;
        ways.push_back({ideal, axes});
    }
    Lab lab(std::move(scene));
    lab.drawOn(options.device);
    TerminalProgress bar("frames");
    const auto times = lab.frameTimes(ways, size.width, size.height, 0, run.repeats, false,
                                      [&](const Progress& at) { bar.show(at); });
    bar.clear();
    for (std::size_t i = 0; i < ways.size(); ++i)
        for (const FrameTime& time : times[i]) run.rows[i].frameMs.push_back(time.total());
    fmt::print("{}", showAldridge(run, options.page));
    return 0;
}

}  // namespace gnomon
