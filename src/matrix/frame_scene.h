#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "gl/light_frame.h"
#include "matrix/result_key.h"
#include "method/method.h"
#include "plan/plan.h"
#include "profile/profile.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "truth/truth.h"
#include "volume/frame_volumes.h"
#include "volume/nesting.h"
#include "volume/silhouette_finder.h"

namespace gnomon {

/// A scene and one frame of its camera path, with what all chips and methods share of them: surfaces, lit
/// casters, volumes, truth, nesting bounds. Each is made when it is first asked for.
class FrameScene {
  public:
    explicit FrameScene(Scene scene);

    struct Key {
        int width = 0, height = 0, frame = 0;
        auto operator<=>(const Key&) const = default;
    };

    /// The frame that is asked about from now on.
    /// @returns whether it is another than before
    bool select(const Key& key);

    const Key& key() const { return m_key; }
    const Scene& scene() const { return m_scene; }
    int lights() const { return int(m_scene.lights.size()); }
    const Light& light(int index) const { return m_scene.lights[std::size_t(index)]; }
    View view() const;

    /// Of all frames. The finder's edges are made once for a scene.
    SilhouetteFinder& finder();
    const std::vector<LitCaster>& litOf(int index, Silhouette silhouette, CapFaces capFaces = CapFaces::Lit);

    /// Whether the eye is inside a volume of light @p index.
    bool eyeInVolumes(int index);

    /// Away from all volumes a near cap changes nothing, and all counts before the surface share their
    /// volumes.
    VolumeKey volumeKey(const Profile& profile, const Axes& axes, int index);
    /// By light; empty of a method without volumes.
    std::vector<VolumeKey> volumeKeys(const Profile& profile, const Axes& axes);
    std::shared_ptr<const FrameVolumes> volumesOf(int index, const VolumeKey& key);

    const FrameSurfaces& surfacesOf();
    std::shared_ptr<const LightColours> coloursOf(int index);

    /// @param silhouette  count ties are about the sides that are drawn
    std::shared_ptr<const Truth> truthOf(int index, int depthBits, DepthEncoding encoding,
                                         Silhouette silhouette);

    FrameShape frameShape(const Profile& profile, const Axes& axes);
    /// The full plan.
    Plan planOf(const Profile& profile, const Axes& axes);

    /// How deep the volumes of light @p index may nest in the mask.
    Nesting nestingOf(const Axes& axes, int index);

  private:
    Scene m_scene;
    std::optional<SilhouetteFinder> m_finder{};
    std::map<std::tuple<int, Silhouette, CapFaces>, std::vector<LitCaster>> m_lit{};  ///< by light, ...
    std::map<std::tuple<int, Silhouette>, std::shared_ptr<Tracer>> m_tracers{};

    // Of the frame.
    Key m_key{};
    std::optional<FrameSurfaces> m_surfaces{};
    std::map<std::pair<int, VolumeKey>, std::shared_ptr<const FrameVolumes>> m_volumes{};
    std::map<int, std::shared_ptr<const LightColours>> m_colours{};
    std::map<std::tuple<int, int, DepthEncoding, Silhouette>, std::shared_ptr<const Truth>>
        m_truths{};  ///< by light, depth format
    std::map<std::pair<int, VolumeKey>, LightShape> m_shapes{};
    std::map<int, bool> m_eyeInside{};
    std::map<std::tuple<int, VolumeKey, int, int>, Nesting> m_nestings{};  ///< by light, volumes, size

    LightShape shapeOf(const Profile& profile, const Axes& axes, int index);
};

}  // namespace gnomon
