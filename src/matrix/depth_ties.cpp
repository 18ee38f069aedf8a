#include "matrix/depth_ties.h"

#include <cmath>

namespace gnomon {

DepthTies tiesOf(int bits, DepthEncoding encoding) {
    const double interpolation = depthTies(24).countBand;
    switch (encoding) {
        case DepthEncoding::Linear:
            break;
        case DepthEncoding::VoodooW:  // 13 bits of near / w, the leading one among them
            return {std::ldexp(1.0, -28), interpolation, std::ldexp(1.0, -12)};
        case DepthEncoding::N64:  // 18 bits at most; 11 of what is left to 1, the leading ones taken off
            return {std::ldexp(1.0, -18), std::ldexp(1.0, -18) + interpolation, std::ldexp(1.0, -11)};
    }
    return depthTies(bits);
}

}  // namespace gnomon
