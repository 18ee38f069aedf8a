// What two runs must have in common, and how a difference is told.

#include "matrix/run_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace gnomon {
namespace run_settings_test {

using testing::HasSubstr;

const RunMaker kMaker{"1.2.3", "g++ 12", "llvmpipe", "a processor", 5};

MatrixRequest smallRequest() {
    MatrixRequest request;
    request.profiles = {chip("voodoo2"), chip("ideal")};
    request.methods = {method("carmack"), method("none")};
    request.scenes = {shippedScene("boxes")};
    request.sizes = {{48, 32}};
    request.frames = {0};
    return request;
}

/// How a request differs from smallRequest() that @p change was done to.
std::string differenceBy(const std::function<void(MatrixRequest&, RunMaker&)>& change) {
    MatrixRequest request = smallRequest();
    RunMaker maker = kMaker;
    change(request, maker);
    return differenceOf(settingsOf(smallRequest(), kMaker), settingsOf(request, maker));
}

TEST(RunSettings, OfTheSameRequestAreTheSame) {
    EXPECT_EQ(differenceBy([](MatrixRequest&, RunMaker&) {}), "");
}

// The number of workers and the processor decide of no result.
TEST(RunSettings, LeaveOutWhatDoesNotMatter) {
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker& m) { r.jobs = 7, m.processor = "another"; }), "");
}

TEST(RunSettings, NameWhatDiffers) {
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.profiles.back() = chip("tnt"); }),
              "profiles: with tnt, without ideal");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { std::swap(r.profiles[0], r.profiles[1]); }),
              "profiles: in another order");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) {
                  r.sizes = {{64, 48}};
              }),
              "sizes: 64x48, there 48x32");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.methods[0].offset = 0.5f; }),
              "methods: with stencil-count-zfail-winding-1-blend-offset-0.5, without carmack");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.methods[0].shade = Shade::Black; }),
              "methods: with carmack shade black, without carmack");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.limits.seconds = 1; }),
              "timeout: 1 s, there 900 s");
    EXPECT_EQ(differenceBy([](MatrixRequest&, RunMaker& m) { m.version = "2"; }), "version: 2, there 1.2.3");
    EXPECT_EQ(differenceBy([](MatrixRequest&, RunMaker& m) { m.driver = "softpipe"; }),
              "OpenGL: softpipe, there llvmpipe");
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.view["eye"] = "1,2,3"; }),
              "view: --eye 1,2,3, there none");
    EXPECT_THAT(differenceBy([](MatrixRequest& r, RunMaker&) {
                    r.shard = {2, 4};
                }),
                HasSubstr("shard: 2/4, there 1/1"));
}

TEST(RunSettings, CutLongLists) {
    EXPECT_EQ(differenceBy([](MatrixRequest& r, RunMaker&) { r.frames = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}; }),
              "frames: 0,1,2,3,4,5,6,7,8,9, there 0; cells: 40, there 4");
    MatrixRequest many = smallRequest();
    for (int i = 0; i < 9; ++i) many.methods.push_back(namedMethods()[std::size_t(3 + i)].axes);
    EXPECT_THAT(differenceOf(settingsOf(smallRequest(), kMaker), settingsOf(many, kMaker)),
                HasSubstr(" and 3 more; cells: 22, there 4"));
}

TEST(ShardWord, IsReadAsItIsWritten) {
    EXPECT_EQ(shardFrom(toText(Shard{3, 8})), (Shard{3, 8}));
    for (const char* bad :
         {"", "1", "/", "0/4", "5/4", "-1/4", "1/0", "1/", "/4", "1/4x", "a/b", "1/99999999999"})
        EXPECT_EQ(shardFrom(bad).count, 0) << bad;
}

}  // namespace run_settings_test
}  // namespace gnomon
