// Figures of docs/methods/auto.md about real pairs: takes of video and depth cameras beside optical
// markers of the same motion, cleaned.
#include <algorithm>
#include <cmath>

#include "made_pairs.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Errors {
  double position = 0, velocity = 0, fast = 0;
};

// After the reference was given a gain and an offset for each channel, which calibration would
// mend; channels that hardly move are left out.
Errors errors_of(const Take& reference, const Take& noisy, const Take& clip) {
  MarkerComparisonSettings settings;
  settings.fit = MarkerFit::gain_offset;
  settings.fit_to = &noisy;
  settings.least_motion = 5;  // millimetres
  const MarkerErrors all = compare_markers(reference, clip, settings).all;
  return {all.rms, all.velocity_rms, all.above_6_hz.value()};
}

// Without data: walks with the noise of such systems.
std::vector<MarkerPair> pairs_of(const Arguments& arguments) {
  std::vector<MarkerPair> pairs;
  const std::filesystem::path folder = arguments.data / "real";
  if (arguments.data.empty() || !std::filesystem::is_directory(folder)) {
    for (const char* family : {"video", "depth"}) pairs.push_back(made_pair("walk", 30, family));
    return pairs;
  }
  const auto half_of = [&](const std::string& pair, const std::string& half) {
    return read_take(folder / (pair + "." + half + ".trc")).take;
  };
  for (const char* pair :
       {"video-regular_FULL", "video-regular_HEAVY", "video-regular_LITE", "video-60fps_01_FULL",
        "video-60fps_01_HEAVY", "video-60fps_01_LITE", "depth-CTK", "depth-RTK"})
    pairs.push_back({half_of(pair, "reference"), half_of(pair, "noisy")});
  return pairs;
}

void experiment(const Arguments& arguments) {
  const std::vector<MarkerPair> pairs = pairs_of(arguments);
  Errors automatic, white, best;
  const auto add = [&](Errors& sum, const Errors& is, const Errors& was) {
    const auto count = static_cast<double>(pairs.size());
    sum.position += is.position / was.position / count;
    sum.velocity += is.velocity / was.velocity / count;
    sum.fast += is.fast / was.fast / count;
  };
  for (const auto& [reference, noisy] : pairs) {
    const auto errors_by = [&](const std::string& method, const OptionValues& options,
                               const CleanSettings& settings) {
      return errors_of(reference, noisy,
                       clean_take(noisy, *make_cleaner(method, options), settings).take);
    };
    const Errors was = errors_of(reference, noisy, noisy);
    add(automatic, errors_by("auto", {}, {}), was);
    CleanSettings as_white;
    as_white.noise.emplace();
    add(white, errors_by("auto", {}, as_white), was);
    Errors least{0, 1e300, 0};
    for (double cutoff_hz = 0.5; cutoff_hz < 12; cutoff_hz *= 1.25) {
      const Errors is = errors_by("butterworth", {{"cutoff_hz", cutoff_hz}}, {});
      if (is.velocity < least.velocity) least = is;
    }
    add(best, least, was);
  }
  Table table(arguments, "page_pairs.csv", "method,position,velocity,above_6_hz");
  for (const auto& [name, errors] :
       {std::pair{"auto", automatic}, {"noise taken for white", white}, {"best Butterworth", best}})
    table.add({name, figure(errors.position), figure(errors.velocity), figure(errors.fast)});
  table.close();
}

const Registration registration("page_pairs", experiment);

}  // namespace
}  // namespace kinemend::papers
