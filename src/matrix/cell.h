#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cost/touched.h"
#include "method/method.h"
#include "needs/effects.h"
#include "plan/plan.h"
#include "volume/nesting.h"

namespace gnomon {

enum class Verdict {
    Exact,    ///< every untied pixel is as truth says
    Edge,     ///< wrong pixels, all within one mask pixel of the true boundary of a shadow
    Wrong,    ///< a leak or a hole: wrong pixels away from the boundary
    Refused,  ///< the chip lacks what the plan needs
    Failed,   ///< crash, time-out, OpenGL error: a fault of ours or of the driver
};
constexpr int kVerdicts = 5;

/// How sure it is that a chosen method is exact.
enum class Proof {
    Predicted,  ///< exact arithmetic has every untied pixel as truth has it
    Drawn,      ///< it was drawn, and is exact: a shadow map, of which exact arithmetic promises nothing
    None,       ///< no method is exact; this one is wrong in the fewest pixels
    Refused,    ///< the chip can run no method
};
constexpr int kProofs = 4;

/// One cell of the matrix: a profile, a method, a scene, a size, a frame, and what came of it.
struct Cell {
    std::string profile{}, method{}, scene{};
    Axes axes{};
    int width = 0, height = 0, frame = 0;
    int lights = 1;
    std::string fidelity = "gl";
    bool dithers = false;           ///< FidelityChoice::dithers
    std::string blendUnit{};        ///< FidelityChoice::unit, by name; "" where none was chosen
    std::string device = "osmesa";  ///< gl/device.h
    /// Where the user placed light and camera: flags of the command line without their hyphens, and their
    /// values; empty where the scene's own stand.
    std::map<std::string, std::string> view{};
    Effects effects = Effects::all();  ///< simulated besides what the frame calls for
    std::string drawnBy{};             ///< the named method that an automatic one has chosen; else empty
    Proof proof = Proof::Predicted;    ///< of that choice

    Verdict verdict = Verdict::Failed;
    bool chosen = false;                  ///< the path that gnomon takes on this chip when no method is named
    std::vector<Missing> missing{};       ///< Refused: what is lacking
    std::string error{};                  ///< Failed: one line
    std::map<std::string, int> causes{};  ///< wrong pixels by cause

    PassCounts passes{};  ///< as the capability layer counted them; of a refused cell, the plan's length
    int pixels = 0;
    int tiedTruth = 0, tiedCount = 0;
    int wrongEdge = 0, wrongInterior = 0;
    int unpredicted = 0;                 ///< untied pixels whose mask is not what the predictor says
    TouchedPixels touched{};             ///< in all passes
    long vertices = 0;                   ///< drawn in all passes
    double cpuMs = 0, unshadowedMs = 0;  ///< time of the frame, and of the same without shadows
    std::string clock = "thread";        ///< whose time these are: DrawClock
    std::string digest{};                ///< over mask and image, 16 hexadecimal digits

    Nesting nesting{};                    ///< bounds for the method's mask; of several lights the largest
    std::vector<std::string> warnings{};  ///< where the bounds pass the method's capacity on this chip

    std::string id() const;  ///< "voodoo2/roettger-screen/roettger/512x512/0"

    /// The id with what else is asked for and stands in no id: shade, arithmetic, effects, view. Two cells of
    /// one run differ in it; the same question put to two runs has the same.
    std::string question() const;
};

const std::string& name(Verdict);
const std::string& name(Proof);

}  // namespace gnomon
