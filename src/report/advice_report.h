#pragma once

#include <string>

#include "matrix/advice.h"
#include "report/page.h"

namespace gnomon {

/// What a chip should do about one frame's shadows.
///
/// Text: methods cheapest first, with verdicts, passes and touched pixels; what is refused and why; the
/// cheapest exact method with what the next cheaper one gets wrong; what its plan leaves out and why; and its
/// passes as OpenGL calls to copy. JSON: an array of one object with all that. CSV: a line per method.
std::string showAdvice(const Advice& advice, const Page& page);

}  // namespace gnomon
