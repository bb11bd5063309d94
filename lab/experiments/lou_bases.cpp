// Figure 3 of Lou & Chai 2010, Example-based Human Motion Denoising: error of walks expressed in
// few filter bases, learned from the other walks.
#include <algorithm>
#include <cmath>

#include "kinemend/extend/body.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

constexpr std::size_t window_frames = 20;

struct Bases {
  std::shared_ptr<const Model> model;
  std::size_t channels = 0, count = 0;
  const std::vector<double>* mean = nullptr;      // L
  const std::vector<double>* patterns = nullptr;  // M x L x K
};

Bases bases_of(const std::vector<Take>& training, std::size_t most) {
  Bases bases;
  bases.model = learned("example", training,
                        {{"bases", static_cast<std::int64_t>(most)},
                         {"window_s", static_cast<double>(window_frames) / lou_rate_hz}});
  const Tensor& patterns = bases.model->tensor("bases", 3);
  bases.channels = bases.model->layout.channel_count();
  bases.count = patterns.shape[2];
  bases.patterns = &patterns.values;
  bases.mean = &bases.model->tensor("mean", 1).values;
  return bases;
}

// Sum of squared residuals of a window, over the channels of joints below the root, after 0, 1, ...
// bases.
std::vector<double> residuals(const Bases& bases, const PoseMatrix& poses, std::size_t first) {
  const std::size_t size = window_frames * bases.channels, joints = 3, place = bases.channels - 3;
  std::vector<double> left(size);
  for (std::size_t i = 0; i < size; ++i) {
    left[i] =
        poses(first + i / bases.channels, i % bases.channels) - (*bases.mean)[i % bases.channels];
  }
  std::vector<double> sums;
  for (std::size_t k = 0; k <= bases.count; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t channel = i % bases.channels;
      if (channel >= joints && channel < place) sum += left[i] * left[i];
    }
    sums.push_back(sum);
    if (k == bases.count) break;
    double weight = 0;
    for (std::size_t i = 0; i < size; ++i)
      weight += left[i] * (*bases.patterns)[i * bases.count + k];
    for (std::size_t i = 0; i < size; ++i)
      left[i] -= weight * (*bases.patterns)[i * bases.count + k];
  }
  return sums;
}

// Root mean square error per joint angle of a walk outside the bases' training, after 0, 1, ...
// bases.
std::vector<double> errors_of(const std::vector<Take>& walks, std::size_t left_out,
                              std::size_t most) {
  std::vector<Take> training;
  for (std::size_t i = 0; i < walks.size(); ++i) {
    if (i != left_out) training.push_back(walks[i]);
  }
  const Bases bases = bases_of(training, most);
  const Take test = at_lou_rate(walks[left_out]);
  const BodyLayout& layout = bases.model->layout;
  const PoseMatrix poses = encode_body(test, layout, match_body(layout, test)).poses;
  std::vector<double> sums(most + 1, 0.0);
  double count = 0;
  for (std::size_t first = 0; first + window_frames <= poses.frames; first += 5) {
    const std::vector<double> window = residuals(bases, poses, first);
    for (std::size_t k = 0; k <= most; ++k) sums[k] += window[std::min(k, window.size() - 1)];
    count += static_cast<double>(window_frames * (bases.channels - 6));
  }
  for (double& sum : sums) sum = std::sqrt(sum / count);
  return sums;
}

void figure_3(const Arguments& arguments) {
  const std::vector<std::string> names =
      arguments.quick
          ? std::vector<std::string>{"08_01", "08_02", "08_03"}
          : std::vector<std::string>{"08_01", "08_02", "08_03", "08_06", "08_07", "08_09", "08_11"};
  const std::vector<std::string> of_many = {"02_01", "05_01", "06_01", "07_01",
                                            "08_02", "16_15", "35_05", "49_01"};
  const std::size_t most = arguments.quick ? 60 : 200;
  std::vector<std::pair<std::string, std::vector<std::string>>> sets = {{"one subject", names}};
  if (!arguments.quick) sets.emplace_back("eight subjects", of_many);
  Table table(arguments, "lou_bases.csv", "walks,bases,rms_deg");
  std::vector<std::size_t> shown;
  for (const std::size_t k : {0, 1, 2, 5, 10, 20, 30, 50, 75, 100, 150, 200}) {
    if (k <= most) shown.push_back(k);
  }
  std::vector<std::string> columns;
  for (const std::size_t k : shown) columns.push_back(fmt::format("{}", k));
  const TextTable text(columns);
  for (const auto& [set, clips] : sets) {
    const std::vector<Take> walks = lou_takes(arguments, clips, "walk", 1);
    std::vector<double> mean(most + 1, 0.0);
    for (std::size_t i = 0; i < walks.size(); ++i) {
      const std::vector<double> errors = errors_of(walks, i, most);
      for (std::size_t k = 0; k <= most; ++k)
        mean[k] += errors[k] / static_cast<double>(walks.size());
    }
    std::vector<double> row;
    for (const std::size_t k : shown) row.push_back(mean[k]);
    text.add(set, row);
    for (std::size_t k = 0; k <= most; ++k)
      table.add({set, fmt::format("{}", k), fmt::format("{:.5g}", mean[k])});
  }
  fmt::print(
      "Figure 3: walks in the first bases of the other walks, window of 20 frames at 30 Hz. Root "
      "mean square,\ndegrees per joint angle, against the number of bases.\n\n");
  table.close();
}

const Registration lou_bases_entry("lou_bases", figure_3);

}  // namespace
}  // namespace kinemend::papers
