// Runs the method `learned` on a stream of frames. Steps of the network are made as frames come in.
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

// Lookahead of the live form: 14 frames at 120 Hz, and at most that up to 390 Hz; see
// docs/methods/learned.md.
constexpr double ahead_s = 0.117;
constexpr std::size_t most_ahead = 14;
// The number of steps in the training samples.
constexpr std::size_t strength_steps = 128;

std::size_t frames_to_next_step(double frame_rate_hz) {
  return static_cast<std::size_t>(std::lround(frame_rate_hz / motion_steps_hz));
}

}  // namespace

std::size_t live_motion_ahead(double frame_rate_hz) {
  const auto wanted = static_cast<std::size_t>(std::lround(ahead_s * frame_rate_hz));
  // Mixing a frame needs the steps before and after it.
  return std::max(std::min(wanted, most_ahead), frames_to_next_step(frame_rate_hz) + 1);
}

LiveMotionSteps::LiveMotionSteps(double frame_rate_hz, std::vector<std::uint8_t> is_position,
                                 bool expects_slow_noise)
    : frame_rate_hz_(frame_rate_hz),
      is_position_(std::move(is_position)),
      expects_slow_noise_(expects_slow_noise),
      bank_(frame_rate_hz),
      hats_(frame_rate_hz),
      ahead_(live_motion_ahead(frame_rate_hz)),
      step_ahead_(ahead_ - std::min(ahead_, frames_to_next_step(frame_rate_hz))),
      missed_(channels()),
      origins_(channels()),
      kept_squares_(strength_steps * channels() * motion_bands),
      kept_slowest_(strength_steps * channels()),
      sums_(channels()) {
  const auto margin = static_cast<std::size_t>(hats_.margin());
  past_ = bank_.reach() + margin + ahead_ + 1;
  behind_ = bank_.reach() + margin + 1;
  rows_.channels = channels();
  rows_.values.resize((3 * past_ + behind_) * channels());
  missing_.resize(3 * past_ * channels());
  strengths_.is_alive.resize(channels());
}

void LiveMotionSteps::push(std::span<const float> values, std::span<const std::uint8_t> missing) {
  if (frames_ == 0) {
    for (std::size_t c = 0; c < channels(); ++c) {
      origins_[c] = missing.empty() || missing[c] == 0 ? values[c] : 0;
      for (std::size_t row = 0; row < past_; ++row)
        rows_.values[row * channels() + c] = origins_[c];
    }
    std::fill_n(missing_.begin(), past_ * channels(), std::uint8_t{0});
  }
  make_room();
  const std::size_t row = row_index(frames_);
  ++frames_;
  float* const own = rows_.values.data() + row * channels();
  std::uint8_t* const marks = missing_.data() + row * channels();
  for (std::size_t c = 0; c < channels(); ++c) {
    marks[c] = missing.empty() ? 0 : missing[c];
    if (marks[c] != 0) {
      own[c] = *(own + c - channels());
      ++missed_[c];
      continue;
    }
    own[c] = values[c];
    if (missed_[c] > 0 && missed_[c] + 1 == frames_) {
      begin_with(values[c], c);
    } else if (missed_[c] > 0) {
      bridge(c);
    }
    missed_[c] = 0;
  }
}

// Moves the rows that are still needed to the front.
void LiveMotionSteps::make_room() {
  if (row_index(frames_) < 3 * past_) return;
  const std::size_t kept = past_, from = row_index(frames_) - kept;
  const auto at = [&](std::size_t row) { return static_cast<std::ptrdiff_t>(row * channels()); };
  std::copy(rows_.values.begin() + at(from), rows_.values.begin() + at(from + kept),
            rows_.values.begin());
  std::copy(missing_.begin() + at(from), missing_.begin() + at(from + kept), missing_.begin());
  dropped_ += from;
}

// A channel that is first seen is taken to have stood still before.
void LiveMotionSteps::begin_with(float value, std::size_t channel) {
  for (std::size_t row = 0; row < row_index(frames_); ++row)
    rows_.values[row * channels() + channel] = value;
  origins_[channel] = value;
}

// The newest frame has ended a gap: frames of the gap that are not yet out are interpolated
// linearly.
void LiveMotionSteps::bridge(std::size_t channel) {
  const std::size_t open = std::min(missed_[channel], ahead_);
  float* const last = row_of(frames_ - 1) + channel;
  const auto width = static_cast<std::ptrdiff_t>(channels());
  const float from = *(last - static_cast<std::ptrdiff_t>(open + 1) * width);
  for (std::size_t i = 1; i <= open; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(open + 1);
    *(last - static_cast<std::ptrdiff_t>(open + 1 - i) * width) = from + share * (*last - from);
  }
}

void LiveMotionSteps::extend() {
  if (extended_at_ == frames_) return;
  extended_at_ = frames_;
  bank_.extend(row_of(frames_ - 1), static_cast<std::ptrdiff_t>(channels()), channels(), past_,
               behind_);
}

std::span<const float> LiveMotionSteps::frame(std::size_t frame) const {
  return std::span(rows_.values).subspan(row_index(frame) * channels(), channels());
}

void LiveMotionSteps::levels(std::size_t frame, std::span<float> result) {
  extend();
  for (std::size_t level = 0; level < bank_levels; ++level)
    bank_.level(rows_, level, static_cast<std::ptrdiff_t>(row_index(frame)), 1,
                result.subspan(level * channels(), channels()));
}

float LiveMotionSteps::missing_share(std::size_t frame, std::size_t channel) const {
  const std::size_t half = frames_to_next_step(frame_rate_hz_ / 2);
  const std::size_t at = row_index(frame), last = std::min(at + half, row_index(frames_ - 1));
  float missing = 0;
  for (std::size_t row = at - half; row <= last; ++row)
    missing += missing_[row * channels() + channel] != 0 ? 1.0F : 0.0F;
  return missing / static_cast<float>(last + 1 - (at - half));
}

void LiveMotionSteps::keep_strengths(std::ptrdiff_t row) {
  const std::size_t squares = channels() * motion_bands, place = steps_ % strength_steps;
  const std::span<float> own = std::span(kept_squares_).subspan(place * squares, squares),
                         slowest = std::span(kept_slowest_).subspan(place * channels(), channels());
  if (steps_ >= strength_steps) sums_.add(own, slowest, -1);
  std::copy(block_.squares.begin(), block_.squares.end(), own.begin());
  for (std::size_t c = 0; c < channels(); ++c)
    slowest[c] = block_.level_at(bank_levels - 1, row, c) - origins_[c];
  sums_.add(own, slowest, 1);
  sums_.strengths(is_position_, expects_slow_noise_, strengths_);
}

bool LiveMotionSteps::next_step(MotionSteps& step) {
  if (frames_ == 0) return false;
  const std::size_t wanted = frame_of_motion_step(steps_, frame_rate_hz_);
  if (!is_ended_ && wanted + step_ahead_ >= frames_) return false;
  const std::size_t frame = std::min(wanted, frames_ - 1);
  if (is_ended_ && steps_ >= motion_step_count(frames_, frame_rate_hz_)) return false;
  extend();
  const auto row = static_cast<std::ptrdiff_t>(row_index(frame));
  read_bands(bank_, rows_, hats_, {&row, 1}, block_);
  keep_strengths(row);
  step.first = steps_++;
  step.resize(channels(), 1);
  step.take_features = strengths_.features;
  for (std::size_t c = 0; c < channels(); ++c) {
    const StepRow own = step_row(step, c, 0);
    write_step(block_, 0, row, c, frame_rate_hz_, strengths_, missing_share(frame, c),
               {block_.level_at(0, row, c), 0, 0, false}, own);
    own.changes[bank_levels] = own.changes[0];
  }
  return true;
}

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
