// Blend units against second forms of their formulas, over all values.

#include "profile/blend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "profile/words.h"

namespace gnomon {
namespace blend_test {

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
                    if (value != secondForm(unit, s, d, f, g))
                        FAIL() << s << " * " << f << " + " << d << " * " << g << ": " << value.value_or(-1);
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

// Every pair of weights and every operation: if some A, B, C, D give OpenGL's sum for all inputs, it is that
// one to the bit, and if none do, there is no value. The search is over the formula's values, not its shares.
TEST(Gs, HasWhatItsFormulaHasAndNothingElse) {
    using enum GsInput;
    using enum BlendOperation;
    const int alpha = 0x30;
    const std::vector<Weight> weights{Weight::zero(), Weight::one(), Weight::of(alpha, 128),
                                      Weight::complement(alpha, 128)};
    const auto share = [&](const Weight& w) {
        return w.kind == Weight::Kind::One          ? 128
               : w.kind == Weight::Kind::Value      ? alpha
               : w.kind == Weight::Kind::Complement ? 128 - alpha
                                                    : 0;
    };
    const auto down = [](int over128) { return static_cast<int>(std::floor(over128 / 128.0)); };
    int found = 0, missing = 0;
    for (const Weight& f : weights)
        for (const Weight& g : weights)
            for (const BlendOperation operation : {Add, Subtract, ReverseSubtract, AddWrap}) {
                const int signS = operation == ReverseSubtract ? -1 : 1,
                          signD = operation == Subtract ? -1 : 1;
                // One input alone, 128 times its share, tells all shares apart.
                bool exists = false;
                for (const GsInput a : {Source, Destination, Zero})
                    for (const GsInput b : {Source, Destination, Zero})
                        for (const GsInput d : {Source, Destination, Zero})
                            for (const int c : {alpha, 128}) {
                                bool same = true;
                                for (const auto& [s, t] : {std::pair(128, 0), std::pair(0, 128)})
                                    same =
                                        same && sumGs({a, b, c, d}, s, t) ==
                                                    signS * s / 128 * share(f) + signD * t / 128 * share(g);
                                exists = exists || same;
                            }
                const auto sample = blend(Gs, {100, 50, f, g, operation});
                ASSERT_EQ(sample.has_value(), exists)
                    << int(f.kind) << " " << int(g.kind) << " " << name(Gs) << " " << int(operation);
                ++(exists ? found : missing);
                if (!exists) continue;
                for (int s = 0; s <= 255; ++s)
                    for (int t = 0; t <= 255; ++t) {
                        const int sum = down(signS * s * share(f) + signD * t * share(g));
                        const ChannelBlend c{s, t, f, g, operation};
                        ASSERT_EQ(blend(Gs, c),
                                  operation == AddWrap ? ((sum % 256) + 256) % 256 : clamp(sum));
                        ASSERT_EQ(blend(GsWrap, c), ((sum % 256) + 256) % 256);
                    }
            }
    EXPECT_GT(found, 30);
    EXPECT_GT(missing, 10);
    // profiles/ps2.toml: reverse_subtract for "one one" and "src_alpha one", not for "one src_alpha".
    const Weight one = Weight::one(), value = Weight::of(alpha, 128);
    EXPECT_TRUE(blend(Gs, {1, 1, one, one, ReverseSubtract}));
    EXPECT_TRUE(blend(Gs, {1, 1, value, one, ReverseSubtract}));
    EXPECT_FALSE(blend(Gs, {1, 1, one, value, ReverseSubtract}));
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

// One and one by a sum that wraps is the forced blend with both weights whole; nothing on the chip clamps.
TEST(Rdp, AddsOneAndOneOnlyByWrapping) {
    for (int p = 0; p <= 255; ++p)
        for (int m = 0; m <= 255; ++m) {
            const ChannelBlend c{p, m, Weight::one(), Weight::one(), BlendOperation::AddWrap};
            ASSERT_EQ(blend(Rdp, c), static_cast<int>(std::floor(p * 31 / 32.0 + m)) % 256);
        }
    EXPECT_EQ(blend(Rdp, {1, 1, Weight::one(), Weight::one()}), std::nullopt);
    EXPECT_EQ(blend(Rdp, {1, 1, Weight::one(), Weight::one(), BlendOperation::ReverseSubtract}),
              std::nullopt);
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

// 255 - 2 As is negative from 128 on, and the product of its size is then taken away.
TEST(Ge, SubtractsWhereADoubledComplementIsNegative) {
    for (int s = 0; s <= 255; ++s)
        for (int alpha = 0; alpha <= 255; ++alpha) {
            const int f = 255 - 2 * alpha;
            const int size = static_cast<int>(std::floor((s + 0.5) * (std::abs(f) + 0.5) / 256));
            const ChannelBlend c{s, 100, Weight::complement(2 * alpha), Weight::one()};
            ASSERT_EQ(blend(Ge, c), clamp(100 + (f < 0 ? -size : size))) << s << " " << alpha;
        }
}

TEST(Ge, TakesTheAbsoluteDifferenceWithoutFactors) {
    for (int s = 0; s <= 255; ++s)
        for (int d = 0; d <= 255; ++d)
            ASSERT_EQ(blend(Ge, {s, d, Weight::zero(), Weight::of(7), BlendOperation::AbsoluteDifference}),
                      s > d ? s - d : d - s);
}

/// Units, and what of the operations they have for one and one.
TEST(Operations, AreThoseOfEachChip) {
    using enum BlendOperation;
    const auto of = [](BlendUnit unit) {
        std::string text;
        const std::array<const char*, 9> words{"+", "-", "r", "m", "M", "s", "d", "a", "w"};
        for (std::size_t o = 0; o < words.size(); ++o)
            if (blend(unit, {9, 5, Weight::one(), Weight::one(), static_cast<BlendOperation>(o)}))
                text += words[o];
        return text;
    };
    const std::map<BlendUnit, std::string> expected{{IdealRound, "+-rmMw"},
                                                    {IdealFloor, "+-rmMw"},
                                                    {ProductsRound, "+-rmM"},
                                                    {ProductsFloor, "+-rmM"},
                                                    {VoodooMame, "+"},
                                                    {Voodoo86Box, "+"},
                                                    {Gs, "+-rw"},
                                                    {GsWrap, "+-rw"},
                                                    {PowerVr, "+"},
                                                    {Flipper, "+r"},
                                                    {Rdp, "w"},
                                                    {Ge, "+-rmMa"},
                                                    {Nv3, "+"},
                                                    {Virge, ""},
                                                    {Ds, ""},
                                                    {Psx, "+r"},
                                                    {Nv2a, "+-rmMsd"}};
    EXPECT_EQ(expected.size(), names<BlendUnit>().size());
    for (const auto& [unit, operations] : expected) EXPECT_EQ(of(unit), operations) << name(unit);
    static_assert(int(AddWrap) == 8);
}

// Codes of any width: the sum modulo the number of codes.
TEST(Operations, WrapOnCodesOfAnyWidth) {
    for (const int most : {31, 63, 255})
        for (int s = 0; s <= most; ++s)
            for (int d = 0; d <= most; ++d) {
                const ChannelBlend c{s, d, Weight::one(), Weight::one(), BlendOperation::AddWrap, most};
                ASSERT_EQ(blend(IdealRound, c), (s + d) % (most + 1));
                ASSERT_EQ(blend(IdealFloor, c), (s + d) % (most + 1));
            }
}

TEST(Operations, AreTheEquationsOfProfiles) {
    using enum BlendEquation;
    for (std::size_t i = 0; i < names<BlendEquation>().size(); ++i) {
        const auto equation = static_cast<BlendEquation>(i);
        // The operations have the absolute difference between NV2A's and the wrapping sum.
        const auto expected = equation == AddWrap                 ? BlendOperation::AddWrap
                              : equation == SignedAdd             ? BlendOperation::SignedAdd
                              : equation == SignedReverseSubtract ? BlendOperation::SignedReverseSubtract
                                                                  : static_cast<BlendOperation>(i);
        EXPECT_EQ(operationOf(equation), expected) << name(equation);
    }
}

/// A whole number over a positive one, exact.
struct Exact {
    std::int64_t over, under = 1;
    Exact plus(Exact b) const { return {over * b.under + b.over * under, under * b.under}; }
    Exact minus(Exact b) const { return {over * b.under - b.over * under, under * b.under}; }
    /// Counted up or down to from a first guess: no rounding of the division is trusted.
    std::int64_t floor() const {
        std::int64_t n = over / under;
        while (n * under > over) --n;
        while ((n + 1) * under <= over) ++n;
        return n;
    }
    std::int64_t nearest() const { return Exact{2 * over + under, 2 * under}.floor(); }
};

/// A weight as @p unit defines it.
Exact definition(BlendUnit unit, const Weight& w) {
    const bool none = w.kind == Weight::Kind::Zero, one = w.kind == Weight::Kind::One;
    const bool value = w.kind == Weight::Kind::Value;
    switch (unit) {
        case VoodooMame:
            return {none ? 0 : one ? 256 : value ? w.value + 1 : 256 - w.value, 256};
        case PowerVr:
        case Flipper: {
            const int v = value ? w.value : 255 - w.value;
            return {none ? 0 : one ? 256 : v >= 128 ? v + 1 : v, 256};
        }
        case Ge:  // in halves
            return {none ? 1 : one ? 511 : value ? 2 * w.value + 1 : 2 * (255 - w.value) + 1, 512};
        default:
            return {none ? 0 : one ? w.unit : value ? w.value : w.unit - w.value, w.unit};
    }
}

std::int64_t byDefinition(BlendUnit unit, const ChannelBlend& c) {
    const Exact f = definition(unit, c.sourceWeight), g = definition(unit, c.destinationWeight);
    const Exact s{c.source * f.over, f.under}, d{c.destination * g.over, g.under};
    const auto combined = [&](auto a, auto b) {
        return c.operation == BlendOperation::Subtract          ? a - b
               : c.operation == BlendOperation::ReverseSubtract ? b - a
                                                                : a + b;
    };
    const Exact sum = c.operation == BlendOperation::Subtract          ? s.minus(d)
                      : c.operation == BlendOperation::ReverseSubtract ? d.minus(s)
                                                                       : s.plus(d);
    switch (unit) {
        case IdealRound:
        case Nv2a:
            return sum.nearest();
        case ProductsRound:
            return combined(s.nearest(), d.nearest());
        case ProductsFloor:
        case Voodoo86Box:
            return combined(s.floor(), d.floor());
        case Ge: {
            const Exact sHalves{(2 * c.source + 1) * f.over, 2 * f.under};
            const Exact dHalves{(2 * c.destination + 1) * g.over, 2 * g.under};
            return combined(sHalves.floor(), dHalves.floor());
        }
        default:
            return sum.floor();
    }
}

class EachUnitByDefinition : public testing::TestWithParam<BlendUnit> {};

// All 256 x 256 inputs times weights of every kind and around every bound, as exact fractions with an
// explicit floor. Differences too, where the unit has them.
TEST_P(EachUnitByDefinition, AgreesOverAllInputs) {
    using enum BlendOperation;
    const BlendUnit unit = GetParam();
    const std::vector<Weight> weights{Weight::zero(),  Weight::one(),          Weight::of(1),
                                      Weight::of(127), Weight::of(128),        Weight::of(254),
                                      Weight::of(255), Weight::complement(0),  Weight::complement(77),
                                      Weight::of(0),   Weight::complement(128)};
    std::int64_t compared = 0;
    for (const Weight& f : weights)
        for (const Weight& g : weights)
            for (const BlendOperation operation : {Add, Subtract, ReverseSubtract}) {
                if (!blend(unit, {1, 1, f, g, operation})) continue;
                if (unit == Flipper && operation != Add) continue;  // ignores its factors
                for (int s = 0; s <= 255; ++s)
                    for (int d = 0; d <= 255; ++d) {
                        const ChannelBlend c{s, d, f, g, operation};
                        const auto expected = std::clamp<std::int64_t>(byDefinition(unit, c), 0, 255);
                        if (blend(unit, c) != expected)
                            FAIL() << name(unit) << " " << s << " " << d << " " << int(operation) << ": "
                                   << *blend(unit, c) << ", not " << expected;
                        ++compared;
                    }
            }
    EXPECT_GE(compared, 121 * 65'536);
}

INSTANTIATE_TEST_SUITE_P(Units, EachUnitByDefinition, testing::ValuesIn(unitsThat(takesAnyFactor)),
                         [](const auto& test) { return name(test.param); });

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

}  // namespace blend_test
}  // namespace gnomon
