#include "volume/mesh_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/framing.h"
#include "scene/weld.h"

namespace gnomon {
namespace {

void add(Topology& sum, const Topology& t) {
    sum.triangles += t.triangles;
    sum.vertices += t.vertices;
    sum.edges += t.edges;
    for (const auto& [valence, count] : t.valences) sum.valences[valence] += count;
    sum.windingConflicts += t.windingConflicts;
    sum.unbalancedEdges += t.unbalancedEdges;
    sum.duplicates += t.duplicates;
    sum.duplicatesSameWay += t.duplicatesSameWay;
    sum.tJunctions += t.tJunctions;
    sum.components += t.components;
    sum.bowTies += t.bowTies;
}

/// The first limitation() of a casting object, with the object's name.
std::optional<std::string> firstLimitation(const Scene& scene, Silhouette silhouette) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.casts) continue;
        if (const auto why = limitation(object.mesh, silhouette, object.twoSided))
            return fmt::format("object {} ({}): {}", i, object.name, *why);
    }
    return {};
}

LightSet ringAround(const Bounds& bounds, int count) {
    const double distance = 2 * bounds.radius, height = bounds.centre.y + bounds.radius;
    LightSet set{.id = "ring"};
    set.title = fmt::format(
        "{} point light{} around ({:.4g}, {:.4g}, {:.4g}), {:.4g} from the axis, at height {:.4g}", count,
        count == 1 ? "" : "s", bounds.centre.x, bounds.centre.y, bounds.centre.z, distance, height);
    for (int i = 0; i < count; ++i) {
        // Not along the axes: the faces of many a mesh are edge-on there.
        const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
        set.lights.push_back({.position = glm::vec4(bounds.centre.x + distance * std::sin(angle), height,
                                                    bounds.centre.z + distance * std::cos(angle), 1)});
    }
    return set;
}

LightSet ownLights(const Scene& scene) {
    const auto points = std::count_if(scene.lights.begin(), scene.lights.end(),
                                      [](const Light& light) { return light.position.w != 0; });
    return {.id = "scene",
            .title = fmt::format("{} point and {} directional lights of the scene", points,
                                 std::ssize(scene.lights) - points),
            .lights = scene.lights};
}

}  // namespace

CountSpread spread(const LightSet& set, Silhouette silhouette, std::size_t (*of)(const VolumeCount&)) {
    std::vector<std::size_t> values;
    for (const VolumeCounts& counts : set.counts) values.push_back(of(counts[std::size_t(silhouette)]));
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    CountSpread result{values.front(), values[(values.size() - 1) / 2], values.back()};
    for (const std::size_t value : values) result.sum += value;
    return result;
}

MeshFacts meshFacts(const Scene& scene, int ringLights) {
    MeshFacts facts{
        .id = scene.id, .repeatedVertex = scene.dropped.repeatedVertex, .flat = scene.dropped.flat.size()};

    // The mesh: of the file, as drawn, and as the casters that volumes are built of.
    const Object whole{.mesh = joinCasters(scene, false)};
    facts.drawn = topologyOf(whole.mesh);
    facts.file = facts.flat == 0 ? facts.drawn : topologyOf(joinCasters(scene, true));
    const auto casting = std::count_if(scene.objects.begin(), scene.objects.end(),
                                       [](const Object& object) { return object.casts; });
    facts.leftOut = scene.objects.size() - std::size_t(casting);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.casts) continue;
        facts.objects.push_back({i, object.name, casting == 1 ? facts.drawn : topologyOf(object.mesh)});
        add(facts.byObject, facts.objects.back().topology);
    }

    // What can be built of it.
    for (int i = 0; i < kSilhouettes; ++i) {
        const auto silhouette = Silhouette(i);
        BuilderFacts builder{.silhouette = silhouette, .refusal = refusal(scene, silhouette)};
        if (!builder.refusal) builder.limitation = firstLimitation(scene, silhouette);
        facts.builders.push_back(builder);
    }
    facts.awayRefusal = refusal(scene, Silhouette::Winding, CapFaces::Away);

    // What that comes to.
    if (ringLights > 0) facts.lightSets.push_back(ringAround(boundsOf({&whole, 1}), ringLights));
    if (!scene.chosenLight && !scene.lights.empty()) facts.lightSets.push_back(ownLights(scene));
    if (facts.lightSets.empty()) return facts;
    SilhouetteCounter counter(scene);
    for (LightSet& set : facts.lightSets)
        for (const Light& light : set.lights) set.counts.push_back(counter.count(light.position));
    return facts;
}

}  // namespace gnomon
