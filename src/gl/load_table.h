#pragma once

#include "gl/device_context.h"
#include "gl/table.h"

namespace gnomon {

/// The entry points of the driver of @p context, which is current.
/// @throws std::runtime_error  it lacks one
GlTable loadTable(const DeviceContext& context);

}  // namespace gnomon
