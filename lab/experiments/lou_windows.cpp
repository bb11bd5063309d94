// Figure 9 of Lou & Chai 2010, Example-based Human Motion Denoising: error against window size, for
// a noisy walk and for missing limbs in jumps.
#include <algorithm>
#include <cmath>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/take.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

const std::vector<std::vector<std::string>> limbs = {{"LeftArm", "LeftForeArm", "LeftHand"},
                                                     {"RightArm", "RightForeArm", "RightHand"},
                                                     {"LeftUpLeg", "LeftLeg", "LeftFoot"},
                                                     {"RightUpLeg", "RightLeg", "RightFoot"}};

// Hides each limb in turn for a second in the middle of the take.
double filling_error(const Cleaner& cleaner, const Take& truth) {
  const std::size_t frames = truth.frame_count();
  const std::size_t length = std::min<std::size_t>(30, frames / 2), first = (frames - length) / 2;
  double sum = 0, count = 0;
  for (const std::vector<std::string>& limb : limbs) {
    std::vector<NamedGap> gaps;
    for (const std::string& joint : limb) gaps.push_back({joint, first, first + length - 1});
    Take damaged = truth;
    mark_gaps(damaged, gaps);
    const Take filled = cleaned(cleaner, damaged);
    for (const std::string& name : limb) {
      const auto joint = static_cast<std::size_t>(truth.skeleton.find(name));
      for (std::size_t f = first; f < first + length; ++f) {
        const double angle =
            degrees_per_radian * angle_between(truth.rotation(f, joint), filled.rotation(f, joint));
        sum += angle * angle, count += 3;
      }
    }
  }
  return std::sqrt(sum / count);
}

void figure_9(const Arguments& arguments) {
  const LouGroup walks = walking_groups(arguments)[0];
  std::vector<std::string> jumps = {"16_01", "16_03", "16_05", "16_06", "16_09", "16_10"};
  if (arguments.quick) jumps.resize(2);
  const LouGroup jumping =
      lou_group(arguments, "jumps", jumps, {"16_02", "16_04", "16_07"}, "jump");
  std::vector<std::size_t> windows = {2, 3, 5, 7, 10, 15, 20, 25, 30, 40};
  if (arguments.quick) windows = {5, 20};
  Table table(arguments, "lou_windows.csv", "window_frames,denoising_rms_deg,filling_rms_deg");
  fmt::print("Figure 9: windows of so many frames at 30 Hz. Degrees per joint angle.\n\n");
  const TextTable text({"denoise", "fill"});
  const auto errors_of = [&](const Cleaner& denoiser, const Cleaner& filler) {
    LouErrors errors;
    for (const Take& truth : walks.tests) {
      for (const std::uint64_t seed : {1, 2, 3})
        errors.add(0, 0, rms_deg(truth, cleaned(denoiser, lou_noise(truth, 3, 0, seed))));
    }
    for (const Take& truth : jumping.tests) errors.add(1, 0, filling_error(filler, truth));
    return std::pair(errors.of(0), errors.of(1));
  };
  for (const std::size_t window : windows) {
    const OptionValues options = {{"window_s", static_cast<double>(window) / lou_rate_hz}};
    const auto denoiser = make_example({}, learned("example", walks.training, options));
    const auto filler = make_example({}, learned("example", jumping.training, options));
    const auto [denoising, filling] = errors_of(*denoiser, *filler);
    text.add(fmt::format("window {}", window), {denoising, filling});
    table.add({fmt::format("{}", window), fmt::format("{:.5g}", denoising),
               fmt::format("{:.5g}", filling)});
  }
  const auto [denoising, filling] =
      errors_of(*make_kalman_learned({}, learned("kalman-learned", walks.training)),
                *make_kalman_learned({}, learned("kalman-learned", jumping.training)));
  text.add("(kalman-learned, smoother)", {denoising, filling});
  table.add({quoted("(kalman-learned, smoother)"), fmt::format("{:.5g}", denoising),
             fmt::format("{:.5g}", filling)});
  table.close();
}

const Registration lou_windows_entry("lou_windows", figure_9);

}  // namespace
}  // namespace kinemend::papers
