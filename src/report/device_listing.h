#pragma once

#include <string>
#include <vector>

#include "matrix/probe.h"
#include "report/page.h"

namespace gnomon {

/// The devices, what draws on them, whose time is taken, and which is the default; or why nothing draws.
std::string listDevices(const std::vector<DriverFacts>& devices, const Page& page);

/// What the title of a table says of the device (Cell::device): nothing of the default, else ", on EGL".
std::string deviceText(const std::string& device);

}  // namespace gnomon
