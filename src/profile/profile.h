#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// The words below are OpenGL's, in lower case ("dst_color" is GL_DST_COLOR); a profile speaks them whatever
/// the chip's own registers are called.
enum class BlendFactor : std::uint8_t {
    Zero,
    One,
    SrcColor,
    OneMinusSrcColor,
    DstColor,
    OneMinusDstColor,
    SrcAlpha,
    OneMinusSrcAlpha,
    DstAlpha,
    OneMinusDstAlpha,
    SrcAlphaSaturate,
    ConstantColor,
    OneMinusConstantColor,
    ConstantAlpha,
    OneMinusConstantAlpha
};
/// The last three are not OpenGL's: AddWrap keeps the sum's low bits instead of clamping (PS2: COLCLAMP 0;
/// N64: forced blend); the signed ones add or subtract the source as two's complement, without factors
/// (NV2A).
enum class BlendEquation : std::uint8_t {
    Add,
    Subtract,
    ReverseSubtract,
    Min,
    Max,
    AddWrap,
    SignedAdd,
    SignedReverseSubtract
};
enum class Compare : std::uint8_t { Never, Less, Equal, Lequal, Greater, Notequal, Gequal, Always };
enum class StencilOp : std::uint8_t { Keep, Zero, Replace, Incr, Decr, Invert, IncrWrap, DecrWrap };

/// How finely colour writes can be masked.
enum class WriteMask : std::uint8_t {
    Fixed,    ///< all of colour and alpha, or nothing
    Group,    ///< red, green and blue together; alpha by itself
    Channel,  ///< each channel
};

/// How a frame buffer becomes a texture.
enum class FrameTexture : std::uint8_t {
    None,
    Host,    ///< read back over the bus and downloaded again
    Copy,    ///< copied by the chip
    Direct,  ///< the chip samples the frame buffer where it lies
};

/// How a chip computes a blended channel, bit for bit: blend() in blend.h has the formulas with their
/// sources.
enum class BlendUnit : std::uint8_t {
    IdealRound,
    IdealFloor,
    ProductsRound,
    ProductsFloor,
    VoodooMame,
    Voodoo86Box,
    Gs,
    GsWrap,
    PowerVr,
    Flipper,
    Rdp,
    Ge,
    Nv3,
    Virge,
    Ds,
    Psx,
    Nv2a
};

/// How a chip stores a value of 8 bits with fewer: off drops the low bits; the first four matrices are
/// 3dfx's. With "subtract", blending first adds about half a step to the destination that it reads. The
/// others are those of one chip each; N64's noise has no matrix and is left out.
enum class DitherMode : std::uint8_t {
    Off,
    Matrix4x4,
    Matrix4x4Subtract,
    Matrix2x2,
    Matrix2x2Subtract,
    Gs,  ///< PS2: a signed matrix that the program sets
    Virge,
    Psx,
    RdpMagic,  ///< N64
    RdpBayer,  ///< N64
    Ge,        ///< PSP: a signed matrix that the program sets
};

/// How a chip writes depth down; depth.h has the exact functions.
enum class DepthEncoding : std::uint8_t {
    Linear,   ///< z, in equal steps
    VoodooW,  ///< 3dfx's w-buffer: 4 bits of exponent, 12 of mantissa
    N64,      ///< 3 bits of exponent, 11 of mantissa
};

/// What stands behind a fact, best first. A source carries its grade; a fact has the best one of the sources
/// that it names, "derived" if it is computed from them, "guess" if it has none.
enum class Evidence : std::uint8_t {
    Recorded,  ///< measured on the chip, and reproduced by us
    Document,  ///< a text about the chip: a manual, an article, a table of figures
    Emulator,  ///< an emulator's code
    Driver,    ///< a driver's code
    Derived,   ///< follows from other facts
    Guess,
};

using BlendPair = std::pair<BlendFactor, BlendFactor>;  ///< source, destination

/// Red, green, blue and alpha bits of one frame-buffer format.
struct ColourFormat {
    std::string name{};  ///< "565", "1555", "8888", "888"
    int red = 0, green = 0, blue = 0, alpha = 0;
};

/// What one graphics device can do. Shadow methods ask this and nothing else about hardware.
/// Value type, read from profiles/<id>.toml; a default Profile can do nothing. Zero, false or empty means
/// absent.
struct Profile {
    std::string id{};     ///< file stem, --profile argument, report column: "voodoo1"
    std::string title{};  ///< as printed on the box
    int year = 0;

    /// One of the documents that facts name, written "KEY [grade]: document" in the file.
    struct Source {
        std::string key{};                 ///< "MAME"
        Evidence grade = Evidence::Guess;  ///< of what it says
        std::string document{};
        bool operator==(const Source&) const = default;
    };
    std::vector<Source> sources{};

    // Frame buffer
    std::vector<ColourFormat> colourFormats{};  ///< the first is the one that gnomon renders into
    int alphaBits = 0;                          ///< destination alpha
    bool alphaExcludesDepth = false;            ///< one buffer holds either destination alpha or depth
    bool blendWritesAlpha = false;              ///< the blender computes destination alpha too
    WriteMask writeMask = WriteMask::Fixed;
    bool depth = false;
    std::vector<int> depthBits{};                 ///< the first is the one that gnomon renders into
    std::vector<DepthEncoding> depthEncodings{};  ///< the first is what gnomon takes; empty: linear
    std::set<Compare> depthFunctions{};           ///< as OpenGL sees them: smaller is nearer
    std::set<Compare> alphaFunctions{};           ///< of the alpha test
    int stencilBits = 0;                          ///< 0: no stencil buffer
    bool stencilWrap = false;                     ///< GL_INCR_WRAP and GL_DECR_WRAP
    bool twoSidedStencil = false;

    // Blending. A pair is allowed if it is the product of the two sets, or listed as a pair.
    std::set<BlendFactor> sourceFactors{}, destinationFactors{};
    std::set<BlendPair> blendPairs{};
    /// Pairs that only a constant source colour (all fragments of a draw the same grey) makes possible.
    std::set<BlendPair> constantSourcePairs{};
    std::set<BlendFactor> alphaSourceFactors{}, alphaDestinationFactors{};  ///< for the alpha channel
    bool separateAlphaFactors = false;                                      ///< glBlendFuncSeparate
    std::set<BlendEquation> blendEquations{};
    bool logicOps = false;  ///< glLogicOp, all 16
    /// The chip's own arithmetic: the first is what gnomon takes, further ones where sources disagree or
    /// nobody knows. Empty: none known, and ideal rounding stands in.
    std::vector<BlendUnit> blendUnits{};
    std::vector<DitherMode> ditherModes{};  ///< the first is its driver's default; empty: never dithers

    // Textures
    int textureUnits = 0;
    int maxTextureSize = 0;    ///< texels per side
    int maxTextureAspect = 0;  ///< longest side over shortest; 0: no limit
    bool textureNonPowerOfTwo = false;
    FrameTexture frameTexture = FrameTexture::None;

    // Geometry
    bool culling = false;  ///< by the chip; otherwise the host sorts faces
    bool polygonOffsetUnits = false, polygonOffsetFactor = false;
    int clipPlanes = 0;
    bool shaders = false;           ///< programs for vertices and fragments
    bool geometryShaders = false;   ///< with adjacency
    bool atomicCounters = false;    ///< in all shaders
    bool framebufferFetch = false;  ///< a fragment program may read the pixel that it writes
    bool depthClamp = false;        ///< ARB_depth_clamp
    bool depthTextures = false;     ///< a depth buffer can become a texture

    // Limits and rates
    int maxWidth = 0, maxHeight = 0;  ///< of a 3D frame with depth, pixels; 0: no limit
    std::int64_t frameBytes = 0;      ///< memory for two colour buffers and depth; 0: no limit
    double megapixelsPerSecond = 0, megatrianglesPerSecond = 0, gigabytesPerSecond = 0;
    bool onChipFrame = false;          ///< colour and depth lie on the chip: no memory limits their traffic
    double busMegabytesPerSecond = 0;  ///< between chip and host, one way at a time; FrameTexture::Host

    /// One fact of the file as written, for people.
    struct Fact {
        std::string key{}, value{};  ///< a list's words are joined by ", "; an empty list is "none"
        /// "unsourced", or where the figure comes from: "KEY place; KEY place", "derived: KEY place"; "; also
        /// ..." where sources disagree.
        std::string source{};
        Evidence grade = Evidence::Guess;
    };
    std::vector<Fact> facts{};  ///< in the order of the file

    /// The source of the fact @p key, a key of the file such as "alpha_bits"; "unsourced" if it has none,
    /// "not in the profile" if the key is absent there.
    std::string sourceOf(const std::string& key) const;

    /// The grade of the fact @p key; a guess if the key is absent.
    Evidence gradeOf(const std::string& key) const;

    /// The first of blendUnits, or ideal rounding.
    BlendUnit blendUnit() const;

    bool allowsBlend(BlendFactor source, BlendFactor destination) const;
    /// As allowsBlend, for a draw whose fragments all have the same grey.
    bool allowsBlendWithConstantSource(BlendFactor source, BlendFactor destination) const;
};

/// A profile that can't be used. what() is one line, "file:line: what", or "file: what" if it can't be read.
struct ProfileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a profile: "title", "year", "sources", and one key per capability, spelt as the field but in
/// snake_case. A capability is a plain value, or { value = ..., source = "KEY place; KEY place", also = "what
/// another source says", grade = "guess" }; one that is left out is absent, and so is an empty list with a
/// source. A source that begins with "derived" is computed from the others that it names. "grade" stands for
/// the grade of the sources, where their kind doesn't say how good the fact is.
/// @throws ProfileError for a syntax error, an unknown key or word, a wrong type, a number out of range, a
/// source
///                      that isn't in the list, an impossible combination (check.h)
Profile loadProfile(const std::filesystem::path& file);

/// Ids of all profiles in @p folder, sorted.
/// @throws ProfileError if it isn't a folder
std::vector<std::string> profileIds(const std::filesystem::path& folder);

/// Spellings of the words in profiles, plans and messages: "dst_color", "lequal", "reverse_subtract",
/// "incr_wrap".
const std::string& name(BlendFactor);
const std::string& name(BlendEquation);
const std::string& name(Compare);
const std::string& name(StencilOp);
const std::string& name(WriteMask);
const std::string& name(FrameTexture);
const std::string& name(BlendUnit);      ///< "voodoo_mame"
const std::string& name(DitherMode);     ///< "off", "4x4", "4x4_subtract", "2x2", "2x2_subtract"
const std::string& name(DepthEncoding);  ///< "linear", "voodoo_w", "n64"
const std::string& name(Evidence);       ///< "recorded"

}  // namespace gnomon
