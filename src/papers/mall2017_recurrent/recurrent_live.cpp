// Converts the joints of a stream to channels of the network and the filtered channels back.
#include "papers/mall2017_recurrent/recurrent_live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "body/rotation_channels.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/representation.hpp"
#include "papers/mall2017_recurrent/live_filter_network.hpp"
#include "papers/mall2017_recurrent/recurrent_networks.hpp"

namespace kinemend {

namespace {

constexpr std::size_t turn_axes = 3;  // of a rotation vector

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
        missing_(network.channels() / turn_axes),
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

  static bool is_seen(const Frame& frame, std::size_t joint) {
    return frame.observed.empty() || frame.observed[joint] != 0;
  }

  // Holds the last seen rotation in gaps; the samples there are arbitrary.
  void hold_missing(Frame& frame) {
    for (std::size_t j = 0; j < held_.size(); ++j) {
      if (is_seen(frame, j))
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
        input.root_is_missing = !is_seen(in, known.joint) || !is_nearly_unit(input.root);
        continue;
      }
      if (!is_seen(in, known.joint)) continue;
      const Vec3 v =
          continue_within_a_turn(log(normalized(conjugate(known.reference) * q)), known.last);
      if (!std::isfinite(norm(v))) continue;
      known.last = v;
      missing_[known.track - 1] = 0;
      float* own = values_.data() + turn_axes * (known.track - 1);
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
      const Vec3 v = radians_per_degree * vector_at(result_, turn_axes * (known.track - 1));
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

}  // namespace

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

}  // namespace kinemend
