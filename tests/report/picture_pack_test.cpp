// Pictures that are packed for a report, decoded by a second reader of the format.

#include "report/picture_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/deflate.h"
#include "report/unpack.h"

namespace gnomon {
namespace picture_pack_test {

/// A picture whose bytes follow from @p seed: runs of equal bytes, and every value.
Image pictureOf(int width, int height, int channels, unsigned seed) {
    Image image{width, height, channels, {}};
    unsigned state = seed * 2654435761u + 1;
    std::uint8_t value = 0;
    for (int i = 0; i < width * height * channels; ++i) {
        state = state * 1664525u + 1013904223u;
        if (state >> 29 == 0) value = std::uint8_t(state >> 8);
        image.data.push_back(value);
    }
    return image;
}

/// @p image with a few pixels changed.
Image changed(Image image, std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) image.data[i] = std::uint8_t(image.data[i] + 17);
    return image;
}

TEST(Base64, IsAsRfc4648HasIt) {
    for (const auto& [bytes, text] : {std::pair("", ""),
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foob", "Zm9vYg=="},
                                      {"fooba", "Zm9vYmE="},
                                      {"foobar", "Zm9vYmFy"}}) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(fromBase64(text), bytes);
    }
    std::string all;
    for (int i = 0; i < 256; ++i) all += char(i);
    EXPECT_EQ(fromBase64(base64(all)), all);
    EXPECT_THROW(fromBase64("Zm 8="), std::runtime_error);
}

TEST(Deflated, IsOneRawStreamThatInflatesToTheSame) {
    std::string bytes;
    for (unsigned i = 0; i < 100000; ++i) bytes += char(i * i / 7);
    for (const std::string& text : {std::string(), std::string("a"), bytes})
        EXPECT_EQ(inflated(deflated(text), text.size()), text);
    EXPECT_EQ(deflated(bytes), deflated(bytes));
}

TEST(PicturePack, EveryPictureComesBackByteForByte) {
    PicturePack pack;
    pack.beginChunk();
    std::vector<Image> images;
    std::vector<int> indices;
    const auto add = [&](const Image& image, const std::vector<int>& like) {
        images.push_back(image);
        indices.push_back(pack.add(image, image.channels == 3 ? PictureKind::Rgb : PictureKind::Grey, like));
    };
    add(pictureOf(13, 7, 3, 1), {});
    add(pictureOf(13, 7, 1, 2), {});
    add(changed(images[0], 40, 5), {indices[0]});
    pack.beginChunk();
    add(changed(images[2], 100, 3), {indices[0], indices[2]});
    add(changed(images[3], 0, 2), {indices[2], indices[3]});
    add(pictureOf(1, 1, 1, 3), {indices[1]});
    pack.finish();
    EXPECT_EQ(pack.size(), 6);
    for (std::size_t i = 0; i < images.size(); ++i)
        EXPECT_EQ(unpacked(pack.pictures(), pack.chunks(), indices[i]), images[i]) << i;
}

// The page takes at most two steps to a picture's bytes.
TEST(PicturePack, BasesLieAtMostTwoStepsDeep) {
    PicturePack pack;
    pack.beginChunk();
    Image image = pictureOf(64, 64, 1, 5);
    std::vector<int> all;
    for (int i = 0; i < 8; ++i) {
        image = changed(image, std::size_t(i) * 100, 2);
        all.push_back(pack.add(image, PictureKind::Grey, all));
    }
    pack.finish();
    int deepest = 0;
    for (int p : all) {
        int steps = 0;
        for (; pack.pictures()[std::size_t(p)].base >= 0; ++steps) p = pack.pictures()[std::size_t(p)].base;
        deepest = std::max(deepest, steps);
    }
    EXPECT_EQ(deepest, 2);
    EXPECT_EQ(unpacked(pack.pictures(), pack.chunks(), all.back()), image);
}

TEST(PicturePack, KeepsEqualPicturesOnce) {
    PicturePack pack;
    pack.beginChunk();
    const Image image = pictureOf(8, 8, 1, 7);
    const int first = pack.add(image, PictureKind::Grey);
    EXPECT_EQ(pack.add(image, PictureKind::Grey), first);
    EXPECT_NE(pack.add(image, PictureKind::Count), first) << "the same bytes mean something else";
    pack.beginChunk();
    EXPECT_EQ(pack.add(image, PictureKind::Grey), first);
    EXPECT_NE(pack.add(pictureOf(4, 16, 1, 7), PictureKind::Grey), first) << "the same bytes in other rows";
}

TEST(PicturePack, FindsNothingEqualToWhatItHasDropped) {
    PicturePack pack;
    pack.beginChunk();
    const Image kept = pictureOf(8, 8, 1, 7), dropped = pictureOf(8, 8, 1, 8);
    const int first = pack.add(kept, PictureKind::Grey);
    const int second = pack.add(dropped, PictureKind::Grey);
    pack.dropBytes({second});
    EXPECT_EQ(pack.add(kept, PictureKind::Grey), first);
    const int again = pack.add(dropped, PictureKind::Grey, {second});
    EXPECT_NE(again, second);
    EXPECT_EQ(pack.pictures()[std::size_t(again)].base, -1);
    pack.finish();
    EXPECT_EQ(unpacked(pack.pictures(), pack.chunks(), again), dropped);
}

TEST(PicturePack, ADifferenceTakesLessThanThePicture) {
    PicturePack alone, beside;
    const Image image = pictureOf(160, 120, 3, 9), other = changed(image, 20000, 40);
    alone.beginChunk();
    alone.add(other, PictureKind::Rgb);
    alone.finish();
    beside.beginChunk();
    const int base = beside.add(image, PictureKind::Rgb);
    beside.beginChunk();
    beside.add(other, PictureKind::Rgb, {base});
    beside.finish();
    EXPECT_LT(beside.chunks()[1].deflated.size() * 10, alone.chunks()[0].deflated.size());
}

}  // namespace picture_pack_test
}  // namespace gnomon
