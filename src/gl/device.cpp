#include "gl/device.h"

namespace gnomon {

const char* name(Device device) {
    return device == Device::Egl ? "egl" : "osmesa";
}

const char* title(Device device) {
    return device == Device::Egl ? "EGL" : "OSMesa";
}

bool isBuilt(Device device) {
    return device == Device::Egl ? GNOMON_EGL : GNOMON_OSMESA;
}

Device defaultDevice() {
    return isBuilt(Device::Osmesa) ? Device::Osmesa : Device::Egl;
}

}  // namespace gnomon
