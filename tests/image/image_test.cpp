#include "image/image.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "image/whole_file.h"

namespace gnomon {
namespace image_test {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class ImageFile : public testing::Test {
  protected:
    ImageFile() { std::filesystem::create_directories(m_folder); }
    ~ImageFile() override { std::filesystem::remove_all(m_folder); }

    std::size_t filesInFolder() const {
        return std::size_t(std::distance(std::filesystem::directory_iterator(m_folder), {}));
    }

    std::filesystem::path m_folder =
        std::filesystem::temp_directory_path() / ("gnomon_image_test_" + std::to_string(getpid()));
};

/// Every channel takes all values, so that alpha is 0 where colours aren't.
Image ramp(int channels) {
    Image image{.width = 64, .height = 16, .channels = channels};
    for (int i = 0; i < 64 * 16 * channels; ++i) image.data.push_back(std::uint8_t(i * 7));
    return image;
}

std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

class ImageChannels : public ImageFile, public testing::WithParamInterface<int> {};

TEST_P(ImageChannels, ComeBackUnchangedFromPng) {
    const auto file = m_folder / "ramp.png";
    writeImage(file, ramp(GetParam()));
    EXPECT_EQ(readImage(file), ramp(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(OneToFour, ImageChannels, testing::Range(1, 5));

TEST_F(ImageFile, LeavesNothingElseBesideIt) {
    writeImage(m_folder / "a.png", ramp(3));
    writeImage(m_folder / "a.png", ramp(4));
    EXPECT_EQ(filesInFolder(), 1u);
    EXPECT_EQ(readImage(m_folder / "a.png").channels, 4);
}

// Made by hand: chunks IHDR, IDAT (rows 255 and 0, each of one grey pixel, not compressed) and IEND.
TEST_F(ImageFile, HasRowsFromTheTop) {
    constexpr unsigned char kFile[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x02, 0x08, 0x00, 0x00, 0x00, 0x00, 0xbc,
        0xea, 0xe9, 0xfb, 0x00, 0x00, 0x00, 0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x04,
        0x00, 0xfb, 0xff, 0x00, 0xff, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0x8d, 0x1d, 0xe5, 0x82,
        0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const auto file = m_folder / "rows.png";
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(kFile), sizeof kFile);
    EXPECT_EQ(readImage(file), (Image{.width = 1, .height = 2, .channels = 1, .data = {255, 0}}));
}

TEST_F(ImageFile, MayHaveAnyUtf8Name) {
    const auto file = m_folder / "Schattenwürfe 影.png";
    writeImage(file, ramp(3));
    EXPECT_EQ(readImage(file), ramp(3));
}

TEST_F(ImageFile, CannotBeWrittenToMissingFolder) {
    const auto file = m_folder / "missing" / "a.png";
    EXPECT_THAT(errorOf([&] { writeImage(file, ramp(3)); }), StartsWith(file.string() + ": "));
}

TEST_F(ImageFile, CannotReplaceFolderAndLeavesNothing) {
    const auto file = m_folder / "folder.png";
    std::filesystem::create_directories(file / "inside");
    EXPECT_THAT(errorOf([&] { writeImage(file, ramp(3)); }), StartsWith(file.string() + ": "));
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ImageFile, IsWrittenWhereALinkLeadsAndTheLinkStays) {
    const Image image{1, 1, 1, {7}};
    std::filesystem::create_symlink(m_folder / "far.png", m_folder / "link.png");
    writeImage(m_folder / "link.png", image);
    EXPECT_TRUE(std::filesystem::is_symlink(m_folder / "link.png"));
    EXPECT_EQ(readImage(m_folder / "far.png"), image);
    std::filesystem::create_symlink("/dev/full", m_folder / "device.png");
    EXPECT_THROW(writeImage(m_folder / "device.png", image), std::runtime_error);
    EXPECT_TRUE(std::filesystem::is_symlink(m_folder / "device.png"));
    EXPECT_THROW(tryWhole(m_folder / "device.png"), std::runtime_error);
    EXPECT_THROW(tryWhole(m_folder / "missing/image.png"), std::runtime_error);
    tryWhole(m_folder / "new.png");
    EXPECT_FALSE(std::filesystem::exists(m_folder / "new.png"));
}

TEST_F(ImageFile, OfUnknownKindIsRefused) {
    EXPECT_THAT(errorOf([&] { writeImage(m_folder / "a.jpg", ramp(3)); }), EndsWith("a.jpg: is no .png"));
    EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ImageFile, ThatIsMissingOrBrokenIsRefusedInOneLine) {
    EXPECT_THAT(errorOf([&] { readImage(m_folder / "none.png"); }), HasSubstr("none.png: "));

    const auto file = m_folder / "cut.png";
    writeImage(file, ramp(3));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    const std::string error = errorOf([&] { readImage(file); });
    EXPECT_THAT(error, StartsWith(file.string() + ": "));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

}  // namespace image_test
}  // namespace gnomon
