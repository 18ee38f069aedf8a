#pragma once

#include <map>
#include <string>

#include "gl/renderer.h"
#include "matrix/judge.h"
#include "method/count_step.h"

namespace gnomon {

/// What a light's mask was drawn from.
struct CauseInputs {
    const Judgement& judgement;
    const Truth& truth;
    const Axes& axes;
    const View& view;
    const FrameSurfaces& surfaces;
    const FrameVolumes& volumes;  ///< with the parts that the method draws
    bool eyeInVolume = false;     ///< a volume touches the near rectangle
    bool eyeOnFace = false;       ///< the eye lies exactly on a face of a volume
    int depthBits = 24;
    int maskBits = 8;    ///< per channel of the mask
    CountRange range{};  ///< of a count in stencil, colour or alpha
    /// The same mask by OpenGL's arithmetic, where this one is by the chip's own.
    const std::vector<bool>* byOpenGl = nullptr;
    bool dithers = false;  ///< the chip's stores
};

/// Why the wrong pixels of one light's mask are wrong, as far as that can be told without a predictor; the
/// counts add up to the wrong pixels.
///
/// "mask clamps", "mask wraps", "mask underflows" (of a stencil: "stencil saturates", "stencil wraps") and
/// "parity of overlapping volumes" are shown, not guessed: the faces of each volume are counted one by one,
/// and the arithmetic with its limits, run over the counts, is wrong in the same pixels. "rounding residue"
/// and "dither drift" are pixels that none of them explains, and that OpenGL's arithmetic gets right.
std::map<std::string, int> causesOf(const CauseInputs& in);

}  // namespace gnomon
