#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "volume/volume.h"

namespace gnomon {

enum class Store { None, Stencil, Alpha, Screen, Counter, DepthMap };
enum class Arithmetic { Count, Double, Halve, Parity };
enum class Count { Zpass, ZpassCap, Zfail, ZpPlus, PlusPlusZp, AtomicZp };
enum class Apply { Blend, Texture };
enum class Shade { Black, Ambient, Attenuated };
enum class Start { Zero, Middle, Bias };
enum class Overflow { Either, Wrap, Saturate };
constexpr int kStores = 6, kArithmetics = 4, kCounts = 6, kApplies = 2, kShades = 3, kStarts = 3,
              kOverflows = 3, kCapFaces = 2;

/// A method as a point on orthogonal axes; the defaults are those of the table of named methods.
struct Axes {
    Store store = Store::Stencil;
    Arithmetic arithmetic = Arithmetic::Count;
    int levels = 2;  ///< nesting depth that Double resolves; 0 for other arithmetic
    gnomon::Count count = gnomon::Count::Zpass;
    Silhouette silhouette = Silhouette::Winding;
    int maskDivisor = 1;  ///< 1, 2, 4: mask scale 1, 1/2, 1/4
    Apply apply = Apply::Blend;
    Shade shade = Shade::Attenuated;
    bool automatic = false;  ///< all but the shade is chosen, for each frame and chip

    // Options of some points.
    Start start = Start::Zero;  ///< Count: 0, the middle, or (a stencil) the volumes that hold the eye
    Overflow overflow = Overflow::Either;  ///< Count in a stencil, colour or alpha
    CapFaces capFaces = CapFaces::Lit;
    Clip clip = Clip::Frustum;
    float offset = 0;   ///< Zfail: volumes start this far behind their caster, world units
    int mapSize = 0;    ///< DepthMap: texels per side; 0 for other stores
    float mapBias = 0;  ///< DepthMap: of the map's depths, 0..1
    bool operator==(const Axes&) const = default;
};
constexpr int kDefaultMapSize = 1024;
constexpr float kDefaultMapBias = 0.02f;

/// A row of the table of named methods.
struct NamedMethod {
    std::string id{};
    Axes axes{};
    std::string source{};   ///< paper and section
    std::string summary{};  ///< one line
};

/// A value of an axis that comes from a paper.
struct AxisValue {
    std::string axis{}, value{};
    std::string source{};   ///< paper and section
    std::string summary{};  ///< one line
};

/// The counting rules and the silhouettes, in the order of their axes.
const std::vector<AxisValue>& axisValues();

/// All named methods, in the order in which tables show them.
const std::vector<NamedMethod>& namedMethods();

/// The row named @p id, if there is one.
const NamedMethod* findMethod(const std::string& id);

/// The id of the named row that equals @p axes up to its shade and, for none, anything else; else the axes
/// joined by
/// "-" in the order of the design's table.
std::string methodId(const Axes& axes);

/// Why @p axes contradict each other ("halve needs a colour or alpha store"); nothing if they are a method.
std::optional<std::string> contradiction(const Axes& axes);

/// What a plan must know of one light.
struct LightShape {
    int volumes = 0;     ///< to draw
    int holdingEye = 0;  ///< that hold the eye, with their weights
    bool directional = false;

    // Of minimal plans
    bool isLeftOut = false;  ///< several lights: this one adds nothing to what is seen
    bool withoutFarCaps = false;
    /// Where its volumes matter, one rectangle for each: mask passes are bounded to them. Volumes that count
    /// up and down in turn (Double, Halve, Parity) are drawn one by one as ever.
    std::optional<MaskWindow> window{};
    /// The finished mask of a lit pixel, 0..1: the mask starts so outside of the window above, and no pass
    /// needs to make it so. Nothing: it starts and is finished as within.
    std::optional<float> finished{};
    /// To blend with that changes nothing, so that the scene is drawn unmasked there.
    bool finishedIsNeutral = false;
};

/// What a plan must know of the frame.
struct FrameShape {
    int width = 0, height = 0;         ///< window, pixels
    std::vector<LightShape> lights{};  ///< may be none
    bool withoutAmbient = false;       ///< the ambient part is black, and not added
};

/// The parts of volumes that a count draws.
Parts partsOf(Count count);

/// How volumes are cut for a plan. @p depthClamp: the chip's
CutStyle cutStyleOf(const Axes& axes, bool depthClamp);

/// The plan of one frame.
/// @pre !contradiction(axes)
///
/// The profile decides only between ways that give the same values: two-sided or two passes, counts that wrap
/// or saturate (count_step.h), inversion by logic operation or by blending, how a mask texture is applied.
/// What the chip can't do is left in the plan; ask missing().
Plan planFrame(const Axes& axes, const FrameShape& frame, const Profile& profile);

/// Axes without what means nothing to their store: levels of anything but Double, all but the shade of none.
Axes normalised(Axes axes);

/// The methods among which a chip's path is chosen, best first: stencil, alpha, screen, screen with texture.
std::vector<Axes> pathCandidates();

const std::string& name(Store);
const std::string& name(Arithmetic);
const std::string& name(Count);
const std::string& name(Silhouette);
const std::string& name(Apply);
const std::string& name(Start);
const std::string& name(Overflow);
const std::string& name(CapFaces);
const std::string& name(Clip);
const std::string& name(Shade);
std::string maskScaleName(int divisor);  ///< "1", "1/2", "1/4"

}  // namespace gnomon
