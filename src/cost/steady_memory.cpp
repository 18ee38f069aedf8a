#include "cost/steady_memory.h"

#include <malloc.h>

#include <climits>

namespace gnomon {

void keepFreedMemory() {
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
}

}  // namespace gnomon
