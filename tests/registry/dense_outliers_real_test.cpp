// Walks at 30 Hz with a fifth of the samples thrown off, which `auto` takes for noise. Its result
// does not hold back a method with a model of the person's other walks.
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/train.hpp"

namespace kinemend::test {
namespace {

Take walk_of(const std::string& name) {
  const Take clip =
      read_joints(std::filesystem::path(KINEMEND_DATA_FOLDER) / "cmu/bvh" / (name + ".bvh")).take;
  return slice(clip, leading_calibration_frames(clip), clip.frame_count());
}

std::shared_ptr<const Model> model_of_walks(const std::string& method) {
  const std::vector<std::string> names = {"08_01", "08_02", "08_06", "08_07", "08_11"};
  OptionValues options;
  if (method != "wiener") options["rate_hz"] = 30.0;
  return std::make_shared<const Model>(train_model(
      method, {names.size(), [&](std::size_t i) { return Take(walk_of(names[i])); }}, options));
}

double error_left(const Cleaner& cleaner, const Take& truth, std::uint64_t seed) {
  Take clip = truth;
  Random random = Random(seed).fork(1);
  apply_damage(clip, "outliers", {{"share", 0.2}}, random);
  return rms_deg(truth, clean_take(clip, cleaner).take);
}

TEST(DenseOutliersOfRealTakes, ArePutRight) {
  const auto wiener = make_wiener({}, model_of_walks("wiener"));
  const auto example = make_example({}, model_of_walks("example"));
  // `auto` left more than 7 degrees in these takes when it took dense outliers for noise.
  for (const auto& [name, seed] : {std::pair{"08_03", 3}, {"08_09", 2}}) {
    const Take truth = resample(walk_of(name), 30);
    const auto draw = static_cast<std::uint64_t>(seed);
    EXPECT_LT(error_left(*make_auto(), truth, draw), 3) << name;
    EXPECT_LT(error_left(*wiener, truth, draw), 2) << name;
    EXPECT_LT(error_left(*example, truth, draw), 4) << name;
  }
}

}  // namespace
}  // namespace kinemend::test
