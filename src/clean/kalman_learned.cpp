#include <algorithm>
#include <utility>

#include "clean/method_list.hpp"
#include "clean/prior_cleaning.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/model.hpp"
#include "priors/linear_dynamics.hpp"
#include "priors/linear_smoother.hpp"

namespace kinemend {

namespace {

const OptionTable<KalmanLearnedOptions>& table() {
  static const auto options =
      OptionTable<KalmanLearnedOptions>()
          .text(&KalmanLearnedOptions::model, "model",
                "model file, made by kinemend train kalman-learned")
          .text(&KalmanLearnedOptions::map, "map", "file of names in the take for the model's")
          .flag(&KalmanLearnedOptions::smoother, "smoother",
                "uses the whole take; off: the past only")
          .number(&KalmanLearnedOptions::noise_deg, "noise_deg", "deg", 0, 45,
                  "noise of a sample per channel; 0: estimated")
          .flag(&KalmanLearnedOptions::fill, "fill_gaps", "fills gaps of what the model knows");
  return options;
}

class KalmanLearned final : public Cleaner {
 public:
  KalmanLearned(const KalmanLearnedOptions& options, std::shared_ptr<const Model> model)
      : options_(options),
        names_(name_map_at(options.map)),
        model_(std::move(model)),
        dynamics_(dynamics_of(*model_)) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    return clean_with_prior(clip, selection, model_->layout, names_, options_.fill,
                            [this](PriorWork& work) { filter(work); });
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    return clean_with_prior(clip, selection, model_->layout, names_, options_.fill,
                            [this](PriorWork& work) { filter(work); });
  }

 private:
  void filter(PriorWork& work) const {
    BodyChannels& channels = work.channels;
    std::vector<double> noise = work.noise;
    if (options_.noise_deg > 0) std::fill(noise.begin(), noise.end(), options_.noise_deg);
    const LinearDynamics dynamics = at_rate(dynamics_, channels.frame_rate_hz);
    const MeasurementFacts facts{channels.observed, noise};
    if (options_.smoother) {
      smooth_with_dynamics(channels.poses, facts, dynamics);
    } else {
      filter_with_dynamics(channels.poses, facts, dynamics);
    }
  }

  KalmanLearnedOptions options_;
  NameMap names_;
  std::shared_ptr<const Model> model_;
  LinearDynamics dynamics_;
};

}  // namespace

std::unique_ptr<Cleaner> make_kalman_learned(const KalmanLearnedOptions& options,
                                             std::shared_ptr<const Model> model) {
  table().validate(options);
  if (!model) model = model_for("kalman-learned", options.model);
  return std::make_unique<KalmanLearned>(options, std::move(model));
}

Method kalman_learned_method() {
  return {"kalman-learned",
          "how poses follow each other, learned from clips, as Kalman smoother",
          "data-driven Kalman filter of Lou & Chai 2010, section 4.2",
          table().specs(),
          [](const OptionValues& values) { return make_kalman_learned(table().parse(values)); },
          true};
}

}  // namespace kinemend
