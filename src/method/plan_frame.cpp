#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "method/method.h"

namespace gnomon {
namespace {

using enum BlendFactor;

constexpr float kHalf =
    128.0f / 255;  ///< one half as hardware of the time wants it: 127 loses white (hardware.md, 4.1)

Blend blend(BlendFactor source, BlendFactor destination) {
    return {.enabled = true, .source = source, .destination = destination};
}

/// Builds the passes of one frame. The steps of each store stand in planFrame().
class Builder {
  public:
    Builder(const Axes& axes, const FrameShape& frame, const Profile& profile)
        : m_axes(axes), m_frame(frame), m_profile(profile) {
        m_plan.width = frame.width;
        m_plan.height = frame.height;
        m_plan.maskWidth = (frame.width + axes.maskDivisor - 1) / axes.maskDivisor;
        m_plan.maskHeight = (frame.height + axes.maskDivisor - 1) / axes.maskDivisor;
    }

    Pass& add(PassKind kind, std::string label) {
        Pass& pass = m_plan.passes.emplace_back();
        pass.kind = kind;
        pass.label = std::move(label);
        return pass;
    }

    /// @p value: where a mask starts; with @p background only in alpha
    void clear(const std::string& label, float value, ColourWrite write, bool background) {
        Pass& pass = add(PassKind::Clear, label);
        pass.colour = glm::vec4(value);
        pass.clearsToBackground = background;
        pass.clearsDepth = true;
        pass.clearsStencil = m_axes.store == Store::Stencil;
        pass.write = write;
    }

    void sceneDepth() {
        Pass& pass = add(PassKind::Scene, "scene: depth only");
        pass.lowResolution = m_axes.maskDivisor != 1;
        pass.depthTest = pass.depthWrite = true;
        pass.write = kWriteNothing;
    }

    void sceneFirst(Shading shading) {
        Pass& pass = add(PassKind::Scene, shading == Shading::Lit ? "scene: lit" : "scene: the light's part");
        pass.shading = shading;
        pass.depthTest = pass.depthWrite = true;
    }

    /// The scene again, over the depth that it left behind.
    void sceneAgain(const std::string& label, Shading shading, Blend how) {
        Pass& pass = add(PassKind::Scene, label);
        pass.shading = shading;
        pass.depthTest = true;
        pass.depthFunction = Compare::Lequal;
        pass.blend = how;
    }

    Pass& rectangle(const std::string& label, Blend how, float value, ColourWrite write) {
        Pass& pass = add(PassKind::Rectangle, label);
        pass.blend = how;
        pass.colour = glm::vec4(value);
        pass.write = write;
        return pass;
    }

    Pass& volume(int index, Faces faces, const std::string& what) {
        const char* which = faces == Faces::Front  ? "front faces"
                            : faces == Faces::Back ? "back faces"
                                                   : "front and back faces";
        Pass& pass = add(PassKind::Volume, index == kAllVolumes
                                               ? fmt::format("{} of all volumes: {}", which, what)
                                               : fmt::format("{} of volume {}: {}", which, index, what));
        pass.volume = index;
        pass.faces = faces;
        pass.depthTest = true;
        // LEQUAL lets the far cap pass where depth was cleared, so that the background counts out of every
        // volume.
        pass.depthFunction = Compare::Lequal;
        pass.lowResolution = m_axes.maskDivisor != 1;
        return pass;
    }

    void countInStencil() {
        const bool wrap = m_profile.stencilWrap;
        const StencilSide up{.onPass = wrap ? StencilOp::IncrWrap : StencilOp::Incr};
        const StencilSide down{.onPass = wrap ? StencilOp::DecrWrap : StencilOp::Decr};
        const auto pass = [&](Faces faces, const StencilSide& front, const StencilSide& back,
                              const std::string& what) {
            Pass& p = volume(kAllVolumes, faces, what);
            p.write = kWriteNothing;
            p.stencil = {.enabled = true, .front = front, .back = back};
        };
        if (m_frame.volumes > 0 && m_profile.twoSidedStencil && wrap) {
            pass(Faces::Both, up, down, "count +1 and -1");
        } else if (m_frame.volumes > 0) {
            // Up before down: a decrement that clamps at 0 before its increment would lose a count.
            pass(Faces::Front, up, up, "count +1");
            pass(Faces::Back, down, down, "count -1");
        }
        m_plan.maskPlace = MaskPlace::Stencil;
        m_plan.maskReady = m_plan.passes.size();
    }

    /// Roettger et al. 2002, section 4.2: front faces of a volume, then its back faces, volume by volume.
    void countByBlending(ColourWrite write) {
        const bool halves = m_axes.arithmetic == Arithmetic::Halve;
        const auto pass = [&](int index, Faces faces, bool doubles) {
            Pass& p = volume(index, faces, doubles ? "double" : "halve");
            p.blend = doubles ? blend(DstColor, One) : blend(DstColor, Zero);
            p.colour = glm::vec4(doubles ? 1.0f : kHalf);
            p.write = write;
        };
        for (int i = 0; i < m_frame.volumes; ++i) {
            pass(i, Faces::Front, !halves);
            pass(i, Faces::Back, halves);
        }
    }

    /// Section 4.3 and 4.4: the mask's values become one for a lit pixel and one for a shadow.
    void normalise(ColourWrite write) {
        const auto rect = [&](const std::string& label, Blend how, float value) {
            rectangle(label, how, value, write).lowResolution = m_axes.maskDivisor != 1;
        };
        const bool attenuated = m_axes.shade == Shade::Attenuated;
        if (m_axes.arithmetic == Arithmetic::Halve && attenuated) {
            rect("raise shadows to 1/2", {.enabled = true, .equation = BlendEquation::Max}, kHalf);
        } else {
            // From 2^-levels to 1/2 for a lit pixel; halving started at 1 and leaves shadows at 1/2 or below,
            // so that inverting comes first there.
            const bool halve = m_axes.arithmetic == Arithmetic::Halve;
            if (!halve)
                for (int i = 1; i < m_axes.levels; ++i)
                    rect("double: lit to 1/2, shadows clamp at 1", blend(DstColor, One), 1);
            if (halve) {
                rect("invert: lit to 0, shadows to 1/2 or more", blend(OneMinusDstColor, Zero), 1);
                rect("double: shadows to 1", blend(DstColor, One), 1);
            }
            rect("invert: shadows to 0", blend(OneMinusDstColor, Zero), 1);
            if (!halve && attenuated) rect("add 1/2: lit to 1, shadows to 1/2", blend(One, One), kHalf);
            if (!halve && !attenuated) rect("double: lit to 1", blend(DstColor, One), 1);
        }
        m_plan.threshold = attenuated ? 0.75 : 0.5;
        m_plan.maskPlace = write.alpha ? MaskPlace::Alpha : MaskPlace::Colour;
        m_plan.maskReady = m_plan.passes.size();
    }

    void copyMask() {
        const bool alpha = m_axes.store == Store::Alpha;
        const bool multiplies = m_profile.allowsBlend(Zero, SrcColor);
        m_texture = alpha ? MaskTexture::Alpha : multiplies ? MaskTexture::Rgb : MaskTexture::Intensity;
        const auto side = [&](int texels) {
            return m_profile.textureNonPowerOfTwo ? texels : int(std::bit_ceil(unsigned(texels)));
        };
        m_plan.textureWidth = side(m_plan.maskWidth);
        m_plan.textureHeight = side(m_plan.maskHeight);
        add(PassKind::Copy, fmt::format("mask of {}x{} to a texture of {}x{}", m_plan.maskWidth,
                                        m_plan.maskHeight, m_plan.textureWidth, m_plan.textureHeight))
            .texture = m_texture;
    }

    void applyTexture() {
        const Blend how = m_texture == MaskTexture::Rgb ? blend(Zero, SrcColor) : blend(Zero, SrcAlpha);
        rectangle("mask texture times the scene", how, 1, kWriteColour).texture = m_texture;
        m_plan.maskPlace = MaskPlace::Texture;
        m_plan.maskReady = m_plan.passes.size();
    }

    void ambientPass() {
        if (m_axes.shade == Shade::Ambient)
            sceneAgain("scene: add the ambient part", Shading::Ambient, blend(One, One));
    }

    Shading lighting() const { return m_axes.shade == Shade::Ambient ? Shading::Diffuse : Shading::Lit; }

    /// Lit pixels start at 2^-levels to be doubled, at 1 to be halved.
    float maskStart() const {
        return m_axes.arithmetic == Arithmetic::Double ? std::ldexp(1.0f, -m_axes.levels) : 1.0f;
    }

    Plan take() {
        const bool inColour = m_axes.store == Store::Alpha || m_axes.store == Store::Screen;
        if (inColour) m_plan.smallestMaskBits = m_axes.arithmetic == Arithmetic::Double ? m_axes.levels : 1;
        return std::move(m_plan);
    }

  private:
    const Axes& m_axes;
    const FrameShape& m_frame;
    const Profile& m_profile;
    Plan m_plan{};
    MaskTexture m_texture = MaskTexture::None;
};

}  // namespace

Plan planFrame(const Axes& axes, const FrameShape& frame, const Profile& profile) {
    Builder b(axes, frame, profile);
    const bool alphaStore = axes.store == Store::Alpha;

    if (axes.store == Store::None) {
        b.clear("background", 1, kWriteColour, true);
        b.sceneFirst(Shading::Lit);
        return b.take();
    }

    if (axes.store == Store::Stencil) {
        b.clear("background", 1, kWriteColour, true);
        b.sceneFirst(b.lighting());
        b.countInStencil();
        const bool attenuated = axes.shade == Shade::Attenuated;
        Pass& apply =
            b.rectangle(attenuated ? "attenuate where the count is not 0" : "black where the count is not 0",
                        attenuated ? blend(Zero, SrcColor) : Blend{}, attenuated ? kHalf : 0, kWriteColour);
        apply.stencil = {.enabled = true, .function = Compare::Notequal};
        b.ambientPass();
        return b.take();
    }

    if (axes.apply == Apply::Texture) {
        // Section 4.5: the mask first, at its own resolution; then the scene; then the mask over it.
        const ColourWrite mask = alphaStore ? kWriteAlpha : kWriteColour;
        b.clear("mask starts", b.maskStart(), mask, false);
        b.sceneDepth();
        b.countByBlending(mask);
        b.normalise(mask);
        b.copyMask();
        b.clear("background", 1, kWriteColour, true);
        b.sceneFirst(b.lighting());
        b.applyTexture();
        b.ambientPass();
        return b.take();
    }

    if (alphaStore) {
        b.clear("background, mask starts", b.maskStart(), kWriteAll, true);
        b.sceneFirst(b.lighting());
        b.countByBlending(kWriteAlpha);
        b.normalise(kWriteAlpha);
        b.rectangle("mask times the scene", blend(Zero, DstAlpha), 1, kWriteColour);
        b.ambientPass();
        return b.take();
    }

    b.clear("mask starts", b.maskStart(), kWriteColour, false);
    b.sceneDepth();
    b.countByBlending(kWriteColour);
    b.normalise(kWriteColour);
    b.sceneAgain("scene over the mask", b.lighting(), blend(DstColor, Zero));
    b.ambientPass();
    return b.take();
}

}  // namespace gnomon
