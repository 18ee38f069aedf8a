#include "matrix/frame_scene.h"

#include <utility>

#include "matrix/depth_ties.h"
#include "matrix/kept.h"
#include "method/capacity.h"
#include "volume/blockers.h"

namespace gnomon {

FrameScene::FrameScene(Scene scene) : m_scene(std::move(scene)) {}

bool FrameScene::select(const Key& key) {
    if (key == m_key) return false;
    m_key = key;
    m_surfaces.reset();
    m_volumes.clear(), m_colours.clear(), m_truths.clear(), m_shapes.clear();
    m_eyeInside.clear(), m_nestings.clear();
    return true;
}

SilhouetteFinder& FrameScene::finder() {
    if (!m_finder) m_finder.emplace(m_scene);
    return *m_finder;
}

View FrameScene::view() const {
    return viewOf(m_scene.frames[std::size_t(m_key.frame)], m_key.width, m_key.height);
}

const std::vector<LitCaster>& FrameScene::litOf(int index, Silhouette silhouette, CapFaces capFaces) {
    return kept(m_lit, {index, silhouette, capFaces},
                [&] { return finder().lit(light(index).position, silhouette, capFaces); });
}

bool FrameScene::eyeInVolumes(int index) {
    auto [at, isNew] = m_eyeInside.try_emplace(index);
    if (isNew)
        at->second = eyeInVolume(m_scene, litOf(index, Silhouette::Winding), light(index).position, view());
    return at->second;
}

VolumeKey FrameScene::volumeKey(const Profile& profile, const Axes& axes, int index) {
    Parts parts = partsOf(axes.count);
    const bool capped = parts.has(Part::NearCap) && !eyeInVolumes(index);
    if (capped) parts = partsOf(Count::Zpass);
    return {axes.silhouette, axes.capFaces, parts, cutStyleOf(axes, profile.depthClamp)};
}

std::vector<VolumeKey> FrameScene::volumeKeys(const Profile& profile, const Axes& axes) {
    std::vector<VolumeKey> keys;
    const bool hasVolumes = axes.store != Store::None && axes.store != Store::DepthMap;
    for (int i = 0; hasVolumes && i < lights(); ++i) keys.push_back(volumeKey(profile, axes, i));
    return keys;
}

std::shared_ptr<const FrameVolumes> FrameScene::volumesOf(int index, const VolumeKey& k) {
    return kept(m_volumes, {index, k}, [&] {
        return std::make_shared<const FrameVolumes>(
            frameVolumes(m_scene, litOf(index, k.silhouette, k.capFaces), light(index).position, view(),
                         k.parts, k.style));
    });
}

const FrameSurfaces& FrameScene::surfacesOf() {
    if (!m_surfaces) m_surfaces = frameSurfaces(m_scene, view());
    return *m_surfaces;
}

std::shared_ptr<const LightColours> FrameScene::coloursOf(int index) {
    return kept(m_colours, index, [&] {
        return std::make_shared<const LightColours>(
            lightColours(m_scene, light(index), view(), surfacesOf()));
    });
}

std::shared_ptr<const Truth> FrameScene::truthOf(int index, int depthBits, DepthEncoding encoding,
                                                 Silhouette silhouette) {
    return kept(m_truths, {index, depthBits, encoding, silhouette}, [&] {
        const auto& tracer = kept(m_tracers, {index, silhouette}, [&] {
            return std::make_shared<Tracer>(m_scene, light(index), silhouette);
        });
        return std::make_shared<const Truth>(tracer->trace(view(), tiesOf(depthBits, encoding)));
    });
}

LightShape FrameScene::shapeOf(const Profile& profile, const Axes& axes, int index) {
    LightShape shape{.directional = light(index).position.w == 0};
    if (axes.store == Store::None || axes.store == Store::DepthMap) return shape;
    if (axes.start == Start::Bias)
        shape.holdingEye = holdingEye(m_scene, litOf(index, axes.silhouette, axes.capFaces),
                                      light(index).position, view().eye);
    if (axes.count == Count::AtomicZp) {
        shape.volumes = 1;  // in one draw
        return shape;
    }
    const VolumeKey k = volumeKey(profile, axes, index);
    auto [at, isNew] = m_shapes.try_emplace({index, k});
    if (isNew) at->second.volumes = int(volumesOf(index, k)->size());
    shape.volumes = at->second.volumes;
    return shape;
}

FrameShape FrameScene::frameShape(const Profile& profile, const Axes& axes) {
    FrameShape frame{.width = m_key.width, .height = m_key.height};
    for (int i = 0; i < lights(); ++i) frame.lights.push_back(shapeOf(profile, axes, i));
    return frame;
}

Plan FrameScene::planOf(const Profile& profile, const Axes& axes) {
    return planFrame(axes, frameShape(profile, axes), profile);
}

Nesting FrameScene::nestingOf(const Axes& axes, int index) {
    View mask = view();
    mask.width = (mask.width + axes.maskDivisor - 1) / axes.maskDivisor;
    mask.height = (mask.height + axes.maskDivisor - 1) / axes.maskDivisor;
    const CountedFrom from = countedFrom(axes);
    // All that are counted from one end are counted alike.
    const VolumeKey which{axes.silhouette,
                          axes.capFaces,
                          partsOf(from == CountedFrom::Eye ? Count::ZpassCap : Count::Zfail),
                          {.offset = axes.offset}};
    auto [at, isNew] = m_nestings.try_emplace({index, which, mask.width, mask.height});
    if (isNew)
        at->second = gnomon::nesting(m_scene, litOf(index, axes.silhouette, axes.capFaces),
                                     light(index).position, mask, from, axes.offset);
    return at->second;
}

}  // namespace gnomon
