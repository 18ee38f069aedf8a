#include "predict/causes.h"

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon {
namespace {

const std::array<std::string, kCauses>& names() {
    static const std::array<std::string, kCauses> kNames{
        "",
        "no shadow is drawn",
        "mask clamps",
        "mask underflows",
        "mask wraps",
        "stencil saturates",
        "stencil wraps to zero",
        "parity of overlapping volumes",
        "rounding residue",
        "dither drift",
        "eye inside a volume",
        "eye on a face of a volume",
        "near plane cuts a volume",
        "far plane",
        "open or inconsistently wound caster",
        "inside of a caster",
        "volume begins behind its caster",
        "background at infinity inside a volume",
        "depth precision",
        "own cap and side within a few depth quanta",
        "low mask resolution",
        "shadow-map resolution",
        "shadow-map bias",
        "unexplained",
    };
    return kNames;
}

}  // namespace

const std::string& name(Cause cause) {
    return names()[std::size_t(cause)];
}

Cause causeNamed(const std::string& wanted) {
    const auto found = std::find(names().begin() + 1, names().end(), wanted);
    return found == names().end() ? Cause::None : Cause(found - names().begin());
}

struct Explainer::Impl {
    explicit Impl(const CauseInputs& inputs) : in(inputs) {}

    /// The same plan with another arithmetic or other crossings, made when it is first asked for.
    MaskPrediction& made(std::optional<MaskPrediction>& prediction, const Crossings& crossings,
                         const MaskChannel& arithmetic) {
        if (!prediction) {
            MaskInputs other{.plan = in.mask.plan,
                             .light = in.mask.light,
                             .crossings = crossings,
                             .arithmetic = arithmetic,
                             .planVolumes = in.mask.planVolumes,
                             .holdingEye = in.mask.holdingEye,
                             .eyeOnFace = in.mask.eyeOnFace};
            prediction.emplace(other);
        }
        return *prediction;
    }

    bool isFullSize() const {
        return in.mask.crossings.width == in.mask.plan.width &&
               in.mask.crossings.height == in.mask.plan.height;
    }

    /// At the window's own size, in the chip's arithmetic.
    MaskPrediction& whole() {
        return isFullSize() ? in.prediction : made(fullSize, in.fullSize(), in.mask.arithmetic);
    }
    const Crossings& wholeCrossings() { return isFullSize() ? in.mask.crossings : in.fullSize(); }

    MaskPrediction& undithered() {
        MaskChannel arithmetic = in.mask.arithmetic;
        arithmetic.dither = DitherMode::Off;
        return made(withoutDither, wholeCrossings(), arithmetic);
    }
    MaskPrediction& byOpenGl() {
        MaskChannel arithmetic = in.mask.arithmetic;
        arithmetic.openGl = true;
        arithmetic.dither = DitherMode::Off;
        return made(openGl, wholeCrossings(), arithmetic);
    }

    Cause limit(const MaskPrediction& prediction) const {
        if (in.parity) return Cause::ParityOverlaps;
        const bool wraps = prediction.wraps();
        if (prediction.isStencil()) return wraps ? Cause::StencilWraps : Cause::StencilSaturates;
        if (in.halves) return Cause::MaskUnderflows;
        return wraps ? Cause::MaskWraps : Cause::MaskClamps;
    }

    Cause causeOf(std::size_t pixel) {
        const int width = in.mask.plan.width;
        const int x = int(pixel % std::size_t(width)), y = int(pixel / std::size_t(width));
        const bool blocked = in.truth.blocked[pixel];
        const auto isRight = [&](MaskPrediction& p) { return p.isShadow(p.value(x, y)) == blocked; };

        MaskPrediction& prediction = whole();
        if (prediction.startsAtEye() && in.mask.eyeOnFace) return Cause::EyeOnFace;
        if (isRight(prediction)) {
            if (!isFullSize()) return Cause::MaskResolution;
            // Right by luck, with entries lost; or a mask without limits would be right however doubtful
            // faces fall.
            const auto [least, most] = prediction.unlimitedCounts(x, y);
            const bool isFirm = blocked ? least > 0 || most < 0 : least == 0 && most == 0;
            if (isFirm || prediction.isStuck(x, y)) return limit(prediction);
            return prediction.doubt(x, y) == MaskPrediction::Doubt::Own ? Cause::OwnCapAndSide
                                                                        : Cause::DepthPrecision;
        }

        // The arithmetic
        const int count = prediction.unlimitedCount(x, y);
        if ((count != 0) == blocked) {
            const MaskChannel& arithmetic = in.mask.arithmetic;
            const bool isChips = !arithmetic.openGl && prediction.hasCodes();
            if (isChips && arithmetic.period() > 1 && isRight(undithered())) return Cause::DitherDrift;
            if (isChips && isRight(byOpenGl())) return Cause::RoundingResidue;
            return limit(prediction);
        }

        // The start
        if (prediction.countsFromEye()) {
            const int caps = prediction.startsAtEye() ? 0 : prediction.uncountedNearCaps(x, y);
            if (caps != 0 && (count + caps != 0) == blocked)
                return in.mask.holdingEye != 0 ? Cause::EyeInside : Cause::NearPlaneCuts;
        }

        // The volumes
        if (in.insideOut) return Cause::InsideOfCaster;
        if (in.winding) {
            const Crossings& winding = in.winding();
            const auto at = winding.exact[std::size_t(y) * std::size_t(winding.width) + std::size_t(x)];
            if ((volumesAround(winding.signatures[at]) != 0) == blocked) return Cause::OpenCaster;
        }
        if (in.offset) return Cause::VolumeOffset;
        if (in.truth.shadow[pixel] == Shadow::Background) return Cause::BackgroundInside;
        return Cause::Unexplained;
    }

    const CauseInputs in;
    std::optional<MaskPrediction> fullSize{}, withoutDither{}, openGl{};
};

Explainer::Explainer(const CauseInputs& in) : m_impl(std::make_unique<Impl>(in)) {}
Explainer::~Explainer() = default;

Cause Explainer::causeOf(std::size_t pixel) {
    return m_impl->causeOf(pixel);
}

}  // namespace gnomon
