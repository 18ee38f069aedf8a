#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "profile/profile.h"
#include "volume/volume_cut.h"

namespace gnomon {

/// What a pass draws; also what it counts as in the papers' tables.
enum class PassKind {
    Clear,      ///< the buffers; counts as nothing
    Scene,      ///< all surfaces of the scene
    Volume,     ///< faces of one shadow volume, or of all; or casters, to count what hides the eye
    Rectangle,  ///< a rectangle over the whole window
    Copy,       ///< frame buffer to texture
};

/// How the surfaces of a scene pass are coloured. Each is a colour per vertex, computed on the host.
enum class Shading {
    None,     ///< depth only: no colour is written
    Lit,      ///< ambient and diffuse, as without shadows
    Diffuse,  ///< the light's part alone: black where the seen side faces away
    Ambient,  ///< the part that needs no light
    Black,
    HalfDiffuse,  ///< half of Diffuse, rounded down
    RestDiffuse,  ///< what that leaves of Diffuse
    Mask,         ///< no colour of its own: white where the depth map shows no caster before it
};

enum class Faces { Front, Back, Both };

/// What a volume pass draws.
enum class Drawn {
    Volumes,     ///< the parts of volumes, cut by the host
    Blockers,    ///< the casters' lit triangles between light and eye, onto one pixel: a view of 1x1 pixels
    Silhouettes  ///< volumes that a geometry shader makes of the casters' edges
};

/// Fragment programs, on chips that have them.
enum class Program {
    None,
    CountFaces,  ///< 16 bits of red and green: plus or minus 1, by the facing; wraps
    ShadeCount,  ///< multiplies the source colour by 1 where that count is 0, else by the shadow's share
};

/// The buffer that a pass draws to.
enum class Target {
    Window,
    Mask,      ///< the window's lower left corner, as large as the mask
    DepthMap,  ///< one face of the light's depth map
    OnePixel,  ///< the window's first pixel
};

/// Texture formats into which a mask is copied.
enum class MaskTexture {
    None,
    Rgb,        ///< colour mask, applied as a colour
    Intensity,  ///< colour mask whose red channel is also the alpha with which it is applied
    Alpha,      ///< alpha mask
};

/// A rectangle of pixels of a pass's target, from the lower left corner, as OpenGL counts them.
struct WindowRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool empty() const { return width <= 0 || height <= 0; }
    bool holds(int px, int py) const { return px >= x && px < x + width && py >= y && py < y + height; }
    bool operator==(const WindowRect&) const = default;
};

/// The smallest rectangle that holds both; an empty one holds nothing.
WindowRect around(const WindowRect& a, const WindowRect& b);

/// Where a light's volumes can matter: pixels of the mask.
struct MaskWindow {
    WindowRect all{};                   ///< around() those of the volumes
    std::vector<WindowRect> volumes{};  ///< of each of the light's volumes that the plan draws
    bool operator==(const MaskWindow&) const = default;
};

/// The part of its target that a pass may change: the rest is kept by a scissor.
enum class Extent {
    Whole,    ///< all; no scissor
    Shadows,  ///< MaskWindow::all of the pass's light
    Volumes,  ///< MaskWindow::volumes of each volume that the pass draws
};

/// The state of the blender in one pass; off by default.
struct Blend {
    bool enabled = false;
    BlendFactor source = BlendFactor::One, destination = BlendFactor::Zero;
    BlendEquation equation = BlendEquation::Add;
    float constant = 0;  ///< of the factors that are a constant; grey, 0..1
    bool operator==(const Blend&) const = default;
};

/// The alpha test of one pass; off by default. A fragment whose alpha fails it changes nothing.
struct AlphaTest {
    bool enabled = false;
    Compare function = Compare::Always;
    float reference = 0;  ///< 0..1
    bool operator==(const AlphaTest&) const = default;
};

/// The stencil operations for one side of faces. A fragment that fails the stencil test changes nothing.
struct StencilSide {
    StencilOp onDepthFail = StencilOp::Keep, onPass = StencilOp::Keep;
    bool operator==(const StencilSide&) const = default;
};

/// The stencil test of one pass; off by default.
struct Stencil {
    bool enabled = false;
    Compare function = Compare::Always;
    int reference = 0;
    unsigned readMask = ~0u, writeMask = ~0u;
    StencilSide front{}, back{};  ///< equal unless the chip has two-sided stencil
    bool minusBlockers = false;   ///< what hides the eye, once counted, is subtracted from the reference
    bool operator==(const Stencil&) const = default;
};

/// Channels that a pass writes.
struct ColourWrite {
    bool red = true, green = true, blue = true, alpha = false;
    bool any() const { return red || green || blue || alpha; }
    bool operator==(const ColourWrite&) const = default;
};
constexpr ColourWrite kWriteNothing{false, false, false, false};
constexpr ColourWrite kWriteColour{true, true, true, false};
constexpr ColourWrite kWriteAlpha{false, false, false, true};
constexpr ColourWrite kWriteAll{true, true, true, true};

constexpr int kAllVolumes = -1;

/// One pass as a plain value: what geometry, into which channels, under which state.
struct Pass {
    PassKind kind = PassKind::Clear;
    std::string label{};  ///< what it does to the mask or the picture, for people

    // Geometry
    int light = 0;                    ///< index into the frame's lights
    Shading shading = Shading::None;  ///< Scene
    Drawn drawn = Drawn::Volumes;     ///< Volume
    Parts parts{};                    ///< Volume: of Drawn::Volumes
    bool countsBlockers = false;      ///< Volume: Drawn::Silhouettes count what hides the eye, atomically
    int volume = kAllVolumes;         ///< Volume: index into the frame's volumes
    Faces faces = Faces::Both;        ///< Volume: the rest is culled
    glm::vec4 colour{1};  ///< constant source colour of volumes and rectangles; the value of a clear

    // State
    bool clearsDepth = false, clearsStencil = false;  ///< Clear
    int stencilValue = 0;                             ///< Clear: what the stencil is cleared to
    bool stencilIsBlockers = false;                   ///< Clear: to what hides the eye, as counted, instead
    bool clearsToBackground = false;  ///< Clear: red, green and blue are the scene's background
    bool blackBackdrop = false;       ///< Scene over a mask: what lies at infinity is black
    bool depthTest = false, depthWrite = false;
    Compare depthFunction = Compare::Less;
    bool depthClamp = false;  ///< what lies before the near plane is drawn at depth 0
    ColourWrite write = kWriteColour;
    Blend blend{};
    bool logicInvert = false;  ///< written channels are inverted by a logic operation, instead of blending
    AlphaTest alphaTest{};
    Stencil stencil{};
    MaskTexture texture =
        MaskTexture::None;      ///< Copy: the format to copy into; Rectangle: the mask is mapped onto it
    bool nearest = false;       ///< Copy: the texture is not filtered when it is sampled
    bool frameTexture = false;  ///< Copy, Rectangle: the frame so far instead of the mask
    Target target = Target::Window;
    Extent extent = Extent::Whole;
    int mapFace = 0;  ///< Target::DepthMap: 0 for a directional light, 0 to 5 for a point light
    Program program = Program::None;
    int frontCount = 1;  ///< CountFaces: what a front face adds; a back face subtracts it
};

/// Where a finished mask can be read, and how.
enum class MaskPlace { None, Stencil, Colour, Alpha, Texture, Counter };

/// Where the finished mask of a light stands, and when.
struct MaskTap {
    std::size_t after = 0;  ///< this many passes
    int light = 0;
    MaskPlace place = MaskPlace::None;
    Stencil test{};         ///< Stencil: the test that a shadow passes
    AlphaTest alphaTest{};  ///< Texture of counts: the same; off where the threshold tells
    /// What stands for pixels outside of the light's MaskWindow::all, where the plan draws no mask: a value
    /// as it is read, of a lit pixel. -1: the mask is drawn everywhere.
    int outside = -1;
};

/// The list of passes that draw one frame with one method, and what is needed to judge it. A value: nothing
/// here is tied to OpenGL, to a scene, or to a chip beyond the choices that were made for it.
struct Plan {
    std::vector<Pass> passes{};
    int width = 0, height = 0;                          ///< window, pixels
    int maskWidth = 0, maskHeight = 0;                  ///< viewport of the mask, pixels
    int textureWidth = 0, textureHeight = 0;            ///< of the mask's texture, texels; 0 without one
    int frameTextureWidth = 0, frameTextureHeight = 0;  ///< of the frame so far, texels; 0 without one
    int mapSize = 0;                                    ///< texels per side of a depth map; 0 without one
    float mapBias = 0;                                  ///< of its depths, 0..1
    Clip clip = Clip::Frustum;                          ///< of Drawn::Silhouettes

    /// By light; empty where no pass is bounded.
    std::vector<MaskWindow> windows{};

    std::vector<MaskTap> masks{};  ///< one per light, in the order in which they stand
    /// A mask value below this is a shadow, in 0..1: half way between the values of a finished mask.
    double threshold = 0.5;
    double shadowShare = 0;  ///< ShadeCount and Shading::Mask: of the light that a shadow keeps

    /// Where masks stand; None without any.
    MaskPlace maskPlace() const { return masks.empty() ? MaskPlace::None : masks.front().place; }

    int smallestMaskBits = 0;  ///< bits per channel that the arithmetic needs; 0: any
};

/// Passes by kind, as the papers count them; clears count as nothing.
struct PassCounts {
    int scene = 0, volume = 0, rectangle = 0, copy = 0;
    bool operator==(const PassCounts&) const = default;
};

PassCounts countPasses(const Plan& plan);

/// A capability that a plan needs and a chip lacks.
struct Missing {
    std::string key{};     ///< the profile's key: "stencil_bits"
    std::string what{};    ///< one phrase: "destination alpha beside depth"
    std::string source{};  ///< the profile's source for the limit
    bool operator==(const Missing&) const = default;
};

/// What @p profile lacks for @p plan, each once, in the order in which the plan runs into it; empty if it can
/// run.
std::vector<Missing> missing(const Profile& profile, const Plan& plan);

/// Of one pixel of the buffers that gnomon renders into on a chip, in words of 1, 2 or 4 bytes.
struct PixelBytes {
    int colour = 0;
    int depth = 0;  ///< 24 bits share a 32-bit word with the stencil; 0: no depth buffer
    bool operator==(const PixelBytes&) const = default;
};
PixelBytes pixelBytes(const Profile& profile);

/// The bytes of a frame of this size on the chip: two colour buffers and one of depth.
std::int64_t frameBytes(const Profile& profile, int width, int height);

/// Whether a value of the finished mask at @p tap is a shadow: a stencil value, a count of 16 bits, or 8 bits
/// of colour or alpha (which need not be whole for a prediction).
/// @param reference  of a stencil: the value of what is lit
bool isShadow(const Plan& plan, const MaskTap& tap, double value, int reference);

/// One line in OpenGL's terms: "scissor 12,40 96x64, depth LEQUAL, blend DST_COLOR ONE, colour 1, write RGB".
///
/// @param windows  the plan's; without them a scissor is said to be there, but not where
std::string describeState(const Pass& pass, std::span<const MaskWindow> windows = {});

/// The part of its target that @p pass may change; of Extent::Volumes over many volumes the part around all
/// of theirs. Nothing for a pass that is not bounded: a whole one, and any copy.
///
/// @param windows  of the pass's plan
std::optional<WindowRect> scissorOf(const Pass& pass, std::span<const MaskWindow> windows);

/// Whether a scene pass draws what lies at infinity too, over the whole window: wherever it meets a mask that
/// stands in the colour buffer.
bool drawsBackdrop(const Pass& pass);

/// Whether @p value passes a test of @p function against @p reference.
bool passes(Compare function, float value, float reference);

}  // namespace gnomon
