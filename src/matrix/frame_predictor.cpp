#include "matrix/frame_predictor.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "matrix/depth_ties.h"
#include "matrix/kept.h"
#include "predict/map_prediction.h"
#include "volume/blockers.h"

namespace gnomon {
namespace {

bool isWrong(PixelVerdict verdict) {
    return verdict == PixelVerdict::WrongEdge || verdict == PixelVerdict::WrongInterior;
}

/// Whether sides of this kind may be wrong on a mesh that is not closed (volume.h, limitation()).
bool mayLeak(Silhouette silhouette) {
    return silhouette == Silhouette::Triangular || silhouette == Silhouette::Visible;
}

}  // namespace

struct FramePredictor::Impl {
    explicit Impl(const Scene& s) : scene(s) {}

    const Scene& scene;
    View view{};

    using LitKey = std::tuple<int, Silhouette, CapFaces>;
    std::map<LitKey, std::shared_ptr<const std::vector<LitCaster>>> casters{};  ///< by light, ...
    std::map<std::pair<int, int>, std::shared_ptr<MapDepths>> maps{};           ///< by light, size

    // Of the selected frame
    std::map<std::pair<int, DepthEncoding>, std::shared_ptr<const SeenWindow>> windows{};  ///< by depth
    using CrossingsKey = std::tuple<LitKey, float, int, int, DepthEncoding>;
    std::map<CrossingsKey, std::shared_ptr<const Crossings>>
        crossings{};  ///< by light, ..., offset, divisor of the mask, depth
    struct Eye {
        int held = 0;
        bool onFace = false;
    };
    std::map<LitKey, Eye> eyes{};

    const glm::vec4& light(int index) const { return scene.lights[std::size_t(index)].position; }

    std::shared_ptr<const std::vector<LitCaster>> litOf(const LitKey& key) {
        const auto& [index, silhouette, capFaces] = key;
        return kept(casters, key, [&, s = silhouette, c = capFaces, i = index] {
            return std::make_shared<const std::vector<LitCaster>>(litCasters(scene, light(i), s, c));
        });
    }

    template <class AnyMask>
    std::shared_ptr<const Crossings> crossingsOf(const LitKey& key, float offset, int divisor,
                                                 const AnyMask& mask) {
        const int depth = mask.format.depth;
        return kept(crossings, {key, offset, divisor, depth, mask.chip.depth}, [&] {
            View seen = view;
            seen.width = (view.width + divisor - 1) / divisor;
            seen.height = (view.height + divisor - 1) / divisor;
            return std::make_shared<const Crossings>(gnomon::crossingsOf(
                scene, *litOf(key), light(mask.light), seen, tiesOf(depth, mask.chip.depth), offset));
        });
    }

    std::shared_ptr<const SeenWindow> windowOf(const RenderedMask& mask) {
        const int depth = mask.format.depth;
        return kept(windows, {depth, mask.chip.depth}, [&] {
            return std::make_shared<const SeenWindow>(scene, view, tiesOf(depth, mask.chip.depth));
        });
    }

    std::shared_ptr<MapDepths> depthsOf(int index, int size) {
        return kept(maps, {index, size},
                    [&] { return std::make_shared<MapDepths>(scene, light(index), size); });
    }

    const Eye& eyeOf(const LitKey& key) {
        auto [at, isNew] = eyes.try_emplace(key);
        if (isNew) {
            const auto lit = litOf(key);
            const glm::vec4& l = light(std::get<0>(key));
            at->second = {holdingEye(scene, *lit, l, view.eye), onVolumeFace(scene, *lit, l, view.eye)};
        }
        return at->second;
    }

    static MaskChannel arithmeticOf(const PlannedMask& mask) {
        MaskChannel channel = maskChannel(mask.format, mask.chip, mask.axes);
        if (mask.axes.store == Store::Screen) channel.channel = mask.colour;
        return channel;
    }
    static MaskChannel arithmeticOf(const RenderedMask& mask) {
        return maskChannel(mask.format, mask.chip, mask.axes);
    }

    /// The pixels that hold what @p prediction does not allow; counts them.
    template <class Prediction>
    static std::vector<bool> held(const RenderedMask& mask, const Prediction& prediction, Explained& out) {
        std::vector<bool> isUnpredicted(mask.values.size());
        for (std::size_t p = 0; p < mask.values.size(); ++p) {
            if (mask.judgement.pixels[p] == PixelVerdict::Tied || prediction.allows(p, mask.values[p]))
                continue;
            isUnpredicted[p] = true;
            ++out.unpredicted;
        }
        return isUnpredicted;
    }

    /// A mask of volumes, predicted.
    struct Predicted {
        template <class AnyMask>
        Predicted(Impl& impl, const AnyMask& of)
            : key{of.light, of.axes.silhouette, of.axes.capFaces},
              crossings(impl.crossingsOf(key, of.axes.offset, of.axes.maskDivisor, of)),
              planVolumes(impl.planVolumesOf(key, of)),
              inputs{.plan = of.plan,
                     .light = of.light,
                     .crossings = *crossings,
                     .arithmetic = arithmeticOf(of),
                     .planVolumes = planVolumes,
                     .holdingEye = impl.eyeOf(key).held,
                     .eyeOnFace = impl.eyeOf(key).onFace},
              mask(inputs),
              window(of.plan, mask, inputs.arithmetic.bits()) {}

        LitKey key;
        std::shared_ptr<const Crossings> crossings;
        std::vector<int> planVolumes;
        MaskInputs inputs;
        MaskPrediction mask;
        WindowPrediction window;
    };

    template <class AnyMask>
    std::vector<int> planVolumesOf(const LitKey& key, const AnyMask& of) {
        std::vector<int> indices(volumeCount(*litOf(key)), of.leavesOut ? kLeftOut : -1);
        for (std::size_t v = 0; v < of.ordinals.size(); ++v) indices[of.ordinals[v]] = int(v);
        return indices;
    }

    int wrongPixels(const PlannedMask& of, const Truth& truth) {
        Predicted predicted(*this, of);
        std::vector<bool> shadow(truth.blocked.size());
        for (std::size_t p = 0; p < shadow.size(); ++p) shadow[p] = predicted.window.shadow(p);
        const bool clamps = of.axes.arithmetic != Arithmetic::Count;
        return judge(truth, shadow, of.axes.maskDivisor, clamps).wrong();
    }

    bool areSame(const PlannedMask& a, const PlannedMask& b) {
        const Predicted first(*this, a), second(*this, b);
        for (int y = 0; y < first.mask.height(); ++y)
            for (int x = 0; x < first.mask.width(); ++x)
                if (first.mask.value(x, y) != second.mask.value(x, y) ||
                    !std::ranges::includes(first.mask.values(x, y), second.mask.values(x, y)))
                    return false;
        return true;
    }

    Explained explain(const RenderedMask& mask) {
        Explained out;
        const Axes& axes = mask.axes;
        const auto causeEach = [&](const auto& causeOf) {
            if (mask.judgement.wrong() == 0) return;
            out.causes.assign(mask.values.size(), Cause::None);
            for (std::size_t p = 0; p < mask.values.size(); ++p)
                if (isWrong(mask.judgement.pixels[p])) out.causes[p] = causeOf(p);
        };
        if (axes.store == Store::None) {
            causeEach([](std::size_t) { return Cause::NoShadowDrawn; });
            return out;
        }
        if (axes.store == Store::DepthMap) {
            const MapMaskInputs inputs{.plan = mask.plan,
                                       .window = *windowOf(mask),
                                       .depths = *depthsOf(mask.light, mask.plan.mapSize),
                                       .arithmetic = arithmeticOf(mask)};
            const MapPrediction prediction(inputs);
            const std::vector<bool> isUnpredicted = held(mask, prediction, out);
            causeEach([&](std::size_t p) {
                return isUnpredicted[p] ? Cause::Unexplained : prediction.causeOf(p, mask.truth.blocked[p]);
            });
            return out;
        }

        const LitKey key{mask.light, axes.silhouette, axes.capFaces};
        Predicted predicted(*this, mask);
        const std::vector<bool> isUnpredicted = held(mask, predicted.window, out);

        std::shared_ptr<const Crossings> whole, winding;
        CauseInputs causes{.truth = mask.truth, .mask = predicted.inputs, .prediction = predicted.mask};
        causes.parity = axes.arithmetic == Arithmetic::Parity;
        causes.halves = axes.arithmetic == Arithmetic::Halve;
        causes.insideOut = axes.capFaces == CapFaces::Away;
        causes.offset = axes.offset != 0;
        causes.fullSize = [&]() -> const Crossings& {
            return *(whole = crossingsOf(key, axes.offset, 1, mask));
        };
        if (mayLeak(axes.silhouette))
            causes.winding = [&]() -> const Crossings& {
                return *(winding = crossingsOf({mask.light, Silhouette::Winding, CapFaces::Lit}, 0, 1, mask));
            };
        Explainer explainer(causes);
        causeEach(
            [&](std::size_t p) { return isUnpredicted[p] ? Cause::Unexplained : explainer.causeOf(p); });
        return out;
    }
};

MaskChannel maskChannel(const BufferFormat& format, const ChipArithmetic& chip, const Axes& axes) {
    return {.openGl = chip.fidelity == Fidelity::Gl,
            .unit = chip.unit,
            .dither = chip.undithered,
            .format = {"", format.red, format.green, format.blue, format.alpha},
            .channel = axes.store == Store::Alpha ? 3 : 0};
}

FramePredictor::FramePredictor(const Scene& scene) : m_impl(std::make_unique<Impl>(scene)) {}
FramePredictor::~FramePredictor() = default;

void FramePredictor::select(const View& view) {
    m_impl->view = view;
    m_impl->crossings.clear();
    m_impl->eyes.clear();
    m_impl->windows.clear();
}

int FramePredictor::wrongPixels(const PlannedMask& mask, const Truth& truth) {
    return m_impl->wrongPixels(mask, truth);
}

bool FramePredictor::areSame(const PlannedMask& a, const PlannedMask& b) {
    return m_impl->areSame(a, b);
}

Explained FramePredictor::explain(const RenderedMask& mask) {
    return m_impl->explain(mask);
}

}  // namespace gnomon
