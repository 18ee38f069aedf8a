#pragma once

#include <functional>
#include <optional>
#include <string>

#include "method/method.h"

namespace gnomon {

/// One half as hardware of the time wants it: 127 loses white (hardware.md, 4.1).
constexpr float kHalf = 128.0f / 255;

inline Blend blending(BlendFactor source, BlendFactor destination) {
    return {.enabled = true, .source = source, .destination = destination};
}

/// Builds the passes of one frame; planFrame() says in which order.
class PlanBuilder {
  public:
    PlanBuilder(const Axes& axes, const FrameShape& frame, const Profile& profile);

    const Axes& axes;

    struct Clearing {
        std::string label{};
        ColourWrite write = kWriteColour;
        bool background = false;  ///< red, green and blue to the background instead of the value
        float value = 1;
        bool depth = false, stencil = false;
        int light = 0;  ///< whose count starts
    };
    void clear(const Clearing& what);
    /// The same where a mask starts in @p channels, which may be some of those that are written: in a window
    /// of its own the mask starts there, and is finished elsewhere.
    void startMask(Clearing what, ColourWrite channels);

    void sceneDepth();
    void sceneFirst(Shading shading, int light = 0);
    /// The scene again, over the depth that it left behind.
    Pass& sceneAgain(const std::string& label, int light, Shading shading, const Blend& how);
    Pass& rectangle(const std::string& label, const Blend& how, float value, ColourWrite write);

    // The mask of a light, by store. Each ends with a tap.
    void countInStencil(int light);
    /// Bounds the pass that was added last to where the light's volumes matter.
    void boundLast(int light);
    /// Whether any volume of the light may matter.
    bool canShadow(int light) const;
    /// Whether what the light's mask does not shadow can be drawn without it.
    bool isNeutralOutside(int light) const;
    bool hasAmbient() const { return !m_frame.withoutAmbient; }
    bool isLeftOut(int light) const { return m_frame.lights[std::size_t(light)].isLeftOut; }
    void countInCounter(int light);
    void countByBlending(int light, ColourWrite write);
    void drawDepthMap(int light);
    void maskFromDepthMap(int light, bool isFirst = true);

    /// Roettger et al. 2002, sections 4.3 and 4.4: the mask's values become one for a lit pixel and one for a
    /// shadow. Counts that an alpha test tells apart are left as they are.
    void normalise(int light, ColourWrite write);

    /// The mask of @p light is finished.
    void tap(int light, MaskPlace place);
    /// The mask that was tapped last is drawn nowhere outside of the light's window.
    void finishOutside(int light);

    /// The stencil test that shadows pass.
    Stencil shadowTest() const;
    /// Lit pixels start at 2^-levels to be doubled, at 1 to be halved or inverted, at 0 or the middle to be
    /// counted.
    float maskStart() const;

    void copyMask();
    void applyTexture(int light);
    void keepFrame();
    void addFrameSoFar();

    Plan take();

  private:
    Pass& add(PassKind kind, std::string label);
    const LightShape& shape(int light) const { return m_frame.lights[std::size_t(light)]; }
    /// The faces between the near plane and infinity.
    Parts open(int light) const;
    Pass& volume(int light, int index, Faces faces, Parts parts, Compare function, const std::string& what);
    void countParity(int light);
    void countByInversion(int light, ColourWrite write);
    void countBySteps(int light, ColourWrite write);
    glm::vec4 countColour(bool up) const;
    const ColourFormat& format() const;
    void countZfailByBlending(int light, int index, ColourWrite write);
    /// Draws a rectangle over the mask: a label, how it blends, its grey.
    using MaskRectangle = std::function<void(const std::string&, const Blend&, float)>;
    void normaliseCount(const MaskRectangle& rect, ColourWrite write);

    /// The chip passes all fragments or the nearer ones, but no farther ones.
    bool passesNearerOnly() const;
    /// How a texture of counts darkens the scene where its alpha test passes; nothing if the chip can't.
    std::optional<Blend> shadowBlend() const;
    /// The alpha test that a shadow in a texture of counts passes; off where the mask is normalised instead.
    AlphaTest shadowAlpha() const;

    int textureSide(int texels) const;

    const FrameShape& m_frame;
    const Profile& m_profile;
    Plan m_plan{};
    MaskTexture m_texture = MaskTexture::None;
};

}  // namespace gnomon
