#include "cost/touched.h"

namespace gnomon {

TouchedPixels& operator+=(TouchedPixels& a, const TouchedPixels& b) {
    a.clear += b.clear, a.scene += b.scene, a.volume += b.volume, a.rectangle += b.rectangle,
        a.copy += b.copy;
    return a;
}

}  // namespace gnomon
