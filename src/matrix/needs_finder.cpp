#include "matrix/needs_finder.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "matrix/depth_ties.h"
#include "needs/reach.h"
#include "needs/receivers.h"
#include "volume/blockers.h"

namespace gnomon {
namespace {

bool mayBeOpen(Silhouette silhouette) {
    return silhouette == Silhouette::Triangular || silhouette == Silhouette::Visible;
}

using SideList = std::vector<std::tuple<std::uint32_t, std::uint32_t, int>>;

SideList sortedSides(const LitCaster& caster) {
    SideList sides;
    for (const Side& side : caster.sides) sides.emplace_back(side.from, side.to, side.weight);
    std::sort(sides.begin(), sides.end());
    return sides;
}

/// Whether each volume has the sides of the builder that is right for any mesh.
bool areClosed(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light) {
    const std::vector<LitCaster> closed = litCasters(scene, light, Silhouette::Winding);
    return std::equal(
        lit.begin(), lit.end(), closed.begin(), closed.end(),
        [](const LitCaster& a, const LitCaster& b) { return sortedSides(a) == sortedSides(b); });
}

bool overlap(const WindowRect& a, const WindowRect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// The casters of those volumes that have a window.
std::vector<LitCaster> thatMatter(std::span<const LitCaster> lit, const std::vector<WindowRect>& windows) {
    std::vector<LitCaster> kept;
    std::size_t volume = 0;
    for (const LitCaster& caster : lit) {
        const std::size_t volumes = caster.perTriangle ? caster.lit.size() : !caster.lit.empty();
        const auto first = windows.begin() + std::ptrdiff_t(volume);
        volume += volumes;
        if (std::any_of(first, first + std::ptrdiff_t(volumes),
                        [](const WindowRect& r) { return !r.empty(); }))
            kept.push_back(caster);
    }
    return kept;
}

}  // namespace

struct NeedsFinder::Impl {
    explicit Impl(const Scene& s) : scene(s) {}

    const Scene& scene;
    View view{};
    std::optional<double> nearestSurface{};

    /// What is known of the volumes of one light, whatever counts them.
    struct Known {
        Reach reach{};
        bool isClosed = true, eyeIsOnFace = false;
        bool seesBackground = true, seesBackgroundInWindows = true;
        Nesting fromEye{};
    };
    using ViewKey = std::tuple<int, int, DepthEncoding>;  ///< divisor of the mask, depth
    std::map<ViewKey, std::shared_ptr<const Receivers>> receivers{};
    std::map<std::tuple<int, Silhouette, CapFaces, ViewKey>, Known> known{};

    View viewOf(int divisor) const {
        View mask = view;
        mask.width = (view.width + divisor - 1) / divisor;
        mask.height = (view.height + divisor - 1) / divisor;
        return mask;
    }

    const Receivers& receiversOf(const ViewKey& key) {
        auto& at = receivers[key];
        if (!at) {
            const auto& [divisor, bits, encoding] = key;
            at =
                std::make_shared<const Receivers>(SeenWindow(scene, viewOf(divisor), tiesOf(bits, encoding)));
        }
        return *at;
    }

    const Known& knownOf(const NeedsOf& of) {
        const ViewKey viewKey{of.axes.maskDivisor, of.depthBits, of.depth};
        auto [at, isNew] = known.try_emplace({of.light, of.axes.silhouette, of.axes.capFaces, viewKey});
        if (!isNew) return at->second;
        Known& k = at->second;
        const glm::vec4& light = scene.lights[std::size_t(of.light)].position;
        const View mask = viewOf(of.axes.maskDivisor);
        const Receivers& seen = receiversOf(viewKey);
        k.reach = reachOf(scene, of.lit, light, mask, seen);
        k.isClosed = !mayBeOpen(of.axes.silhouette) || areClosed(scene, of.lit, light);
        k.eyeIsOnFace = onVolumeFace(scene, of.lit, light, view.eye);
        const auto anyBlock = [&](const auto& isMeant) {
            return std::any_of(
                seen.blocks().begin(), seen.blocks().end(),
                [&](const Receivers::Block& block) { return block.seesBackground && isMeant(block.pixels); });
        };
        k.seesBackground = anyBlock([](const WindowRect&) { return true; });
        WindowRect all;
        for (const WindowRect& window : k.reach.windows) all = around(all, window);
        k.seesBackgroundInWindows = anyBlock([&](const WindowRect& block) { return overlap(all, block); });
        k.fromEye = nesting(scene, thatMatter(of.lit, k.reach.windows), light, mask);
        return k;
    }
};

NeedsFinder::NeedsFinder(const Scene& scene) : m_impl(std::make_unique<Impl>(scene)) {}
NeedsFinder::~NeedsFinder() = default;

void NeedsFinder::select(const View& view) {
    m_impl->view = view;
    m_impl->nearestSurface.reset();
    m_impl->receivers.clear();
    m_impl->known.clear();
}

double NeedsFinder::nearestSurface() {
    auto& nearest = m_impl->nearestSurface;
    if (!nearest) nearest = surfaceDistance(m_impl->scene, m_impl->view);
    return *nearest;
}

LightNeeds NeedsFinder::volumes(const NeedsOf& of) {
    const Impl::Known& known = m_impl->knownOf(of);
    LightNeeds needs;
    needs.isDrawn.resize(known.reach.windows.size());
    for (const std::uint32_t ordinal : of.drawn) needs.isDrawn[ordinal] = true;
    needs.windows = known.reach.windows;
    needs.nearDistances = known.reach.nearDistances;
    needs.isClosed = known.isClosed;
    needs.eyeIsOnFace = known.eyeIsOnFace;
    needs.seesBackground = known.seesBackground;
    needs.seesBackgroundInWindows = known.seesBackgroundInWindows;
    needs.full = of.full;
    needs.fromEye = known.fromEye;
    return needs;
}

}  // namespace gnomon
