#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "volume/volume.h"

namespace gnomon {

enum class Store { None, Stencil, Alpha, Screen };
enum class Arithmetic { Count, Double, Halve };
enum class Count { Zpass, ZpassCap };
enum class Apply { Blend, Texture };
enum class Shade { Black, Ambient, Attenuated };

/// A method as a point on orthogonal axes; the defaults are those of the table of named methods.
struct Axes {
    Store store = Store::Stencil;
    Arithmetic arithmetic = Arithmetic::Count;
    int levels = 2;  ///< nesting depth that Double resolves; 0 for other arithmetic
    Count count = Count::Zpass;
    Silhouette silhouette = Silhouette::Winding;
    int maskDivisor = 1;  ///< 1, 2, 4: mask scale 1, 1/2, 1/4
    Apply apply = Apply::Blend;
    Shade shade = Shade::Attenuated;
    bool operator==(const Axes&) const = default;
};

/// A row of the table of named methods.
struct NamedMethod {
    std::string id{};
    Axes axes{};
    std::string source{};   ///< paper and section
    std::string summary{};  ///< one line
};

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

/// What a plan must know of the frame: how many volumes there are to draw.
struct FrameShape {
    int volumes = 0;
    int width = 0, height = 0;  ///< window, pixels
};

/// The plan of one frame.
/// @pre !contradiction(axes)
///
/// The profile decides only between ways that give the same values: two-sided or two passes, wrapping or
/// saturating stencil, the factor with which a mask texture is applied. What the chip can't do is left in the
/// plan; ask missing().
Plan planFrame(const Axes& axes, const FrameShape& frame, const Profile& profile);

/// The methods among which a chip's path is chosen, best first: stencil, alpha, screen, screen with texture.
std::vector<Axes> pathCandidates();

const std::string& name(Store);
const std::string& name(Arithmetic);
const std::string& name(Count);
const std::string& name(Silhouette);
const std::string& name(Apply);
const std::string& name(Shade);
std::string maskScaleName(int divisor);  ///< "1", "1/2", "1/4"

}  // namespace gnomon
