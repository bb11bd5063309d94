// Tests of option tables: defaults, ranges, texts, and the messages for values that do not fit.
#include "kinemend/extend/options.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

namespace kinemend {
namespace {

using testing::AllOf;
using testing::Property;
using testing::Throws;
using testing::ThrowsMessage;

struct Settings {
  double cutoff_hz = 6;
  std::int64_t order = 4;
  bool zero_phase = true;
  std::string ends = "mirror";
  std::string name = "";
};

OptionTable<Settings> table() {
  OptionTable<Settings> t;
  t.number(&Settings::cutoff_hz, "cutoff_hz", "Hz", 0.1, 120, "where the filter starts to act")
      .integer(&Settings::order, "order", "", 1, 12, "order of the filter")
      .flag(&Settings::zero_phase, "zero_phase", "forwards and backwards")
      .choice(&Settings::ends, "ends", {"mirror", "constant"}, "what lies beyond the ends")
      .choice(&Settings::name, "name", {}, "any text");
  return t;
}

auto usage(const char* message) {
  return AllOf(Throws<Error>(Property(&Error::kind, ErrorKind::usage)),
               ThrowsMessage<Error>(message));
}

OptionSpec spec(const char* name) {
  const auto all = table();
  for (const OptionSpec& s : all.specs()) {
    if (s.name == name) return s;
  }
  throw std::runtime_error(name);
}

TEST(OptionTable, TakesDefaultsFromTheStruct) {
  const auto all = table();
  const auto& specs = all.specs();
  ASSERT_EQ(specs.size(), 5u);
  EXPECT_EQ(specs[0].name, "cutoff_hz");
  EXPECT_EQ(specs[0].unit, "Hz");
  EXPECT_EQ(std::get<double>(specs[0].default_value), 6);
  EXPECT_EQ(specs[0].minimum, 0.1);
  EXPECT_EQ(specs[0].maximum, 120);
  EXPECT_EQ(std::get<std::int64_t>(specs[1].default_value), 4);
  EXPECT_TRUE(std::get<bool>(specs[2].default_value));
  EXPECT_EQ(specs[3].choices, (std::vector<std::string>{"mirror", "constant"}));
}

TEST(OptionTable, PutsValuesIntoTheStruct) {
  const Settings s = table().parse({{"cutoff_hz", 10.5},
                                    {"order", std::int64_t{2}},
                                    {"zero_phase", false},
                                    {"ends", std::string("constant")},
                                    {"name", std::string("anything")}});
  EXPECT_EQ(s.cutoff_hz, 10.5);
  EXPECT_EQ(s.order, 2);
  EXPECT_FALSE(s.zero_phase);
  EXPECT_EQ(s.ends, "constant");
  EXPECT_EQ(s.name, "anything");
  EXPECT_EQ(table().parse({}).order, 4);
}

TEST(OptionTable, GivesBackItsValues) {
  Settings s;
  s.cutoff_hz = 7;
  s.ends = "constant";
  const auto values = table().values(s);
  EXPECT_EQ(values.size(), 5u);
  EXPECT_EQ(std::get<double>(values.at("cutoff_hz")), 7);
  EXPECT_EQ(table().parse(values).ends, "constant");
}

TEST(OptionTable, AcceptsAWholeNumberForANumber) {
  EXPECT_EQ(table().parse({{"cutoff_hz", std::int64_t{10}}}).cutoff_hz, 10);
}

TEST(OptionTable, NamesWhatIsWrong) {
  const auto parse = [](const char* name, OptionValue value) {
    return [=] { table().parse({{name, value}}); };
  };
  EXPECT_THAT(parse("cutof_hz", 3.0), usage("unknown option cutof_hz"));
  EXPECT_THAT(parse("cutoff_hz", 900.0), usage("cutoff_hz: 900 is outside 0.1 to 120 Hz"));
  EXPECT_THAT(parse("cutoff_hz", 0.0), usage("cutoff_hz: 0 is outside 0.1 to 120 Hz"));
  EXPECT_THAT(parse("cutoff_hz", std::nan("")), usage("cutoff_hz: nan is outside 0.1 to 120 Hz"));
  EXPECT_THAT(parse("cutoff_hz", std::string("six")), usage("cutoff_hz: six is not a number"));
  EXPECT_THAT(parse("cutoff_hz", true), usage("cutoff_hz: true is not a number"));
  EXPECT_THAT(parse("order", std::int64_t{13}), usage("order: 13 is outside 1 to 12"));
  EXPECT_THAT(parse("order", 2.0), usage("order: 2 has the wrong type"));
  EXPECT_THAT(parse("ends", std::string("wrap")),
              usage("ends: \"wrap\" is not one of mirror, constant"));
  EXPECT_THAT(parse("zero_phase", 1.0), usage("zero_phase: 1 has the wrong type"));
}

TEST(OptionTable, ValidatesAStruct) {
  Settings s;
  EXPECT_NO_THROW(table().validate(s));
  s.order = 0;
  EXPECT_THAT([&] { table().validate(s); }, usage("order: 0 is outside 1 to 12"));
}

TEST(ParseOption, ReadsTextOfTheOptionsType) {
  EXPECT_EQ(std::get<double>(parse_option(spec("cutoff_hz"), "1.5e1")), 15);
  EXPECT_EQ(std::get<double>(parse_option(spec("cutoff_hz"), "7")), 7);
  EXPECT_EQ(std::get<std::int64_t>(parse_option(spec("order"), "3")), 3);
  for (const char* yes : {"true", "1", "on", ""})
    EXPECT_TRUE(std::get<bool>(parse_option(spec("zero_phase"), yes)));
  for (const char* no : {"false", "0", "off"})
    EXPECT_FALSE(std::get<bool>(parse_option(spec("zero_phase"), no)));
  EXPECT_EQ(std::get<std::string>(parse_option(spec("ends"), "constant")), "constant");
}

TEST(ParseOption, RefusesOtherText) {
  const auto parse = [](const char* name, const char* text) {
    return [=] { parse_option(spec(name), text); };
  };
  EXPECT_THAT(parse("cutoff_hz", "6x"), usage("cutoff_hz: \"6x\" is not a number"));
  EXPECT_THAT(parse("cutoff_hz", ""), usage("cutoff_hz: \"\" is not a number"));
  EXPECT_THAT(parse("cutoff_hz", "6,5"), usage("cutoff_hz: \"6,5\" is not a number"));
  EXPECT_THAT(parse("cutoff_hz", "1e9"), usage("cutoff_hz: 1000000000 is outside 0.1 to 120 Hz"));
  EXPECT_THAT(parse("order", "3.5"), usage("order: \"3.5\" is not a whole number"));
  EXPECT_THAT(parse("order", "99999999999999999999"),
              usage("order: \"99999999999999999999\" is not a whole number"));
  EXPECT_THAT(parse("zero_phase", "maybe"),
              usage("zero_phase: \"maybe\" is neither true nor false"));
  EXPECT_THAT(parse("ends", "wrap"), usage("ends: \"wrap\" is not one of mirror, constant"));
}

TEST(ParseOption, ReadsWhatToStringWrites) {
  for (const double value : {0.1, 1.0 / 3, 119.99999999999999, 5e-1}) {
    EXPECT_EQ(std::get<double>(parse_option(spec("cutoff_hz"), to_string(OptionValue(value)))),
              value);
  }
  EXPECT_EQ(to_string(OptionValue(std::int64_t{-5})), "-5");
  EXPECT_EQ(to_string(OptionValue(true)), "true");
  EXPECT_EQ(to_string(OptionValue(std::string("a b"))), "a b");
}

TEST(NearestName, IsOneEditAwayOrOneForEveryThreeLetters) {
  EXPECT_EQ(nearest_name("of", {"off", "auto", "force"}), "off");
  EXPECT_EQ(nearest_name("on", {"off", "auto", "force"}), "");
  EXPECT_EQ(nearest_name("undo", {"info", "clean"}), "");
  EXPECT_EQ(nearest_name("inof", {"info", "clean"}), "info") << "neighbours are swapped";
  EXPECT_EQ(nearest_name("claen", {"info", "clean"}), "clean");
  EXPECT_EQ(nearest_name("buterwort", {"butterworth", "bilateral"}), "butterworth");
  EXPECT_EQ(nearest_name("x", {"y", "z"}), "");
  EXPECT_EQ(nearest_name("one", {"one-euro", "auto"}), "one-euro") << "the beginning of a name";
}

}  // namespace
}  // namespace kinemend
