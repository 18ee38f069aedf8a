#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/renderer.h"
#include "gl/tools.h"
#include "matrix/depth_ties.h"
#include "matrix/frame_predictor.h"
#include "matrix/judge.h"
#include "predict/window_prediction.h"
#include "volume/blockers.h"

namespace gnomon {

/// A frame that is right, or wrong in a known way, before a fault is planted.
struct SetUp {
    Scene (*scene)() = nullptr;
    std::string profile = "ideal";
    Axes axes{};
    FidelityChoice fidelity{};
    std::string known = "right";  ///< Verified::text() without a fault
};

/// What became of a frame.
struct Verified {
    int wrong = 0, unpredicted = 0;
    std::map<std::string, int> causes{};
    std::vector<PixelVerdict> pixels{};
    std::vector<std::uint16_t> values{};

    /// Pixels without a tie that hold another value than in @p other.
    int differentFrom(const Verified& other) const {
        int different = 0;
        for (std::size_t p = 0; p < values.size(); ++p)
            different += pixels[p] != PixelVerdict::Tied && values[p] != other.values[p];
        return different;
    }

    /// "right", or the causes and how many pixels are not predicted.
    std::string text() const {
        std::string out;
        for (const auto& cause : causes) out += (out.empty() ? "" : ", ") + cause.first;
        if (unpredicted > 0) out += fmt::format(", {} not predicted", unpredicted);
        return out.empty() ? "right" : out;
    }
};

/// What a mask is predicted from, by value, so that a test can falsify it.
struct Belief {
    Plan plan{};
    Crossings crossings{};
    MaskChannel arithmetic{};
    std::vector<int> planVolumes{};
    int holdingEye = 0;
};

/// One frame of one light with all that draws it and judges it, each part open to faults.
class FaultRig {
  public:
    static constexpr int kWidth = 128, kHeight = 96;

    explicit FaultRig(const SetUp& setUp)
        : axes(setUp.axes),
          profile(chip(setUp.profile)),
          scene(setUp.scene()),
          view(viewOf(scene.frames.front(), kWidth, kHeight)),
          lit(litCasters(scene, light(), axes.silhouette, axes.capFaces)),
          volumes(built(lit, light())),
          format(bufferFormatOf(profile)),
          plan(planned(axes)),
          arithmetic(arithmeticFor(plan, setUp.fidelity)),
          surface(format, kWidth, kHeight, arithmetic),
          m_surfaces(frameSurfaces(scene, view)),
          m_colours(
              std::make_shared<LightColours>(lightColours(scene, scene.lights.front(), view, m_surfaces))),
          m_truth(Tracer(scene, scene.lights.front(), axes.silhouette)
                      .trace(view, tiesOf(format.depth, arithmetic.depth))),
          m_predictor(scene) {
        m_predictor.select(view);
    }

    // What is drawn
    Axes axes{};
    const Profile profile;
    const Scene scene;
    const View view;
    std::vector<LitCaster> lit{};
    FrameVolumes volumes{};

    // What it is drawn with, as the predictor believes
    BufferFormat format{};
    Plan plan{};
    ChipArithmetic arithmetic{};

    Surface surface;
    std::function<void(Rendered&)> readOut{};  ///< what becomes of the masks that were read

    const glm::vec4& light() const { return scene.lights.front().position; }
    const Truth& truth() const { return m_truth; }

    /// The volumes of other lit casters, or of another light.
    FrameVolumes built(const std::vector<LitCaster>& casters, const glm::vec4& from) const {
        return frameVolumes(scene, casters, from, view, partsOf(axes.count),
                            cutStyleOf(axes, profile.depthClamp));
    }

    Plan planned(const Axes& which) const {
        FrameShape shape = shapeOf(int(volumes.size()), kWidth, kHeight);
        shape.lights[0].directional = light().w == 0;
        return planFrame(which, shape, profile);
    }

    Verified draw() {
        const Rendered rendered = drawn();
        const Judgement judgement = judged(rendered);
        const Explained explained = m_predictor.explain({.plan = plan,
                                                         .axes = axes,
                                                         .format = format,
                                                         .chip = arithmetic,
                                                         .truth = m_truth,
                                                         .judgement = judgement,
                                                         .values = rendered.values[0],
                                                         .ordinals = volumes.ordinals});
        Verified out{.wrong = judgement.wrong(),
                     .unpredicted = explained.unpredicted,
                     .causes = {},
                     .pixels = judgement.pixels,
                     .values = rendered.values[0]};
        for (const Cause cause : explained.causes)
            if (cause != Cause::None) ++out.causes[name(cause)];
        return out;
    }

    /// Pixels without a tie of the frame as it is drawn that are not predicted from a belief.
    int unpredictedBy(const std::function<void(Belief&)>& falsify) {
        const Rendered rendered = drawn();
        const Judgement judgement = judged(rendered);
        const auto all = litCasters(scene, light(), axes.silhouette, axes.capFaces);
        Belief belief{.plan = plan,
                      .crossings = crossingsOf(scene, all, light(), view,
                                               tiesOf(format.depth, arithmetic.depth), axes.offset),
                      .arithmetic = {.openGl = arithmetic.fidelity == Fidelity::Gl,
                                     .unit = arithmetic.unit,
                                     .dither = arithmetic.undithered,
                                     .format = {"", format.red, format.green, format.blue, format.alpha},
                                     .channel = axes.store == Store::Alpha ? 3 : 0},
                      .planVolumes = std::vector<int>(volumeCount(all), -1),
                      .holdingEye = holdingEye(scene, all, light(), view.eye)};
        for (std::size_t v = 0; v < volumes.ordinals.size(); ++v)
            belief.planVolumes[volumes.ordinals[v]] = int(v);
        if (falsify) falsify(belief);

        MaskPrediction mask({.plan = belief.plan,
                             .crossings = belief.crossings,
                             .arithmetic = belief.arithmetic,
                             .planVolumes = belief.planVolumes,
                             .holdingEye = belief.holdingEye});
        const WindowPrediction window(belief.plan, mask, belief.arithmetic.bits());
        int unpredicted = 0;
        for (std::size_t p = 0; p < rendered.values[0].size(); ++p)
            unpredicted +=
                judgement.pixels[p] != PixelVerdict::Tied && !window.allows(p, rendered.values[0][p]);
        return unpredicted;
    }

    /// A pixel in the middle of the window's largest shadow: none within two pixels is lit, or tied.
    std::size_t shadowPixel() const {
        const auto isDeep = [&](int x, int y) {
            for (int v = y - 2; v <= y + 2; ++v)
                for (int u = x - 2; u <= x + 2; ++u) {
                    const auto p = std::size_t(v * kWidth + u);
                    if (!m_truth.blocked[p] || m_truth.tie[p] != Tie::None || m_truth.facesAway[p])
                        return false;
                }
            return true;
        };
        for (int y = 2; y + 2 < kHeight; ++y)
            for (int x = 2; x + 2 < kWidth; ++x)
                if (isDeep(x, y)) return std::size_t(y * kWidth + x);
        throw std::logic_error("no shadow is five pixels wide");
    }

  private:
    /// Sums that wrap are emulated for plans that have them.
    ChipArithmetic arithmeticFor(const Plan& drawnPlan, const FidelityChoice& fidelity) const {
        ChipArithmetic chips = arithmeticOf(profile, fidelity);
        chips.wraps = chips.wraps &&
                      std::any_of(drawnPlan.passes.begin(), drawnPlan.passes.end(), [](const Pass& pass) {
                          return pass.blend.enabled && pass.blend.equation == BlendEquation::AddWrap;
                      });
        return chips;
    }

    Rendered drawn() {
        LightFrame frame{.colours = m_colours, .volumes = std::make_shared<FrameVolumes>(volumes)};
        frame.blockers = eyeBlockers(scene, lit, light(), view.eye);
        Rendered rendered =
            render(surface, profile, plan, m_surfaces, [&](int) -> const LightFrame& { return frame; });
        if (readOut) readOut(rendered);
        return rendered;
    }

    Judgement judged(const Rendered& rendered) const {
        return judge(m_truth, rendered.masks[0], axes.maskDivisor, axes.arithmetic != Arithmetic::Count);
    }

    FrameSurfaces m_surfaces{};
    std::shared_ptr<LightColours> m_colours{};
    Truth m_truth{};
    FramePredictor m_predictor;
};

}  // namespace gnomon
