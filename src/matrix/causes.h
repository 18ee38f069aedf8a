#pragma once

#include <map>
#include <string>

#include "gl/renderer.h"
#include "matrix/judge.h"
#include "method/method.h"

namespace gnomon {

/// Why the wrong pixels of a cell are wrong, as far as that can be told without a predictor; the counts add
/// up to the wrong pixels.
///
/// "mask clamps" and "mask underflows" are shown, not guessed: the faces of each volume in front of the
/// visible surface are counted one by one, and the doubling or halving arithmetic with its limits, run over
/// the counts, is wrong in the same pixels.
///
/// @param eyeInVolume  a volume touches the near rectangle
/// @param depthBits    of the chip's depth buffer
/// @param maskBits     per channel of the mask
std::map<std::string, int> causesOf(const Judgement& judgement, const Truth& truth, const Axes& axes,
                                    const View& view, const FrameSurfaces& surfaces,
                                    const FrameVolumes& volumes, bool eyeInVolume, int depthBits,
                                    int maskBits);

}  // namespace gnomon
