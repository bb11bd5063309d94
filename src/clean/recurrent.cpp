#include <algorithm>
#include <utility>
#include <vector>

#include "clean/method_list.hpp"
#include "clean/prior_cleaning.hpp"
#include "clean/prior_fall_backs.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "priors/recurrent_filter.hpp"

namespace kinemend {

namespace {

const OptionTable<RecurrentOptions>& table() {
  static const auto options =
      OptionTable<RecurrentOptions>()
          .text(&RecurrentOptions::model, "model",
                "model file, made by kinemend-train; empty: the one that ships")
          .text(&RecurrentOptions::map, "map", "file of names in the take for the model's")
          .flag(&RecurrentOptions::fill, "fill_gaps", "fills gaps of what the model knows");
  return options;
}

void filter(PriorWork& work, const RecurrentNetwork& network, const BodyLayout& layout) {
  const std::vector<std::uint8_t>& observed = work.channels.observed;
  std::vector<std::uint8_t> missing = work.suspect;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (observed[i] == 0) missing[i] = 1;
  }
  std::vector<double> shares;
  work.channels.poses = guarded_recurrent_filter(
      network, layout, {work.channels.poses, work.fallback, missing, work.channels.frame_rate_hz},
      &shares);
  for (double& share : shares) share = 1 - share;
  add_fall_back(work, "on a trial of this take the network does not better auto",
                std::move(shares));
  work.rejected = work.suspect;
}

}  // namespace

std::unique_ptr<Cleaner> make_recurrent(const RecurrentOptions& options,
                                        std::shared_ptr<const Model> model) {
  table().validate(options);
  model = model_for("recurrent", options.model, std::move(model));
  auto network = std::make_shared<const RecurrentNetwork>(recurrent_network_of(*model));
  return make_prior_cleaner(model, options.map, options.fill, [network, model](PriorWork& work) {
    filter(work, *network, model->layout);
  });
}

Method recurrent_method() {
  return {"recurrent",
          "a network trained on damaged motion corrects what auto makes of the take",
          "after Mall et al. 2017",
          table().specs(),
          [](const OptionValues& values) { return make_recurrent(table().parse(values)); },
          true};
}

}  // namespace kinemend
