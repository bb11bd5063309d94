// Figure 9 of Lou & Chai 2010, Example-based Human Motion Denoising: error against window size, for
// a noisy walk and for missing limbs in jumps.
#include "kinemend/extend/method_options.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

void figure_9(const Arguments& arguments) {
  const LouGroup walks = walking_groups(arguments)[0];
  std::vector<std::string> jumps = {"16_01", "16_03", "16_05", "16_06", "16_09", "16_10"};
  if (arguments.quick) jumps.resize(2);
  const LouGroup jumping =
      lou_group(arguments, "jumps", jumps, {"16_02", "16_04", "16_07"}, "jump");
  std::vector<std::size_t> windows = {2, 3, 5, 7, 10, 15, 20, 25, 30, 40};
  if (arguments.quick) windows = {5, 20};
  Table table(arguments, "lou_windows.csv",
              "window_frames,denoising_rms_deg,filling_rms_deg,jumps_rms_deg,"
              "papers_denoising_rms_deg,papers_filling_rms_deg");
  fmt::print("Figure 9: windows of so many frames at 30 Hz. Degrees per joint angle.\n\n");
  const TextTable text({"denoise", "fill", "jumps", "paper", "fill"});
  const auto denoising = [](const Cleaner& cleaner, const std::vector<Take>& takes) {
    return denoising_error(cleaner, takes, 3);
  };
  const auto filling = [&](const Cleaner& cleaner) {
    return mean_filling_error(cleaner, jumping.tests);
  };
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    text.add(name, values);
    std::vector<std::string> cells{quoted(name)};
    for (const double value : values) cells.push_back(fmt::format("{:.5g}", value));
    cells.resize(6);
    table.add(cells);
  };
  for (const std::size_t window : windows) {
    const OptionValues options = {{"window_s", static_cast<double>(window) / lou_rate_hz}};
    const auto of_walks = learned("example", walks.training, options),
               of_jumps = learned("example", jumping.training, options);
    const auto denoiser = make_example({}, of_walks), filler = make_example({}, of_jumps);
    add(fmt::format("{}", window),
        {denoising(*denoiser, walks.tests), filling(*filler), denoising(*filler, jumping.tests),
         denoising(*papers_example(of_walks), walks.tests), filling(*papers_example(of_jumps))});
  }
  const auto kalman = make_kalman_learned({}, learned("kalman-learned", walks.training)),
             of_jumps = make_kalman_learned({}, learned("kalman-learned", jumping.training));
  add("(kalman-learned, smoother)",
      {denoising(*kalman, walks.tests), filling(*of_jumps), denoising(*of_jumps, jumping.tests)});
  const auto automatic = make_auto();
  add("(auto)", {denoising(*automatic, walks.tests), filling(*automatic),
                 denoising(*automatic, jumping.tests)});
  table.close();
}

const Registration lou_windows_entry("lou_windows", figure_9);

}  // namespace
}  // namespace kinemend::papers
