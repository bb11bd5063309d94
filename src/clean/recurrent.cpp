#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "clean/method_list.hpp"
#include "clean/prior_cleaning.hpp"
#include "clean/prior_fall_backs.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "priors/filter_network.hpp"
#include "priors/recurrent_filter.hpp"

namespace kinemend {

namespace {

const OptionTable<RecurrentOptions>& recurrent_table() {
  static const auto options =
      OptionTable<RecurrentOptions>()
          .text(&RecurrentOptions::model, "model",
                "model file, made by kinemend-train; empty: the one that ships")
          .text(&RecurrentOptions::map, "map", "file of names in the take for the model's")
          .flag(&RecurrentOptions::fill, "fill_gaps", "fills gaps of what the model knows");
  return options;
}

void filter_recurrent(PriorWork& work, const RecurrentNetwork& network, const BodyLayout& layout) {
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

// A network of the paper filters the joints as they were measured; the root is left to `auto`, and
// so is a take at another rate, since its filters are frames.
void filter_as_in_the_paper(PriorWork& work, const FilterNetwork& network,
                            const BodyLayout& layout) {
  constexpr double same_rate = 0.01;
  PoseMatrix& poses = work.channels.poses;
  const std::size_t parts = poses.channels / 3;
  if (std::abs(work.channels.frame_rate_hz / network.rate_hz - 1) > same_rate) {
    poses = work.fallback;
    return add_fall_back(work,
                         fmt::format("the network filters takes of {:g} Hz only", network.rate_hz),
                         std::vector<double>(parts, 1.0));
  }
  for (std::size_t i = 0; i < poses.values.size(); ++i) {
    const bool is_measured = work.channels.observed[i] != 0 && work.suspect[i] == 0;
    if (!is_measured) poses.values[i] = work.fallback.values[i];
  }
  const std::vector<float> values = filtered(network, filter_take_of(work.channels, layout));
  poses = work.fallback;
  put_filtered(values, poses);
  work.rejected = work.suspect;
}

PriorFilter filter_of(const std::shared_ptr<const Model>& model) {
  if (!is_filter_network(*model)) {
    auto network = std::make_shared<const RecurrentNetwork>(recurrent_network_of(*model));
    return [network, model](PriorWork& work) { filter_recurrent(work, *network, model->layout); };
  }
  auto network = std::make_shared<const FilterNetwork>(filter_network_of(*model));
  if (network->inputs.has_masks)
    throw Error(ErrorKind::usage,
                "this model of the method recurrent fills gaps and cleans nothing");
  return
      [network, model](PriorWork& work) { filter_as_in_the_paper(work, *network, model->layout); };
}

}  // namespace

std::unique_ptr<Cleaner> make_recurrent(const RecurrentOptions& options,
                                        std::shared_ptr<const Model> model) {
  recurrent_table().validate(options);
  model = model_for("recurrent", options.model, std::move(model));
  return make_prior_cleaner(model, options.map, options.fill, PriorHold::noise, filter_of(model));
}

Method recurrent_method() {
  return {
      "recurrent",
      "a network trained on damaged motion corrects what auto makes of the take",
      "after Mall et al. 2017",
      recurrent_table().specs(),
      [](const OptionValues& values) { return make_recurrent(recurrent_table().parse(values)); },
      true};
}

}  // namespace kinemend
