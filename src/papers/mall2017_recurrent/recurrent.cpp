// Defines the method `recurrent` (Mall et al. 2017): its options, its cleaner of whole takes, its
// live form, and, for `src/fill`, gaps of joints filled by EBD.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "body/representation.hpp"
#include "cleaner/live.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/fill.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "models/model_reading.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"
#include "papers/mall2017_recurrent/live_filter_network.hpp"

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
    if (model->layout != gap_model->layout)
      throw Error(ErrorKind::usage,
                  "the gap model knows another body than the model: train both on the same takes");
    networks.gaps = gap_network_of(*gap_model);
  }
  return std::make_shared<const PaperNetworks>(std::move(networks));
}

Vec3 vector_at(const std::vector<float>& values, std::size_t place) {
  return {static_cast<double>(values[place]), static_cast<double>(values[place + 1]),
          static_cast<double>(values[place + 2])};
}

class RecurrentLive final : public LiveFilter {
 public:
  RecurrentLive(const FilterNetwork& network, const BodyLayout& layout, const NameMap& names,
                const TakeView& like)
      : network_(network, like.frame_rate_hz),
        values_(network.channels()),
        result_(network.channels()),
        missing_(network.channels() / axes_of_turn),
        held_(like.owners),
        waiting_(LiveFilterNetwork::delay + 1) {
    Take still;
    still.skeleton = like.joints->skeleton;
    still.frame_rate_hz = like.frame_rate_hz;
    const BodyMatch match = match_body(layout, still, names);
    for (std::size_t n = 0; n < layout.track_count(); ++n) {
      if (match.tracks[n] < 0) continue;
      const auto joint = static_cast<std::size_t>(match.tracks[n]);
      tracks_.push_back({n, joint, match.before[n], match.after[n], layout.references[n],
                         like.tracks[joint].selected});
    }
    find_ancestors(still.skeleton, match);
  }

  std::size_t lookahead() const override { return LiveFilterNetwork::delay; }

  bool push(const Frame& in, Frame& out) override {
    Frame& frame = waiting_[pushed_++ % waiting_.size()];
    frame = in;
    hold_missing(frame);
    LiveFilterNetwork::Input input{values_, missing_, {}};
    read(frame, input);
    if (!network_.push(input, result_)) return false;
    write(out);
    return true;
  }

  bool flush(Frame& out) override {
    if (!network_.flush(result_)) return false;
    write(out);
    return true;
  }

 private:
  // A track of the model that the take contains.
  struct Known {
    std::size_t track, joint;
    Quat before, after, reference;
    bool is_selected;
    Vec3 last = {};  // its vector, radians
  };
  struct Ancestor {
    std::size_t joint;
    Quat rest;
  };

  // Joints above the root of the model's body rotate it, too.
  void find_ancestors(const Skeleton& skeleton, const BodyMatch& match) {
    const auto root = static_cast<std::size_t>(match.tracks[0]);
    for (std::int32_t j = skeleton.parents[root]; j >= 0;
         j = skeleton.parents[static_cast<std::size_t>(j)])
      ancestors_.push_back(
          {static_cast<std::size_t>(j), skeleton.rest_rotations[static_cast<std::size_t>(j)]});
    std::reverse(ancestors_.begin(), ancestors_.end());
    Quat at_rest;
    for (const Ancestor& ancestor : ancestors_) at_rest = at_rest * ancestor.rest;
    unturned_ = conjugate(match.upright * at_rest);
  }

  // Holds the last seen rotation in gaps; the samples there are arbitrary.
  void hold_missing(Frame& frame) {
    for (std::size_t j = 0; j < held_.size(); ++j) {
      if (frame.is_observed(j))
        held_[j] = frame.rotations[j];
      else
        frame.rotations[j] = held_[j];
    }
  }

  void read(const Frame& in, LiveFilterNetwork::Input& input) {
    std::fill(missing_.begin(), missing_.end(), std::uint8_t{1});
    for (Known& known : tracks_) {
      const Quat q = known.before * in.rotations[known.joint] * known.after;
      if (known.track == 0) {
        input.root = root_of(in, q);
        input.root_is_missing = !in.is_observed(known.joint) || !is_nearly_unit(input.root);
        continue;
      }
      if (!in.is_observed(known.joint)) continue;
      const Vec3 v =
          continue_within_a_turn(log(normalized(conjugate(known.reference) * q)), known.last);
      if (!std::isfinite(norm(v))) continue;
      known.last = v;
      missing_[known.track - 1] = 0;
      float* own = values_.data() + axes_of_turn * (known.track - 1);
      own[0] = static_cast<float>(degrees_per_radian * v.x);
      own[1] = static_cast<float>(degrees_per_radian * v.y);
      own[2] = static_cast<float>(degrees_per_radian * v.z);
    }
  }

  Quat root_of(const Frame& in, Quat q) const {
    if (ancestors_.empty()) return q;
    Quat above;
    for (const Ancestor& ancestor : ancestors_)
      above = above * ancestor.rest * in.rotations[ancestor.joint];
    return above * unturned_ * q;
  }

  void write(Frame& out) {
    out = waiting_[given_++ % waiting_.size()];
    for (const Known& known : tracks_) {
      if (known.track == 0 || !known.is_selected) continue;
      const Vec3 v = radians_per_degree * vector_at(result_, axes_of_turn * (known.track - 1));
      Quat& local = out.rotations[known.joint];
      local = align_hemisphere(
          normalized(conjugate(known.before) * (known.reference * exp(v)) * conjugate(known.after)),
          local);
    }
  }

  LiveFilterNetwork network_;
  std::vector<Known> tracks_;
  std::vector<Ancestor> ancestors_;
  Quat unturned_;
  std::vector<float> values_, result_;
  std::vector<std::uint8_t> missing_;
  std::vector<Quat> held_;      // J, last seen
  std::vector<Frame> waiting_;  // a ring of input frames with gaps held
  std::size_t pushed_ = 0, given_ = 0;
};

// A filter network of a model on takes like this one, at its own rate. Known joints are filtered;
// the root, positions, and unknown joints are passed through. The skeleton is matched by its rest
// pose. `network` and its model must outlive the filter. Errors: `ErrorKind::usage` for markers,
// another rate, a network without a filter, and as of `match_body`.
std::unique_ptr<LiveFilter> make_recurrent_live(const FilterNetwork& network,
                                                const BodyLayout& layout, const NameMap& names,
                                                const TakeView& like) {
  if (like.joints == nullptr)
    throw Error(ErrorKind::usage, "recurrent cleans joints, and this is a take of markers");
  if (!has_rate_of(network, like.frame_rate_hz)) {
    throw Error(ErrorKind::usage,
                fmt::format("the network filters {:g} Hz, live too, and this take has {:g}",
                            network.rate_hz, like.frame_rate_hz));
  }
  return std::make_unique<RecurrentLive>(network, layout, names, like);
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

namespace {

// Chosen by hand, not swept.
constexpr double most_within = 0.98;  // a few of the samples may be spikes

// Bridges all gaps: the body's frame needs a root in every frame, and rotation vectors the shortest
// path.
Take bridged_take(const Take& clip) {
  Take whole = clip;
  const TakeView view = view_of(clip);
  for (std::size_t n = 0; n < view.tracks.size(); ++n) {
    if (observed_of(view.tracks[n]).empty()) continue;
    if (view.tracks[n].space == Space::rotation)
      set_track(whole, n, rotation_piece(view, n).samples);
    else
      set_track(whole, n, position_pieces(view, n).front().samples);
  }
  return whole;
}

// Whether a joint turns farther from the model's mean than its channels can express.
bool turns_too_far(const BodyChannels& channels, std::size_t part) {
  const double limit = degrees_per_radian * tangent_limit_rad;
  std::size_t seen = 0, far = 0;
  for (std::size_t f = 0; f < channels.poses.frames; ++f) {
    const auto row = channels.poses.row(f);
    if (channels.observed[f * channels.poses.channels + 3 * part] == 0) continue;
    ++seen;
    if (norm(Vec3{row[3 * part], row[3 * part + 1], row[3 * part + 2]}) > limit) ++far;
  }
  return static_cast<double>(far) > (1 - most_within) * static_cast<double>(seen);
}

LearnedFilling fill_by_network(const FilterNetwork& network, const BodyLayout& layout,
                               const NameMap& names, const Take& clip) {
  LearnedFilling filling{clip.rotations, {}};
  filling.left_out.assign(clip.joint_count(), "the model does not know them");
  if (!has_rate_of(network, clip.frame_rate_hz)) {
    filling.left_out.assign(clip.joint_count(),
                            fmt::format("the network fills takes of {:g} Hz, and this one has {:g}",
                                        network.rate_hz, clip.frame_rate_hz));
    return filling;
  }
  const BodyMatch match = match_body(layout, clip, names);
  const Take guide = bridged_take(clip);
  BodyChannels channels = encode_body(clip, layout, match, encode_body(guide, layout, match));
  std::vector<std::uint8_t> chosen(layout.track_count() + 1, 0);
  for (std::size_t part = 0; part < layout.track_count(); ++part) {
    if (match.tracks[part] < 0) continue;
    std::string& reason = filling.left_out[static_cast<std::size_t>(match.tracks[part])];
    reason = part == 0 ? "the network sees how the root turns, and does not fill it" : "";
    if (part > 0 && turns_too_far(channels, part))
      reason = "they turn farther than the model can say";
    chosen[part] = reason.empty() ? 1 : 0;
  }
  channels.poses = filled_by_network(network, layout, channels);
  Take filled = guide;
  decode_body(channels, layout, match, filled, chosen);
  filling.rotations = std::move(filled.rotations);
  return filling;
}

}  // namespace

LearnedFill make_recurrent_fill(const RecurrentFillOptions& options,
                                std::shared_ptr<const Model> model) {
  model = model_of(recurrent_models, options.model, std::move(model));
  auto network = std::make_shared<const FilterNetwork>(gap_network_of(*model));
  return [network, model, names = name_map_at(options.map)](const Take& clip) {
    return fill_by_network(*network, model->layout, names, clip);
  };
}

}  // namespace kinemend
