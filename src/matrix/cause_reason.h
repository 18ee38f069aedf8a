#pragma once

#include <string>

#include "predict/causes.h"

namespace gnomon {

/// Why a cause makes pixels wrong, a few words; "" for None and Unexplained, which have no reason.
const std::string& reasonOf(Cause cause);

}  // namespace gnomon
