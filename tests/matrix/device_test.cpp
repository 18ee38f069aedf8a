// Cells on another device: what they say of it, and that nothing is kept from the one before.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "matrix/lab.h"
#include "matrix/probe.h"
#include "scenes.h"

namespace gnomon {
namespace device_test {

using testing::HasSubstr;

TEST(Probe, NamesTheDriverOrTheProblem) {
    for (int i = 0; i < kDevices; ++i) {
        const DriverFacts facts = probe(Device(i));
        EXPECT_EQ(facts.device, Device(i));
        const bool draws = facts.problem.empty();
        EXPECT_THAT(facts.driver, draws ? HasSubstr(", OpenGL ") : HasSubstr(""));
        EXPECT_EQ(facts.driver.empty(), !draws);
        const std::string unbuilt = std::string("this gnomon was built without ") + title(Device(i));
        EXPECT_EQ(facts.problem == unbuilt, !isBuilt(Device(i))) << facts.problem;
    }
    EXPECT_EQ(probe(defaultDevice()).problem, "");
}

TEST(LabDevice, IsTheCellsAndTheRequests) {
    for (int i = 0; i < kDevices; ++i) {
        if (!probe(Device(i)).problem.empty()) continue;
        MatrixRequest request;
        request.profiles = {chip("ideal")}, request.methods = {method("heidmann")};
        request.scenes = {shippedScene("boxes")}, request.frames = {0}, request.sizes = {{32, 24}};
        request.device = Device(i);
        EXPECT_EQ(runMatrix(request).front().device, name(Device(i)));
    }
}

TEST(LabDevice, KeepsNoResultOfAnother) {
    if (!probe(Device::Egl).problem.empty()) GTEST_SKIP() << probe(Device::Egl).problem;
    if (!isBuilt(Device::Osmesa)) GTEST_SKIP() << "one device";
    Lab lab(shippedScene("boxes"));
    const auto drawn = [&](Device device) {
        lab.drawOn(device);
        return lab.run(chip("ideal"), method("heidmann"), 32, 24, 0).device;
    };
    EXPECT_EQ(drawn(Device::Osmesa), "osmesa");
    EXPECT_EQ(drawn(Device::Egl), "egl");
    EXPECT_EQ(drawn(Device::Osmesa), "osmesa");
}

}  // namespace device_test
}  // namespace gnomon
