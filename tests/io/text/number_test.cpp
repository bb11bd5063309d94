// Tests of numbers as text, against the C library.
#include "io/text/number.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

// Surrounds the token with text, because the parser may read before and after it.
struct Padded {
  explicit Padded(const std::string& token)
      : text("0.12345 " + token + " 7.1 8.2 9.3 4.4 5.5 6.6 7.7 8.8 ") {}
  const char* begin() const { return text.data() + 8; }
  std::string text;
};

NumberToken read(const std::string& token, CommaStyle commas = CommaStyle::none) {
  return read_number(token.data(), token.data() + token.size(), commas);
}

std::string fixed(double value, unsigned decimals) {
  std::string text(fixed_number_room, '\0');
  text.resize(static_cast<std::size_t>(write_fixed(text.data(), value, decimals) - text.data()));
  return text;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(PlainNumber, EqualsTheCLibraryOnRandomDecimals) {
  Random random(5);
  int plain = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string token = random.chance(0.5) ? "-" : "";
    const std::uint64_t before = random.below(10), after = random.below(10);
    for (std::uint64_t d = 0; d < before; ++d) token += static_cast<char>('0' + random.below(10));
    if (after > 0 || random.chance(0.2)) token += '.';
    for (std::uint64_t d = 0; d < after; ++d) token += static_cast<char>('0' + random.below(10));
    const Padded padded(token);
    PlainNumber number;
    if (!read_plain_number(padded.begin(), number)) {
      const bool too_long = before > 8 || after > 8 || token.size() > 15 || before + after == 0;
      ASSERT_TRUE(too_long) << token;
      continue;
    }
    ++plain;
    ASSERT_TRUE(same_bits(number.value, std::strtod(token.c_str(), nullptr))) << token;
    ASSERT_EQ(number.length, token.size());
    ASSERT_EQ(number.decimals, after);
  }
  EXPECT_GT(plain, 50000);
}

TEST(PlainNumber, LeavesEverythingElseToTheCarefulReader) {
  for (const char* token : {"-", ".", "-.", "", "1e5", "1.2.3", "--1", "1-2", "nan", "1,5", "+1",
                            "0x10", "1.5\x80", "123456789", "0.123456789", "12345678.12345678"}) {
    PlainNumber number;
    EXPECT_FALSE(read_plain_number(Padded(token).begin(), number)) << token;
  }
}

TEST(PlainNumber, PortableStepsEqualTheSimdSteps) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    char bytes[16];
    for (char& byte : bytes) {
      byte = random.chance(0.3) ? static_cast<char>(random.below(256))
                                : "0123456789.- \n\t/:;,"[random.below(19)];
    }
    ASSERT_EQ(detail::byte_masks(bytes), detail::byte_masks_portable(bytes));
    ASSERT_EQ(detail::byte_masks<','>(bytes), detail::byte_masks_portable<','>(bytes));
    ASSERT_EQ(detail::byte_masks<';'>(bytes), detail::byte_masks_portable<';'>(bytes));
    std::uint64_t digits[2] = {0, 0};
    for (int d = 0; d < 16; ++d) digits[d / 8] |= random.below(10) << (8 * (d % 8));
    ASSERT_EQ(detail::join_digits(digits[0], digits[1]),
              detail::join_digits_portable(digits[0], digits[1]));
  }
}

TEST(Number, ReadsEveryFormThatFilesHold) {
  const std::pair<const char*, double> forms[] = {
      {"1", 1},
      {"-0", -0.0},
      {"+5.5", 5.5},
      {".25", 0.25},
      {"-.25", -0.25},
      {"7.", 7},
      {"1e-05", 1e-5},
      {"2E+3", 2000},
      {"123456789012345678901234567890", 1.2345678901234568e29},
      {"0.1000000000000000055511151231257827", 0.1},
      {"5e-324", 5e-324},
      {"1e-400", 0}};
  for (const auto& [text, value] : forms) {
    const NumberToken token = read(text);
    EXPECT_EQ(token.kind, TokenKind::number) << text;
    EXPECT_TRUE(same_bits(token.value, value)) << text;
  }
}

TEST(Number, KnowsWhatIsNoNumber) {
  for (const char* text : {"nan", "NaN", "-nan", "-nan(ind)", "nan(snan)", "inf", "-INF",
                           "Infinity", "1.#QNAN", "-1.#IND00", "1.#INF", "1e400", "-1e999"}) {
    EXPECT_EQ(read(text).kind, TokenKind::not_finite) << text;
    EXPECT_TRUE(std::isnan(read(text).value)) << text;
  }
  for (const char* text : {"#", "# 1", "//", "//1"})
    EXPECT_EQ(read(text).kind, TokenKind::comment) << text;
  for (const char* text :
       {"abc", "1x", "1,5", "+-1", "+", "-", ".", "1e", "--1", "0x1p3", "1_000", "/1", "1.2.3"}) {
    EXPECT_EQ(read(text).kind, TokenKind::text) << text;
  }
}

TEST(Number, CommasAreReadAsTold) {
  EXPECT_EQ(read("-1,25", CommaStyle::decimal).value, -1.25);
  EXPECT_EQ(read("1.5", CommaStyle::decimal).value, 1.5);
  EXPECT_EQ(read("1,2,3", CommaStyle::decimal).kind, TokenKind::text);
  EXPECT_EQ(read("1.000,5", CommaStyle::decimal).kind, TokenKind::text);
  const std::string pair = "1.5,2";
  const NumberToken token = read(pair, CommaStyle::separator);
  EXPECT_EQ(token.value, 1.5);
  EXPECT_EQ(token.end, pair.data() + 3);
}

TEST(Number, CommaStyleIsDecidedOnlyWhereItIsClear) {
  EXPECT_EQ(comma_style("1.5 2", 2), CommaStyle::none);
  EXPECT_EQ(comma_style("1,5 2,5", 2), CommaStyle::decimal);
  EXPECT_EQ(comma_style("1,5 2,5", 4), CommaStyle::separator);
  EXPECT_EQ(comma_style("1.0, 2.0", 2), CommaStyle::separator);
  EXPECT_EQ(comma_style("1,2 3,4", 3), CommaStyle::none);
}

TEST(Number, DoesNotDependOnTheLocale) {
  const char* before = std::setlocale(LC_ALL, nullptr);
  const std::string saved = before;
  bool german = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    german = german || std::setlocale(LC_ALL, name);
  const double value = read("1.5e0").value;
  const std::string text = fixed(-2.25, 2);
  std::setlocale(LC_ALL, saved.c_str());
  EXPECT_EQ(value, 1.5);
  EXPECT_EQ(text, "-2.25");
  if (!german) GTEST_SKIP() << "no locale with decimal commas is installed";
}

TEST(WriteFixed, EqualsTheCLibrary) {
  Random random(7);
  char expected[512];
  for (int i = 0; i < 100000; ++i) {
    const auto decimals = static_cast<unsigned>(random.below(10));
    double value =
        random.uniform(-360, 360) * std::pow(10.0, static_cast<double>(random.below(12)) - 6);
    // Adds ties and near ties.
    if (random.chance(0.3))
      value = std::round(value * 2000) / 2000 + (random.chance(0.5) ? 1e-14 : 0);
    std::snprintf(expected, sizeof expected, "%.*f", static_cast<int>(decimals), value);
    std::string text = expected;
    if (text[0] == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);
    ASSERT_EQ(fixed(value, decimals), text) << value;
  }
}

TEST(WriteFixed, HoldsAnyFiniteNumber) {
  EXPECT_EQ(fixed(-0.0, 4), "0.0000");
  EXPECT_EQ(fixed(-0.00001, 4), "0.0000");
  EXPECT_EQ(fixed(0.5, 0), "0");
  EXPECT_EQ(fixed(1.5, 0), "2");
  EXPECT_EQ(fixed(999.99996, 4), "1000.0000");
  EXPECT_EQ(fixed(1e15, 4), "1000000000000000.0000");
  EXPECT_EQ(fixed(-1e300, 9).size(), 1 + 301 + 10);
  EXPECT_EQ(fixed(std::numeric_limits<double>::max(), 9).size(), 309 + 10);
  EXPECT_EQ(fixed(5e-324, 9), "0.000000000");
}

TEST(WriteShortest, ReadsBackAsTheSameNumber) {
  Random random(8);
  for (int i = 0; i < 10000; ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-12, 12));
    std::string text(fixed_number_room, '\0');
    text.resize(static_cast<std::size_t>(write_shortest(text.data(), value) - text.data()));
    ASSERT_EQ(text.find_first_of("eE"), text.npos);
    ASSERT_TRUE(same_bits(std::strtod(text.c_str(), nullptr), value)) << text;
  }
}

}  // namespace
}  // namespace kinemend
