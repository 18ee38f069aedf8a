#pragma once

#include <gmock/gmock.h>

#include <string>

#include "fault_rig.h"
#include "fault_scenes.h"
#include "scenes.h"

namespace gnomon {

inline const SetUp kCarmack{.scene = twoBoxes, .axes = method("carmack")};
inline const SetUp kCarmackInBooks{.scene = twoBooks, .axes = method("carmack")};
inline const SetUp kCarmackBeforeLight{.scene = boxesBeforeTheLight, .axes = method("carmack")};
inline const SetUp kHeidmannInSky{.scene = boxesBeforeTheSky, .axes = method("heidmann")};
inline const SetUp kHeidmann{.scene = twoBoxes, .axes = method("heidmann")};
inline const SetUp kHeidmannInSun{.scene = twoBoxesInTheSun, .axes = method("heidmann")};
inline const SetUp kHeidmannInBooks{.scene = twoBooks, .axes = method("heidmann")};
inline const SetUp kOneSided{.scene = twoBoxes, .profile = "tnt", .axes = method("heidmann")};
inline const SetUp kNearCapped{.scene = underASlab,
                               .axes = {.store = Store::Stencil, .count = gnomon::Count::ZpassCap}};
inline const SetUp kParity{.scene = twoBoxes, .axes = method("parity")};
inline const SetUp kScreen{.scene = twoBoxes, .axes = method("roettger-screen")};
inline const SetUp kScreenInBooks{
    .scene = twoBooks, .axes = method("roettger-screen"), .known = "mask clamps"};
inline const SetUp kScreenMax{.scene = twoBoxes, .axes = method("roettger-screen-max")};
inline const SetUp kScreenOfEightLevels{
    .scene = twoBoxes, .axes = {.store = Store::Screen, .arithmetic = Arithmetic::Double, .levels = 8}};
inline const SetUp kAlpha{.scene = twoBoxes, .axes = method("roettger-alpha")};

/// A set-up at the chip's own arithmetic.
inline SetUp onChip(const std::string& profile, const std::string& id, Scene (*scene)(), bool dithers = false,
                    const std::string& known = "right") {
    return {.scene = scene,
            .profile = profile,
            .axes = method(id),
            .fidelity = {.fidelity = Fidelity::Chip, .dithers = dithers},
            .known = known};
}

/// Of a number of pixels that are not predicted.
inline testing::Matcher<int> isExpected(int pixels) {
    if (pixels > 0) return testing::Eq(pixels);
    return testing::Gt(0);
}

}  // namespace gnomon
