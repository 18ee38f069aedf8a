// Blend units against second forms of their formulas, over all values.

#include "profile/blend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "profile/words.h"

namespace gnomon {
namespace {

using testing::Optional;
using enum BlendUnit;

std::vector<BlendUnit> unitsThat(bool (*predicate)(BlendUnit)) {
    std::vector<BlendUnit> units;
    for (std::size_t i = 0; i < names<BlendUnit>().size(); ++i)
        if (predicate(static_cast<BlendUnit>(i))) units.push_back(static_cast<BlendUnit>(i));
    return units;
}

bool takesAnyFactor(BlendUnit unit) {
    return blend(unit, {.sourceWeight = Weight::of(1), .destinationWeight = Weight::of(2)}).has_value();
}

/// Exact products and sums as fractions of 255, from real numbers that binary floating point holds exactly
/// (n / 255 never is one, so n is compared, not the quotient).
struct Fraction {
    int numerator;  ///< over 255
    int down() const { return static_cast<int>(std::floor(numerator / 255.0)); }
    /// No tie can occur: 255 is odd.
    int nearest() const { return static_cast<int>(std::floor(numerator / 255.0 + 0.5)); }
};

int clamp(int value) {
    return value < 0 ? 0 : value > 255 ? 255 : value;
}

/// What each unit with free factors makes of S f + D g for values f, g: a second form of its formula.
int secondForm(BlendUnit unit, int s, int d, int f, int g) {
    // 255 becomes 256 and 128..254 get one more.
    const auto widened = [](int v) { return v < 128 ? v : v + 1; };
    const auto psp = [](int c, int v) { return static_cast<int>(std::floor((c + 0.5) * (v + 0.5) / 256)); };
    switch (unit) {
        case IdealRound:
        case Nv2a:
            return clamp(Fraction{s * f + d * g}.nearest());
        case IdealFloor:
            return clamp(Fraction{s * f + d * g}.down());
        case ProductsRound:
            return clamp(Fraction{s * f}.nearest() + Fraction{d * g}.nearest());
        case ProductsFloor:
        case Voodoo86Box:
            return clamp(Fraction{s * f}.down() + Fraction{d * g}.down());
        case VoodooMame:
            return clamp((s * f + d * g + s + d) / 256);
        case PowerVr:
        case Flipper:
            return clamp((s * widened(f) + d * widened(g)) / 256);
        case Ge:
            return clamp(psp(s, f) + psp(d, g));
        default:
            ADD_FAILURE() << name(unit);
            return 0;
    }
}

class EachFreeUnit : public testing::TestWithParam<BlendUnit> {};

// All pairs of one input and its factor, with the other input at values around every power of two: sums of
// all sizes, and both roundings of each.
TEST_P(EachFreeUnit, AgreesWithItsSecondForm) {
    const BlendUnit unit = GetParam();
    for (const int d : {0, 1, 127, 128, 255})
        for (const int g : {0, 77, 128, 255})
            for (int s = 0; s <= 255; ++s)
                for (int f = 0; f <= 255; ++f) {
                    const auto value = blend(unit, {s, d, Weight::of(f), Weight::of(g), BlendOperation::Add});
                    ASSERT_THAT(value, Optional(secondForm(unit, s, d, f, g)))
                        << s << " * " << f << " + " << d << " * " << g;
                }
}

// Over all 256 x 256 inputs: one factor is a value, the other its complement, as alpha blending has it.
TEST_P(EachFreeUnit, ComplementIsTheValueOfTheRest) {
    const BlendUnit unit = GetParam();
    for (const int alpha : {0, 1, 77, 127, 128, 255})
        for (int s = 0; s <= 255; ++s)
            for (int d = 0; d <= 255; ++d) {
                const auto value = blend(unit, {s, d, Weight::of(alpha), Weight::complement(alpha)});
                if (value != secondForm(unit, s, d, alpha, 255 - alpha)) FAIL() << s << " " << d;
            }
}

TEST_P(EachFreeUnit, KeepsAnInputWhoseFactorIsOne) {
    const BlendUnit unit = GetParam();
    for (int v = 0; v <= 255; ++v) {
        EXPECT_THAT(blend(unit, {v, 77, Weight::one(), Weight::zero()}), Optional(v));
        EXPECT_THAT(blend(unit, {77, v, Weight::zero(), Weight::one()}), Optional(v));
        EXPECT_THAT(blend(unit, {v, 0, Weight::of(255), Weight::zero()}), Optional(v));
        EXPECT_THAT(blend(unit, {v, 77, Weight::zero(), Weight::zero()}), Optional(0));
    }
}

TEST_P(EachFreeUnit, AddsAndClamps) {
    for (int s = 0; s <= 255; ++s)
        for (int d = 0; d <= 255; ++d)
            ASSERT_EQ(blend(GetParam(), {s, d, Weight::one(), Weight::one()}), clamp(s + d));
}

TEST_P(EachFreeUnit, SubtractsToZeroAtLeastIfItCan) {
    for (int s = 0; s <= 255; ++s)
        for (int d = 0; d <= 255; ++d) {
            const auto value =
                blend(GetParam(), {s, d, Weight::one(), Weight::one(), BlendOperation::ReverseSubtract});
            ASSERT_EQ(value.value_or(clamp(d - s)), clamp(d - s));
        }
}

INSTANTIATE_TEST_SUITE_P(Units, EachFreeUnit, testing::ValuesIn(unitsThat(takesAnyFactor)),
                         [](const auto& test) { return name(test.param); });

TEST(BlendUnits, OfFreeFactorsAreTen) {
    EXPECT_EQ(unitsThat(takesAnyFactor).size(), 10u);
}

// MAME and 86Box differ by at most 1 of 8 bits for one product; over all values.
TEST(Voodoo, ModelsDifferByOneAtMost) {
    for (int s = 0; s <= 255; ++s)
        for (int f = 0; f <= 255; ++f) {
            const ChannelBlend c{s, 0, Weight::of(f), Weight::zero()};
            EXPECT_LE(std::abs(*blend(VoodooMame, c) - *blend(Voodoo86Box, c)), 1) << s << " " << f;
        }
}

// What bounds a chip that nobody has measured: the units that round a product down, and those that round it
// up at one half.
TEST(Envelope, HoldsTheMeasuredUnits) {
    for (int s = 0; s <= 255; ++s)
        for (int f = 0; f <= 255; ++f) {
            const ChannelBlend c{s, 0, Weight::of(f), Weight::zero()};
            const int low = *blend(ProductsFloor, c), high = *blend(ProductsRound, c);
            EXPECT_LE(high - low, 1);
            EXPECT_EQ(*blend(Nv2a, c), high);
            EXPECT_EQ(*blend(IdealFloor, c), low);
        }
}

TEST(Gs, FollowsItsFormulaForEveryInputAndCoefficient) {
    using enum GsInput;
    for (const GsInput a : {Source, Destination, Zero})
        for (const GsInput b : {Source, Destination, Zero})
            for (const GsInput d : {Source, Destination, Zero})
                for (const int coefficient : {0, 1, 0x40, 0x7f, 0x80, 0x82, 0xff})
                    for (int cs = 0; cs <= 255; cs += 3)
                        for (int cd = 0; cd <= 255; ++cd) {
                            const auto in = [&](GsInput i) {
                                return i == Source ? cs : i == Destination ? cd : 0;
                            };
                            const double product = (in(a)-in(b)) * coefficient / 128.0;  // exact
                            const int sum = static_cast<int>(std::floor(product)) + in(d);
                            const GsBlend setting{a, b, coefficient, d};
                            ASSERT_EQ(blendGs(setting, cs, cd, true), clamp(sum));
                            ASSERT_EQ(blendGs(setting, cs, cd, false), ((sum % 256) + 256) % 256);
                        }
}

// Every pair that its profile lists (the "constant" ones apart) has a setting, and the sum is OpenGL's to
// less than one: the formula shifts once.
TEST(Gs, HasASettingForThePairsOfAlphas) {
    for (int alpha = 0; alpha <= 128; alpha += 4)
        for (const auto& [f, g] : {std::pair(Weight::of(alpha, 128), Weight::complement(alpha, 128)),
                                   std::pair(Weight::complement(alpha, 128), Weight::of(alpha, 128)),
                                   std::pair(Weight::of(alpha, 128), Weight::one()),
                                   std::pair(Weight::one(), Weight::of(alpha, 128)),
                                   std::pair(Weight::of(alpha, 128), Weight::zero()),
                                   std::pair(Weight::complement(alpha, 128), Weight::zero()),
                                   std::pair(Weight::zero(), Weight::complement(alpha, 128)),
                                   std::pair(Weight::one(), Weight::one())})
            for (int s = 0; s <= 255; s += 5)
                for (int d = 0; d <= 255; d += 5) {
                    const auto share = [](const Weight& w) {
                        return w.kind == Weight::Kind::One          ? 1.0
                               : w.kind == Weight::Kind::Value      ? w.value / 128.0
                               : w.kind == Weight::Kind::Complement ? 1 - w.value / 128.0
                                                                    : 0.0;
                    };
                    const double sum = s * share(f) + d * share(g);
                    const auto value = blend(Gs, {s, d, f, g});
                    ASSERT_TRUE(value.has_value());
                    EXPECT_LT(std::abs(*value - std::min(sum, 255.0)), 1);
                }
    EXPECT_EQ(blend(Gs, {1, 1, Weight::of(3, 128), Weight::of(5, 128)}), std::nullopt);
    EXPECT_EQ(blend(Gs, {1, 1, Weight::one(), Weight::complement(5, 128)}), std::nullopt);
}

TEST(Gs, HasNoColoursForFactors) {
    const BlendState doubling{BlendFactor::DstColor, BlendFactor::One};
    EXPECT_EQ(blendPixel(Gs, doubling, {255, 255, 255, 128}, {64, 64, 64, 128}), std::nullopt);
    const BlendState fading{BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha};
    EXPECT_THAT(blendPixel(Gs, fading, {200, 100, 0, 128}, {9, 9, 9, 0}), Optional(Rgba{200, 100, 0, 128}));
}

// Section 2.5: around 0x60 these are the factors that count by one.
TEST(Gs, CountsByModulation) {
    for (int v = 64; v <= 127; ++v) EXPECT_EQ(modulateGs(v, 0x82), v + 1);
    for (int v = 1; v <= 128; ++v) EXPECT_EQ(modulateGs(v, 0x7f), v - 1);
    for (int factor = 0x78; factor <= 0x8f; ++factor) {
        bool up = true, down = true;
        for (int v = 0x60 - 16; v <= 0x60 + 16; ++v) {
            up = up && modulateGs(v, factor) == v + 1;
            down = down && modulateGs(v, factor) == v - 1;
        }
        EXPECT_EQ(up, factor == 0x82) << factor;
        EXPECT_EQ(down, factor == 0x7f) << factor;
    }
}

// Section 2.5: games counted modulo 32 in the top five bits.
TEST(Gs, CountsModulo32WhenItWraps) {
    using enum GsInput;
    int code = 0;
    std::vector<int> codes;
    for (const int step : {8, 8, 0xff, 0xff, 0xff}) {
        code = blendGs({Source, Zero, 0x80, Destination}, step, code << 3, false) >> 3;
        codes.push_back(code);
    }
    EXPECT_THAT(codes, testing::ElementsAre(1, 2, 1, 0, 31));
}

TEST(Rdp, WrapsAndNeverClamps) {
    for (int p = 0; p <= 255; ++p)
        for (int m = 0; m <= 255; ++m)
            for (const int a : {0, 7, 16, 31})
                for (const int b : {0, 15, 31}) {
                    const int whole = static_cast<int>(std::floor((p * a + m * (b + 1)) / 32.0));
                    ASSERT_EQ(blendRdp(p, a, m, b), whole % 256);
                }
    EXPECT_EQ(blendRdp(255, 31, 255, 31), (255 * 31 + 255 * 32) / 32 - 256);
}

TEST(Nv3, HasComplementaryWeightsInSixteenths) {
    for (int s = 0; s < 32; ++s)
        for (int d = 0; d < 32; ++d) {
            EXPECT_EQ(addNv3(s, d), s + d > 31 ? 31 : s + d);
            for (int beta = 0; beta < 32; ++beta) {
                const int f = beta / 2;
                const double mix = d + (s - d) * f / 16.0;
                const int expected = f == 15 ? s : static_cast<int>(std::floor(mix));
                EXPECT_EQ(blendNv3(s, d, beta), expected);
                EXPECT_EQ(blendNv3(s, d, beta, true), blendNv3(0, d, beta));
                EXPECT_EQ(blendNv3(s, d, beta, false, true), blendNv3(s, 0, beta));
            }
        }
}

TEST(Virge, CutsTheMixture) {
    for (const int alpha : {0, 1, 127, 128, 254, 255})
        for (int s = 0; s <= 255; ++s)
            for (int d = 0; d <= 255; ++d) {
                const auto value = blend(Virge, {s, d, Weight::of(alpha), Weight::complement(alpha)});
                ASSERT_EQ(value, (Fraction{s * alpha + d * (255 - alpha)}.down()));
            }
    EXPECT_EQ(blend(Virge, {1, 1, Weight::one(), Weight::one()}), std::nullopt);
}

TEST(Ds, MixesInThirtySeconds) {
    for (int s = 0; s < 64; ++s)
        for (int d = 0; d < 64; ++d) {
            EXPECT_EQ(blendDs(s, d, 31), s);
            EXPECT_EQ(blendDs(s, d, 5, false), s);
            for (int a = 0; a < 32; ++a)
                EXPECT_EQ(blendDs(s, d, a), static_cast<int>(std::floor(d + (s - d) * (a + 1) / 32.0)));
        }
}

TEST(Psx, HasFourBlendsThatSaturate) {
    for (int f = 0; f < 32; ++f)
        for (int b = 0; b < 32; ++b) {
            EXPECT_EQ(blendPsx(PsxBlend::Average, f, b), static_cast<int>(std::floor((f + b) / 2.0)));
            EXPECT_EQ(blendPsx(PsxBlend::Add, f, b), std::min(31, b + f));
            EXPECT_EQ(blendPsx(PsxBlend::Subtract, f, b), std::max(0, b - f));
            EXPECT_EQ(blendPsx(PsxBlend::AddQuarter, f, b), std::min(31, b + f / 4));
        }
}

TEST(Ge, TakesFactorsUpToTwo) {
    for (int v = 0; v <= 255; ++v) {
        // 2 As at 255 doubles, to one less at most.
        const int twice = *blend(Ge, {v, 0, Weight::of(510), Weight::zero()});
        EXPECT_GE(twice, clamp(2 * v - 1));
        EXPECT_LE(twice, clamp(2 * v + 1));
    }
    EXPECT_THAT(blend(Ge, {10, 200, Weight::one(), Weight::one(), BlendOperation::AbsoluteDifference}),
                Optional(190));
}

// Equations that ignore their factors.
TEST(Operations, MinimumAndMaximumIgnoreFactors) {
    for (const BlendUnit unit : {IdealRound, ProductsFloor, Nv2a, Ge}) {
        const ChannelBlend c{10, 200, Weight::zero(), Weight::of(7), BlendOperation::Min};
        EXPECT_THAT(blend(unit, c), Optional(10));
        EXPECT_THAT(blend(unit, {10, 200, {}, {}, BlendOperation::Max}), Optional(200));
    }
    EXPECT_EQ(blend(VoodooMame, {10, 200, {}, {}, BlendOperation::Max}), std::nullopt);
    EXPECT_EQ(blend(PowerVr, {10, 200, {}, {}, BlendOperation::Subtract}), std::nullopt);
    EXPECT_THAT(blend(Flipper, {10, 200, Weight::zero(), Weight::zero(), BlendOperation::ReverseSubtract}),
                Optional(190));
}

TEST(Factors, OfAPixelAreThoseOfItsChannel) {
    const Rgba source{10, 20, 30, 40}, destination{50, 60, 70, 80}, constant{1, 2, 3, 4};
    const auto weight = [&](BlendFactor factor, int channel) {
        return weightOf(IdealRound, factor, source, destination, constant, channel);
    };
    using enum BlendFactor;
    EXPECT_EQ(weight(SrcColor, 1), Weight::of(20));
    EXPECT_EQ(weight(OneMinusDstColor, 2), Weight::complement(70));
    EXPECT_EQ(weight(SrcAlpha, 0), Weight::of(40));
    EXPECT_EQ(weight(DstColor, 3), Weight::of(80));
    EXPECT_EQ(weight(ConstantColor, 2), Weight::of(3));
    EXPECT_EQ(weight(OneMinusConstantAlpha, 2), Weight::complement(4));
    EXPECT_EQ(weight(SrcAlphaSaturate, 0), Weight::of(40));
    EXPECT_EQ(weight(SrcAlphaSaturate, 3), Weight::one());
    EXPECT_EQ(weightOf(IdealRound, SrcAlphaSaturate, {0, 0, 0, 250}, destination, constant, 0),
              Weight::of(175));
}

}  // namespace
}  // namespace gnomon
