// The devices as text, and in titles.

#include "report/device_listing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace device_listing_test {

using testing::HasSubstr;

TEST(DeviceListing, SaysWhatDrawsAndWhoseTimeIsTakenOrWhyNothingDraws) {
    const DriverFacts gpu{.device = Device::Egl, .driver = "GeForce, OpenGL 4.6", .clock = DrawClock::Gpu};
    const std::string text = listDevices({gpu}, Format::Text);
    EXPECT_THAT(text, HasSubstr("gpu    GeForce, OpenGL 4.6"));
    const std::string none =
        listDevices({{.device = Device::Egl, .problem = "this gnomon was built without EGL"}}, Format::Text);
    EXPECT_THAT(none, HasSubstr("-      none: this gnomon was built without EGL"));
}

TEST(DeviceListing, MarksTheDefault) {
    for (int i = 0; i < kDevices; ++i) {
        const std::string text = listDevices({{.device = Device(i)}}, Format::Csv);
        EXPECT_THAT(text, HasSubstr(Device(i) == defaultDevice() ? ",yes," : ",no,"));
    }
}

TEST(DeviceText, IsNothingForTheDefault) {
    for (int i = 0; i < kDevices; ++i) {
        const std::string expected =
            Device(i) == defaultDevice() ? "" : std::string(", on ") + title(Device(i));
        EXPECT_EQ(deviceText(name(Device(i))), expected);
    }
}

}  // namespace device_listing_test
}  // namespace gnomon
