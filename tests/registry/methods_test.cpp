// Tests of the table of methods: names, options, and creation of cleaners.
#include "kinemend/extend/method_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string message_of(std::string_view method, const OptionValues& values = {}) {
  try {
    make_cleaner(method, values);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

bool ships(const std::string& method) {
  const auto models = shipped_models();
  return std::any_of(models.begin(), models.end(),
                     [&](const ShippedModel& model) { return model.method == method; });
}

TEST(Methods, HaveDifferentNamesAndSayWhatTheyAre) {
  std::vector<std::string> names;
  for (const Method& method : methods()) names.push_back(method.name);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(std::count(names.begin(), names.end(), names[i]), 1) << names[i];
    EXPECT_FALSE(methods()[i].summary.empty()) << names[i];
    EXPECT_FALSE(methods()[i].paper.empty()) << names[i];
    EXPECT_EQ(&find_method(names[i]), &methods()[i]);
  }
}

TEST(Methods, AreMadeFromTheirOwnDefaultsAndDescribeEveryOption) {
  for (const Method& method : methods()) {
    OptionValues defaults;
    for (const OptionSpec& spec : method.options) {
      defaults[spec.name] = spec.default_value;
      EXPECT_FALSE(spec.help.empty()) << method.name << " " << spec.name;
      EXPECT_NO_THROW(check_option(spec, spec.default_value)) << method.name << " " << spec.name;
    }
    if (!method.learned) {
      EXPECT_NE(method.make(defaults), nullptr);
    }
  }
}

TEST(Methods, MakeCleanersThatKnowTheirNameAndTheirOptions) {
  for (const Method& method : methods()) {
    if (method.learned && !ships(method.name)) continue;
    OptionValues defaults;
    for (const OptionSpec& spec : method.options) defaults[spec.name] = spec.default_value;
    const auto cleaner = method.make({});
    EXPECT_EQ(cleaner->name(), method.name);
    EXPECT_EQ(cleaner->options(), defaults) << method.name;
  }
  EXPECT_EQ(make_cleaner("median", {{"window_s", 0.2}})->options().at("window_s"),
            OptionValue(0.2));
  const auto live = make_cleaner("learned", {{"live", true}});
  EXPECT_EQ(live->name(), "learned");
  EXPECT_EQ(live->options().at("live"), OptionValue(true));
}

TEST(Methods, WithALearnedModelAreThoseWhoseModelsAreRead) {
  std::vector<std::string> cleaning, trained;
  for (const Method& method : methods()) {
    if (method.learned) cleaning.push_back(method.name);
  }
  for (const ModelKind& method : model_kinds()) {
    EXPECT_GE(method.version, 1) << method.name;
    if (!method.is_method) continue;
    trained.emplace_back(method.name);
    const std::vector<OptionSpec>& options = find_method(method.name).options;
    EXPECT_TRUE(std::any_of(options.begin(), options.end(), [](const OptionSpec& option) {
      return option.name == "model";
    })) << method.name;
  }
  EXPECT_EQ(cleaning, trained);
}

TEST(Methods, ThatDoNotExistAreRefusedWithTheNearestName) {
  EXPECT_THAT(message_of("buterworth"), HasSubstr("did you mean butterworth?"));
  EXPECT_THAT(message_of("weighted_mean"), HasSubstr("did you mean weighted-mean?"));
  EXPECT_THAT(message_of("one"), HasSubstr("did you mean one-euro?"));
  EXPECT_THAT(message_of("xyzzy"), Not(HasSubstr("did you mean")));
  EXPECT_THAT(message_of("xyzzy"), HasSubstr("hampel, wavelet"));
}

TEST(Methods, RefuseOptionsTheyDoNotHave) {
  EXPECT_THAT(message_of("butterworth", {{"cutof_hz", 5.0}}),
              HasSubstr("no option \"cutof_hz\"; did you mean cutoff_hz?"));
  EXPECT_THAT(message_of("median", {{"passes", std::int64_t{2}}}), HasSubstr("window_s"));
}

TEST(Methods, RefuseValuesOutOfRange) {
  EXPECT_THAT(message_of("butterworth", {{"cutoff_hz", -1.0}}),
              HasSubstr("cutoff_hz: -1 is outside"));
  EXPECT_THAT(message_of("wavelet", {{"family", std::string("db11")}}), HasSubstr("is not one of"));
  EXPECT_THROW(make_butterworth({.order = 0}), Error);
  EXPECT_THROW(make_kalman({.model = "jerk"}), Error);
  EXPECT_THROW(make_one_euro({.min_cutoff_hz = 0}), Error);
  EXPECT_THROW(make_hampel({.threshold = std::nan("")}), Error);
}

}  // namespace
}  // namespace kinemend::test
