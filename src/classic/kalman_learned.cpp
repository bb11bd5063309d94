// The method `kalman-learned`: its options and its cleaner.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "classic/linear_dynamics.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

const OptionTable<KalmanLearnedOptions>& kalman_learned_table() {
  static const auto options =
      OptionTable<KalmanLearnedOptions>()
          .text(&KalmanLearnedOptions::model, "model",
                "model file made by kinemend train kalman-learned (required; none ships)")
          .text(&KalmanLearnedOptions::map, "map",
                "file that maps names in the take to names in the model")
          .flag(&KalmanLearnedOptions::smoother, "smoother",
                "use the whole take; off: past frames only")
          .number(&KalmanLearnedOptions::noise_deg, "noise_deg", "deg", 0, 45,
                  "standard deviation of the noise per channel; 0: estimated from the take")
          .flag(&KalmanLearnedOptions::fill, "fill_gaps",
                "fill gaps of joints or markers that the model knows");
  return options;
}

// A least-squares filter takes spikes for noise like any other, so the noise includes their
// squares.
std::vector<double> noise_with_spikes(const PriorWork& work) {
  const PoseMatrix& poses = work.channels.poses;
  std::vector<double> noise = work.noise;
  for (std::size_t c = 0; c < poses.channels; ++c) {
    double sum = 0;
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const std::size_t i = f * poses.channels + c;
      if (work.channels.observed[i] == 0 || work.suspect[i] == 0) continue;
      const double jump = poses.values[i] - work.fallback.values[i];
      sum += jump * jump;
    }
    noise[c] = std::sqrt(noise[c] * noise[c] + sum / static_cast<double>(poses.frames));
  }
  return noise;
}

void filter_learned(PriorWork& work, const KalmanLearnedOptions& options,
                    const LinearDynamics& learned) {
  BodyChannels& channels = work.channels;
  std::vector<double> noise = noise_with_spikes(work);
  if (options.noise_deg > 0) std::fill(noise.begin(), noise.end(), options.noise_deg);
  const LinearDynamics dynamics = at_rate(learned, channels.frame_rate_hz);
  const MeasurementFacts facts{channels.observed, noise};
  PoseMatrix filtered = channels.poses;
  if (options.smoother) {
    smooth_with_dynamics(filtered, facts, dynamics);
  } else {
    filter_with_dynamics(filtered, facts, dynamics);
  }
  release_if_crowded(work, suspect_share(work, filtered));
  channels.poses = std::move(filtered);
}

}  // namespace

std::unique_ptr<Cleaner> make_kalman_learned(const KalmanLearnedOptions& options,
                                             std::shared_ptr<const Model> model) {
  kalman_learned_table().validate(options);
  model = model_of(kalman_learned_models, options.model, std::move(model));
  const PriorHold hold = options.noise_deg > 0 ? PriorHold::nothing : PriorHold::white_noise;
  return make_prior_cleaner(model,
                            {.name = "kalman-learned",
                             .options = kalman_learned_table().values(options),
                             .map = options.map,
                             .fill = options.fill,
                             .hold = hold,
                             .filter = [options, dynamics = dynamics_of(*model)](PriorWork& work) {
                               filter_learned(work, options, dynamics);
                             }});
}

Method kalman_learned_method() {
  return {"kalman-learned",
          "Kalman smoother with a model of motion that was learned from clean clips",
          "data-driven Kalman filter of Lou & Chai 2010, section 4.2",
          kalman_learned_table().specs(),
          [](const OptionValues& values) {
            return make_kalman_learned(kalman_learned_table().parse(values));
          },
          true};
}

}  // namespace kinemend
