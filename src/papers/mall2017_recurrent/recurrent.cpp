// The method `recurrent` (Mall et al. 2017): its options, its cleaner of whole takes, and its live
// form.
#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "cleaner/live.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "models/model_reading.hpp"
#include "papers/mall2017_recurrent/entries.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"
#include "papers/mall2017_recurrent/gap_network.hpp"
#include "papers/mall2017_recurrent/live_filter_network.hpp"
#include "papers/mall2017_recurrent/recurrent_live.hpp"
#include "papers/mall2017_recurrent/recurrent_networks.hpp"

namespace kinemend {

namespace {

const OptionTable<RecurrentOptions>& recurrent_table() {
  static const auto options =
      OptionTable<RecurrentOptions>()
          .text(&RecurrentOptions::model, "model",
                "model file made by kinemend-train paper; empty: the model that ships")
          .text(&RecurrentOptions::map, "map",
                "file that maps names in the take to names in the model")
          .flag(&RecurrentOptions::fill, "fill_gaps", "fill gaps of joints that the model knows")
          .text(&RecurrentOptions::gap_model, "gap_model",
                "model file of a network (EBD) that fills gaps before a filter network (EBF) runs")
          .flag(&RecurrentOptions::live, "live",
                "live form of a filter network (EBF): looks 15 frames ahead");
  return options;
}

// The networks of the paper that clean a take together.
struct PaperNetworks {
  FilterNetwork filter;
  std::optional<FilterNetwork> gaps;
};

// Fills unmeasured samples of joints by the network. The root, the place and joints that were never
// seen keep the bridges of `auto`.
void fill_before_filter(const FilterNetwork& network, const BodyLayout& layout, PriorWork& work) {
  PoseMatrix& poses = work.channels.poses;
  const PoseMatrix filled = filled_by_network(network, layout, work.channels);
  for (std::size_t part = 1; part < layout.track_count(); ++part) {
    const auto is_seen = [&](std::size_t frame) {
      return work.channels.observed[frame * poses.channels + 3 * part] != 0;
    };
    bool any = false;
    for (std::size_t f = 0; f < poses.frames && !any; ++f) any = is_seen(f);
    for (std::size_t f = 0; f < poses.frames && any; ++f) {
      for (std::size_t c = 3 * part; c < 3 * part + 3 && !is_seen(f); ++c)
        poses(f, c) = filled(f, c);
    }
  }
}

// The reason why a take's rate does not fit the network; empty if it does.
std::string wrong_rate(const FilterNetwork& network, double frame_rate_hz) {
  if (has_rate_of(network, frame_rate_hz)) return {};
  return fmt::format("the network filters takes of {:g} Hz only, and this one has {:g}",
                     network.rate_hz, frame_rate_hz);
}

// Filters the measured joints by a network of the paper. The root is left to `auto`, and so is a
// take at another rate, since the network's filters are fixed numbers of frames.
void filter_as_in_the_paper(PriorWork& work, const PaperNetworks& networks,
                            const BodyLayout& layout) {
  const FilterNetwork& network = networks.filter;
  PoseMatrix& poses = work.channels.poses;
  const std::size_t parts = poses.channels / 3;
  if (std::string reason = wrong_rate(network, work.channels.frame_rate_hz); !reason.empty()) {
    poses = work.fallback;
    return add_fall_back(work, std::move(reason), std::vector<double>(parts, 1.0));
  }
  for (std::size_t i = 0; i < poses.values.size(); ++i) {
    const bool is_measured = work.channels.observed[i] != 0 && work.suspect[i] == 0;
    if (!is_measured) poses.values[i] = work.fallback.values[i];
  }
  if (networks.gaps) fill_before_filter(*networks.gaps, layout, work);
  const std::vector<float> values = filtered(network, filter_take_of(work.channels, layout));
  poses = work.fallback;
  put_filtered(values, poses);
  work.rejected = work.suspect;
}

std::shared_ptr<const PaperNetworks> networks_of(const std::shared_ptr<const Model>& model,
                                                 const std::shared_ptr<const Model>& gap_model) {
  PaperNetworks networks{filter_network_of(*model), {}};
  if (networks.filter.inputs.has_masks)
    throw Error(ErrorKind::usage,
                "this model of the method recurrent fills gaps and cleans nothing: kinemend fill "
                "--method recurrent --model, or the gap model beside one that filters");
  if (gap_model) {
    if (!are_same(model->layout, gap_model->layout))
      throw Error(ErrorKind::usage,
                  "the gap model knows another body than the model: train both on the same takes");
    networks.gaps = gap_network_of(*gap_model);
  }
  return std::make_shared<const PaperNetworks>(std::move(networks));
}

constexpr const char* live_needs =
    "recurrent runs live in its live form (--live), 15 frames behind; without it, auto sees the "
    "whole take first";

class LiveRecurrent final : public Cleaner {
 public:
  LiveRecurrent(const RecurrentOptions& options, std::shared_ptr<const Model> model)
      : options_(options),
        model_(std::move(model)),
        names_(name_map_at(options.map)),
        network_(filter_network_of(*model_)) {
    LiveFilterNetwork::check(network_);
  }

  std::string_view name() const override { return "recurrent"; }
  OptionValues options() const override { return recurrent_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    return clean_as_live(*this, take, sink, progress);
  }
  // A stream at another rate is rejected when it begins.
  LiveSupport live_support(double) const override { return {}; }
  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    return make_recurrent_live(network_, model_->layout, names_, like);
  }

 private:
  RecurrentOptions options_;
  std::shared_ptr<const Model> model_;
  NameMap names_;
  FilterNetwork network_;
};

std::unique_ptr<Cleaner> make_live(const RecurrentOptions& options,
                                   const std::shared_ptr<const Model>& model, bool has_gap_model) {
  if (has_gap_model)
    throw Error(ErrorKind::usage,
                "live, gaps are held or bridged: a gap model needs the whole take");
  return std::make_unique<LiveRecurrent>(options, model);
}

}  // namespace

std::unique_ptr<Cleaner> make_recurrent(const RecurrentOptions& options,
                                        std::shared_ptr<const Model> model,
                                        std::shared_ptr<const Model> gap_model) {
  recurrent_table().validate(options);
  model = model_of(recurrent_models, options.model, std::move(model));
  if (!options.gap_model.empty())
    gap_model = model_of(recurrent_models, options.gap_model, std::move(gap_model));
  if (options.live) return make_live(options, model, gap_model != nullptr);
  const auto networks = networks_of(model, gap_model);
  return make_prior_cleaner(
      model,
      {.name = "recurrent",
       .options = recurrent_table().values(options),
       .map = options.map,
       .fill = options.fill,
       .filter = [networks, model](
                     PriorWork& work) { filter_as_in_the_paper(work, *networks, model->layout); },
       .why_not_live = live_needs,
       .why_not_at = [networks](double rate_hz) { return wrong_rate(networks->filter, rate_hz); }});
}

Method recurrent_method() {
  return {
      "recurrent",
      "neural network that predicts a filter for each joint and frame",
      "Mall et al. 2017",
      recurrent_table().specs(),
      [](const OptionValues& values) { return make_recurrent(recurrent_table().parse(values)); },
      true};
}

}  // namespace kinemend
