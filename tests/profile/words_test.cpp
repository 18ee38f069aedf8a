#include "profile/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace gnomon {
namespace words_test {

/// Each enumeration with its last word: a word added behind it without a name fails here.
template <class Word, Word last>
struct Kind {
    using Type = Word;
    static constexpr std::size_t kCount = static_cast<std::size_t>(last) + 1;
};

template <class Kind>
class Words : public testing::Test {};

using Kinds = testing::Types<Kind<BlendFactor, BlendFactor::OneMinusConstantAlpha>,
                             Kind<BlendEquation, BlendEquation::SignedReverseSubtract>,
                             Kind<Compare, Compare::Always>, Kind<StencilOp, StencilOp::DecrWrap>,
                             Kind<WriteMask, WriteMask::Channel>, Kind<FrameTexture, FrameTexture::Direct>,
                             Kind<BlendUnit, BlendUnit::Nv2a>, Kind<DitherMode, DitherMode::Ge>,
                             Kind<DepthEncoding, DepthEncoding::N64>, Kind<Evidence, Evidence::Guess>>;
TYPED_TEST_SUITE(Words, Kinds);

TYPED_TEST(Words, AreReadBackFromTheirNames) {
    using Word = typename TypeParam::Type;
    ASSERT_EQ(names<Word>().size(), TypeParam::kCount);
    std::set<std::string> spellings;
    for (std::size_t i = 0; i < TypeParam::kCount; ++i) {
        const auto word = static_cast<Word>(i);
        EXPECT_EQ(fromName<Word>(name(word)), word);
        EXPECT_TRUE(spellings.insert(name(word)).second) << name(word);
        EXPECT_THAT(name(word), testing::MatchesRegex("[a-z0-9_]+"));
    }
    EXPECT_EQ(fromName<Word>("no such word"), std::nullopt);
    EXPECT_EQ(fromName<Word>(""), std::nullopt);
}

TEST(WordNames, AreOpenGLs) {
    EXPECT_EQ(name(BlendFactor::OneMinusDstColor), "one_minus_dst_color");
    EXPECT_EQ(name(BlendFactor::SrcAlphaSaturate), "src_alpha_saturate");
    EXPECT_EQ(name(BlendFactor::OneMinusConstantAlpha), "one_minus_constant_alpha");
    EXPECT_EQ(name(BlendEquation::ReverseSubtract), "reverse_subtract");
    EXPECT_EQ(name(Compare::Lequal), "lequal");
    EXPECT_EQ(name(Compare::Gequal), "gequal");
    EXPECT_EQ(name(StencilOp::IncrWrap), "incr_wrap");
    EXPECT_EQ(name(StencilOp::Invert), "invert");
    EXPECT_EQ(name(WriteMask::Group), "group");
    EXPECT_EQ(name(FrameTexture::Host), "host");
    EXPECT_EQ(name(BlendUnit::Voodoo86Box), "voodoo_86box");
    EXPECT_EQ(name(BlendUnit::Nv3), "nv3");
    EXPECT_EQ(name(DitherMode::Matrix4x4Subtract), "4x4_subtract");
    EXPECT_EQ(name(Evidence::Recorded), "recorded");
}

TEST(ColourFormats, HaveTheBitsOfTheirNames) {
    for (const ColourFormat& format : knownColourFormats()) {
        int sum = 0;
        for (const char digit : format.name) sum += digit - '0';
        EXPECT_EQ(format.red + format.green + format.blue + format.alpha, sum) << format.name;
        EXPECT_EQ(format.alpha > 0, format.name.size() == 4) << format.name;
    }
}

}  // namespace words_test
}  // namespace gnomon
