// What a mask of half the size saves: frames of roettger-screen beside frames of roettger-half, whole and
// warm.
#include <memory>

#include "bench/speed/easel.h"
#include "bench/speed/speed_row.h"

namespace gnomon {
namespace {

Round halfMask(Load load) {
    const int side = load == Load::Full ? 1024 : 32;
    const auto easel = std::make_shared<Easel>(shippedScene("roettger"), side, side);
    const Plan full = easel->plan("roettger-screen"), half = easel->plan("roettger-half");
    return [=] {
        Measured times{.ours = easel->frameMs(half), .beside = easel->frameMs(full)};
        times.figure = times.beside / times.ours;
        return times;
    };
}

}  // namespace

std::vector<SpeedRow> halfRows() {
    return {{.name = "HalfMask/roettger",
             .what = "full mask over half mask, 1024x1024 (paper: 1.54)",
             .bar = Bar::AtLeast,
             .target = 1.5,
             .unit = "x",
             .sides = "ms",
             .prepare = halfMask}};
}

}  // namespace gnomon
