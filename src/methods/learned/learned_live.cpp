// Converts the samples of a stream to channels of the network and the cleaned channels back. Runs
// the network at each step and mixes the due frames.
#include "methods/learned/learned_live.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "body/representation.hpp"
#include "kinemend/error.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/learned/motion_channels.hpp"
#include "methods/learned/noise_floor.hpp"

namespace kinemend {

namespace {

// Converts a known joint's rotation to the axes of the model's body.
struct KnownTurn {
  Quat before, after, reference;
};

// The chart of any other joint: its rotation smoothed over the past, and the sum of the turns of
// that reference.
struct LiveChart {
  Quat reference;
  Vec3 path;  // radians
};

struct StreamedTrack {
  std::size_t place = 0;               // index among the frame's rotations or positions
  std::optional<std::size_t> owner{};  // index of its observed mark; none: always observed
  bool turns = true;
  std::optional<KnownTurn> known{};
  bool has_begun = false;
  Quat held{};
  Vec3 last{};    // of a known joint, radians
  Vec3 origin{};  // of positions
  LiveChart chart{};
};

std::optional<BodyMatch> match_of(const BodyLayout& layout, const NameMap& names,
                                  const TakeView& like) {
  if (like.joints == nullptr || layout.kind != BodyKind::joints) return std::nullopt;
  Take still;
  still.skeleton = like.joints->skeleton;
  still.frame_rate_hz = like.frame_rate_hz;
  try {
    return match_body(layout, still, names);
  } catch (const Error&) {
    if (!names.empty()) throw;
    return std::nullopt;
  }
}

// Watches whether the poses of joints that the model knows by name are like those it has learned:
// compares their mean over the last seconds, as `read_body` does for a take.
class LivePoses {
 public:
  LivePoses(const MotionNetwork& network, std::vector<std::int32_t> slots, double frame_rate_hz)
      : network_(network),
        slots_(std::move(slots)),
        means_(slots_.size()),
        follow_(1 - portable::exp(-1 / (memory_s * frame_rate_hz))) {}

  void see(std::span<const float> values, std::span<const std::uint8_t> missing) {
    // Averages all frames until the memory is full.
    const double follow = std::max(follow_, 1 / static_cast<double>(++frames_));
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < slots_.size(); ++c) {
      if (slots_[c] < 0) continue;
      if (missing[c] == 0) means_[c] += follow * (static_cast<double>(values[c]) - means_[c]);
      const auto slot = static_cast<std::size_t>(slots_[c]);
      const double distance = (means_[c] - static_cast<double>(network_.mean[slot])) /
                              static_cast<double>(network_.deviation[slot]);
      sum += distance * distance;
      count += 1;
    }
    fit_ = count > 0 && sum <= most_distance * most_distance * count;
  }
  bool fit() const { return fit_; }

 private:
  // A few seconds of a known rig are farther from the learned mean than a whole take: single poses
  // are one deviation away. The nearest other rig is 1.8 away.
  static constexpr double most_distance = 1.5;
  // Chosen by hand: a pose held for a second or two must not decide for the whole body.
  static constexpr double memory_s = 10;

  const MotionNetwork& network_;
  std::vector<std::int32_t> slots_;
  std::vector<double> means_;
  double follow_;
  std::size_t frames_ = 0;
  bool fit_ = false;
};

class LearnedLive final : public LiveFilter {
 public:
  LearnedLive(const MotionNetwork& network, const BodyLayout& layout, const NameMap& names,
              const TakeView& like)
      : follow_(1 - portable::exp(-1 / (follow_s * like.frame_rate_hz))),
        degrees_per_unit_(degrees_per_unit(like, Space::position)) {
    const std::size_t rotations = like.joints != nullptr ? like.owners : 0;
    std::vector<std::int32_t> slots;
    std::vector<std::uint8_t> is_position;
    for (std::size_t n = 0; n < like.tracks.size(); ++n) {
      if (!like.tracks[n].selected) continue;
      StreamedTrack track;
      track.turns = n < rotations;
      track.place = track.turns ? n : n - rotations;
      if (track.turns || rotations == 0) track.owner = track.place;
      tracks_.push_back(track);
      slots.insert(slots.end(), 3, -1);
      is_position.insert(is_position.end(), 3, track.turns ? 0 : 1);
    }
    if (const auto match = match_of(layout, names, like)) {
      // The root is skipped: its rotation relative to the heading needs the whole take.
      for (std::size_t part = 1; part < layout.track_count(); ++part) {
        for (std::size_t n = 0; n < tracks_.size(); ++n) {
          if (!tracks_[n].turns ||
              static_cast<std::int32_t>(tracks_[n].place) != match->tracks[part])
            continue;
          tracks_[n].known =
              KnownTurn{match->before[part], match->after[part], layout.references[part]};
          for (std::size_t axis = 0; axis < 3; ++axis)
            slots[3 * n + axis] = static_cast<std::int32_t>(3 * part + axis);
        }
      }
    }
    values_.resize(slots.size());
    result_.resize(slots.size());
    missing_.resize(slots.size());
    filter_ =
        std::make_unique<LiveMotionFilter>(network, like.frame_rate_hz, slots,
                                           std::move(is_position), expects_slow_noise(like.source));
    std::vector<std::uint8_t> counts;
    for (const StreamedTrack& track : tracks_) {
      of_body_.push_back(track.known ? 1 : 0);
      counts.push_back(track.turns || rotations == 0 ? 1 : 0);
    }
    if (!expects_slow_noise(like.source)) floor_.emplace(like.frame_rate_hz, std::move(counts));
    poses_.emplace(network, std::move(slots), like.frame_rate_hz);
    waiting_.resize(filter_->ahead() + 1);
  }

  std::size_t lookahead() const override { return filter_->ahead(); }

  bool push(const Frame& in, Frame& out) override {
    Waiting& waiting = waiting_[pushed_++ % waiting_.size()];
    waiting.frame = in;
    waiting.charts.resize(tracks_.size());
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      StreamedTrack& track = tracks_[n];
      const bool is_seen = is_seen_in(in, track);
      const std::optional<Vec3> vector = track.turns
                                             ? turned(track, in.rotations[track.place], is_seen)
                                             : moved(track, in.positions[track.place], is_seen);
      put(n, vector);
      if (track.turns) waiting.frame.rotations[track.place] = track.held;
      waiting.charts[n] = track.chart;
    }
    poses_->see(values_, missing_);
    filter_->show_body(poses_->fit());
    if (!filter_->push(values_, missing_, result_)) return false;
    write(out);
    return true;
  }

  bool flush(Frame& out) override {
    if (!filter_->flush(result_)) return false;
    write(out);
    return true;
  }

 private:
  // Time constant with which the chart of an unknown joint follows it. Chosen by hand, not swept.
  static constexpr double follow_s = 0.05;

  struct Waiting {
    Frame frame;
    std::vector<LiveChart> charts;
  };

  static bool is_seen_in(const Frame& frame, const StreamedTrack& track) {
    return !track.owner || frame.is_observed(*track.owner);
  }

  void put(std::size_t n, const std::optional<Vec3>& vector) {
    for (std::size_t axis = 0; axis < 3; ++axis) missing_[3 * n + axis] = vector ? 0 : 1;
    if (!vector) return;
    float* const own = values_.data() + 3 * n;
    own[0] = static_cast<float>(vector->x);
    own[1] = static_cast<float>(vector->y);
    own[2] = static_cast<float>(vector->z);
  }

  // A sample as a vector in degrees; none if it is not seen, or not a rotation.
  std::optional<Vec3> turned(StreamedTrack& track, Quat q, bool is_seen) const {
    if (!is_seen || !is_nearly_unit(q)) return std::nullopt;
    q = normalized(q);
    track.held = track.has_begun ? align_hemisphere(q, track.held) : q;
    if (track.known) {
      const Quat shown = track.known->before * q * track.known->after;
      track.last =
          continue_within_a_turn(log(conjugate(track.known->reference) * shown), track.last);
      track.has_begun = true;
      return degrees_per_radian * track.last;
    }
    LiveChart& chart = track.chart;
    if (!std::exchange(track.has_begun, true)) chart.reference = q;
    const Vec3 turn = follow_ * log(conjugate(chart.reference) * q);
    chart.reference = normalized(chart.reference * exp(turn));
    chart.path = chart.path + turn;
    return degrees_per_radian * (chart.path + log(conjugate(chart.reference) * q));
  }

  std::optional<Vec3> moved(StreamedTrack& track, Vec3 p, bool is_seen) const {
    if (!is_seen || !std::isfinite(norm(p))) return std::nullopt;
    if (!std::exchange(track.has_begun, true)) track.origin = p;
    return degrees_per_unit_ * (p - track.origin);
  }

  void write(Frame& out) {
    if (floor_) floor_->bound(filter_->samples_given(), poses_->fit(), of_body_, result_);
    const Waiting& waiting = waiting_[given_++ % waiting_.size()];
    out = waiting.frame;
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      const StreamedTrack& track = tracks_[n];
      const Vec3 v{result_[3 * n], result_[3 * n + 1], result_[3 * n + 2]};
      if (!track.has_begun) continue;
      if (!track.turns) {
        if (is_seen_in(out, track))
          out.positions[track.place] = track.origin + (1 / degrees_per_unit_) * v;
        continue;
      }
      Quat& local = out.rotations[track.place];
      const Vec3 turn = radians_per_degree * v;
      const Quat cleaned =
          track.known ? conjugate(track.known->before) * (track.known->reference * exp(turn)) *
                            conjugate(track.known->after)
                      : waiting.charts[n].reference * exp(turn - waiting.charts[n].path);
      local = align_hemisphere(normalized(cleaned), local);
    }
  }

  double follow_, degrees_per_unit_;
  std::vector<StreamedTrack> tracks_;
  std::vector<float> values_, result_;
  std::vector<std::uint8_t> missing_;
  std::unique_ptr<LiveMotionFilter> filter_;
  std::vector<std::uint8_t> of_body_;  // one per track
  std::optional<LivePoses> poses_;
  std::optional<LiveNoiseFloor> floor_;
  std::vector<Waiting> waiting_;  // a ring of input frames with gaps held
  std::size_t pushed_ = 0, given_ = 0;
};

}  // namespace

std::unique_ptr<LiveFilter> make_learned_live(const MotionNetwork& network,
                                              const BodyLayout& layout, const NameMap& names,
                                              const TakeView& like) {
  return std::make_unique<LearnedLive>(network, layout, names, like);
}

LiveMotionFilter::LiveMotionFilter(const MotionNetwork& network, double frame_rate_hz,
                                   const std::vector<std::int32_t>& slots,
                                   std::vector<std::uint8_t> is_position, bool expects_slow_noise)
    : frame_rate_hz_(frame_rate_hz),
      steps_(frame_rate_hz, std::move(is_position), expects_slow_noise),
      network_(network, slots),
      levels_(bank_levels * slots.size()) {}

bool LiveMotionFilter::push(std::span<const float> values, std::span<const std::uint8_t> missing,
                            std::span<float> out) {
  steps_.push(values, missing);
  while (take_step()) continue;
  if (steps_.frames() <= given_ + ahead()) return false;
  give(out);
  return true;
}

bool LiveMotionFilter::flush(std::span<float> out) {
  steps_.end();
  if (given_ >= steps_.frames()) return false;
  const std::size_t wanted = step_before(given_) + 1;
  while (known_ <= wanted && take_step()) continue;
  give(out);
  return true;
}

std::size_t LiveMotionFilter::step_before(std::size_t frame) const {
  return static_cast<std::size_t>(static_cast<double>(frame) * motion_steps_hz / frame_rate_hz_);
}

bool LiveMotionFilter::take_step() {
  if (!steps_.next_step(step_)) return false;
  MotionMixes& mixes = mixes_[known_++ % mixes_.size()];
  mix(network_.run(step_, steps_.is_alive()), step_, mixes);
  // Channels that have not moved are unchanged.
  for (std::size_t c = 0; c < steps_.channels(); ++c) {
    if (steps_.is_alive()[c] != 0) continue;
    float* const levels = mixes.levels.data() + c * motion_levels;
    std::fill_n(levels, motion_levels, 0.0F);
    levels[0] = 1;
    mixes.corrections[c] = 0;
  }
  return true;
}

void LiveMotionFilter::give(std::span<float> out) {
  const std::size_t frame = given_++, channels = steps_.channels(), before = step_before(frame);
  const auto share = static_cast<float>(
      static_cast<double>(frame) * motion_steps_hz / frame_rate_hz_ - static_cast<double>(before));
  const MotionMixes &one = mixes_[before % mixes_.size()],
                    &other = mixes_[(before + 1) % mixes_.size()];
  const auto between = [&](const std::vector<float>& from, const std::vector<float>& to,
                           std::size_t i) { return from[i] + share * (to[i] - from[i]); };
  steps_.levels(frame, levels_);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t at = c * motion_levels;
    // Without measured noise the last smoother is the sample itself.
    float value = between(one.corrections, other.corrections, c) +
                  between(one.levels, other.levels, at + bank_levels) * levels_[c];
    for (std::size_t n = 0; n < bank_levels; ++n)
      value += between(one.levels, other.levels, at + n) * levels_[n * channels + c];
    out[c] = value;
  }
}

}  // namespace kinemend
