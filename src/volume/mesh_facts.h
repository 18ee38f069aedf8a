#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/topology.h"
#include "volume/silhouette_counts.h"

namespace gnomon {

/// What one builder can make of the casters.
struct BuilderFacts {
    Silhouette silhouette{};
    std::optional<std::string> refusal{};     ///< why it can't take them
    std::optional<std::string> limitation{};  ///< how its volumes can be wrong although it takes them
};

/// The volumes of several lights.
struct LightSet {
    std::string id{};     ///< "ring" or "scene"
    std::string title{};  ///< where the lights are, in words and numbers
    std::vector<Light> lights{};
    std::vector<VolumeCounts> counts{};  ///< of each light
};

/// Least, middle (the lower of two), most and sum over the lights of a set, of what @p of says of
/// @p silhouette's volumes; 0 without any light.
struct CountSpread {
    std::size_t least = 0, median = 0, most = 0, sum = 0;
};
CountSpread spread(const LightSet& set, Silhouette silhouette, std::size_t (*of)(const VolumeCount&));

struct ObjectFacts {
    std::size_t index = 0;  ///< into Scene::objects
    std::string name{};
    Topology topology{};
};

/// What the topology of a scene's casters means for shadow volumes.
struct MeshFacts {
    std::string id{};                ///< of the scene
    std::size_t repeatedVertex = 0;  ///< triangles of the file that repeat a vertex: left out of all below
    std::size_t flat = 0;            ///< triangles of the file without area: not drawn
    Topology file{};                 ///< all casters as one mesh, with the triangles without area
    Topology drawn{};                ///< the same without them
    std::vector<ObjectFacts> objects{};  ///< the casting objects: the meshes that volumes are built of
    std::size_t leftOut = 0;             ///< objects that cast nothing
    Topology byObject{};                 ///< the sum over them, without examples of edges
    std::vector<BuilderFacts> builders{};
    std::optional<std::string> awayRefusal{};  ///< why faces turned away can't cap (CapFaces::Away)
    std::vector<LightSet> lightSets{};
};

/// @param ringLights number of lights of the ring around the casters; 0 for none. They stand at the same
///                   angle from each other, twice as far from the axis through the middle of the bounding box
///                   as the radius of its sphere, and that radius above its middle.
/// @pre a caster
MeshFacts meshFacts(const Scene& scene, int ringLights);

}  // namespace gnomon
