// The curves of figures 1, 4 and 8 of Lou & Chai 2010, Example-based Human Motion Denoising: angles
// of a knee and of the thorax, for training walks, a damaged walk and its filtered versions.
#include <cmath>
#include <memory>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

// The rotation vector's first component as one curve per joint.
double angle_deg(const Take& clip, std::size_t frame, const std::string& joint) {
  const auto j = static_cast<std::size_t>(std::max(0, clip.skeleton.find(joint)));
  return degrees_per_radian * log(align_hemisphere(clip.rotation(frame, j), Quat{})).x;
}

void add(Table& table, const std::string& figure, const std::string& version, const Take& clip,
         const std::string& joint) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    table.add({figure, quoted(version), joint, fmt::format("{}", f),
               fmt::format("{:.5g}", angle_deg(clip, f, joint))});
  }
}

void curves(const Arguments& arguments) {
  const LouGroup group = walking_groups(arguments)[0];
  const Take& truth = group.tests[0];
  const auto model = learned("example", group.training);
  const auto example = make_example({}, model);
  const std::string knee = "RightLeg", thorax = "Spine1";
  Table table(arguments, "lou_curves.csv", "figure,version,joint,frame,angle_deg");
  Table errors(arguments, "lou_curve_errors.csv", "figure,version,joint,joint_deg,take_deg");
  const auto add_error = [&](const std::string& figure_number, const std::string& version,
                             const Take& clip, const std::string& joint) {
    double square = 0;
    for (std::size_t f = 0; f < truth.frame_count(); ++f)
      square += std::pow(angle_deg(clip, f, joint) - angle_deg(truth, f, joint), 2);
    errors.add({figure_number, quoted(version), joint,
                fmt::format("{:.4g}", std::sqrt(square / static_cast<double>(truth.frame_count()))),
                fmt::format("{:.4g}", rms_deg(truth, clip))});
  };

  // Figures 1 and 4: outliers hit the knee throughout, but not the thorax.
  Take hit = truth;
  Random random(4);
  apply_damage(hit, "outliers", {{"share", 0.3}, {"joints", knee}}, random);
  const Take mended = cleaned(*example, hit);
  for (const std::string& joint : {knee, thorax}) {
    for (std::size_t i = 0; i < group.training.size(); ++i)
      add(table, "4", fmt::format("training {}", i + 1), at_lou_rate(group.training[i]), joint);
    add(table, "4", "truth", truth, joint);
    add(table, "4", "noisy", hit, joint);
    add(table, "4", "filtered", mended, joint);
    add_error("4", "noisy", hit, joint);
    add_error("4", "filtered", mended, joint);
    add_error("4", "filtered, solver=paper", cleaned(*papers_example(model), hit), joint);
  }
  // Figure 8: noise and outliers in every joint; the thorax cleaned by the four methods.
  const Take noisy = lou_noise(truth, 3, 0.1, 8);
  KalmanLearnedOptions of_the_past;
  of_the_past.smoother = false;
  const auto gaussian = make_gaussian({2 / lou_rate_hz});
  const auto kalman = make_kalman({.model = "position", .smoother = false});
  const auto data_driven =
      make_kalman_learned(of_the_past, learned("kalman-learned", group.training));
  add(table, "8", "truth", truth, thorax);
  add(table, "8", "noisy", noisy, thorax);
  add_error("8", "noisy", noisy, thorax);
  const auto of_the_paper = papers_example(model);
  fmt::print(
      "Figure 8: a walk with noise of 3 degrees and 10 % outliers; degrees per joint angle.\n");
  for (const auto& [name, cleaner] :
       {std::pair{"Gaussian", gaussian.get()}, std::pair{"Kalman", kalman.get()},
        std::pair{"data-driven Kalman", data_driven.get()}, std::pair{"example", example.get()},
        std::pair{"example, solver=paper", of_the_paper.get()}}) {
    const Take result = cleaned(*cleaner, noisy);
    fmt::print("  {:22}{:8.2f}\n", name, rms_deg(truth, result));
    add(table, "8", name, result, thorax);
    add_error("8", name, result, thorax);
  }
  fmt::print(
      "Figures 1 and 4: a knee hit in 30 % of the frames, degrees per joint angle: {:.2f}, "
      "filtered {:.2f}\n",
      rms_deg(truth, hit), rms_deg(truth, mended));
  table.close();
  errors.close();
}

const Registration lou_curves_entry("lou_curves", curves);

}  // namespace
}  // namespace kinemend::papers
