// Makes features from paths of feet, of a whole take and frame by frame.
#include "feet/contact_features.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"

namespace kinemend::feet {

// The motion of one foot at the steps, in the world.
struct FootSteps {
  std::array<std::vector<Vec3>, 2> path;  // heel, toe
  std::vector<double> levels;             // of the floor
  std::vector<Vec3> heading;              // horizontal, unit
  std::vector<double> side;               // 1 or -1, so that the other foot is on the positive side
  std::array<std::vector<float>, 2> touching;  // by thresholds; 0.5: not asked
};

namespace {

// Times in steps. Chosen by hand; the network has learned with them.
constexpr std::size_t level_reach = 120;   // on either side, over which the floor is searched
constexpr std::size_t level_spacing = 6;   // between the steps at which it is
constexpr std::size_t heading_reach = 15;  // on either side, for the mean heading of a foot
constexpr double level_quantile = 0.1;     // of heights, taken as the floor
// Scales and the limit of features. Chosen by hand; the network has learned with them.
constexpr double height_scale = 10, speed_scale = 2, place_scale = 3, most_feature = 6;
constexpr double slow_speed = 0.05;  // body heights a second, the finest resolved speed

// Returns the steps up to the last of these frames.
std::size_t steps_of(std::size_t frames, double rate_hz) {
  const double seconds = static_cast<double>(frames - 1) / rate_hz;
  return 1 + static_cast<std::size_t>(seconds * contact_rate_hz + 1e-6);
}

// The sum of weights and the mean of the frames about a step, under a hat as wide as the longer of
// a step and a frame; without lookahead, under its first half if steps are longer.
struct HatMean {
  double weight = 0;
  Vec3 mean;
};
template <class At, class IsSeen>
HatMean hat_mean(std::size_t step, double rate_hz, std::size_t frames, Lookahead lookahead,
                 const At& at, const IsSeen& is_seen) {
  const double step_frames = rate_hz / contact_rate_hz;
  const double middle = static_cast<double>(step) * step_frames;
  const double reach = std::max(1.0, step_frames);  // frames, half the width of the hat
  const double ahead = lookahead == Lookahead::none && step_frames > 1 ? 0 : reach;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(middle - reach)));
  const auto last = std::min(frames - 1, static_cast<std::size_t>(middle + ahead));
  HatMean result;
  for (std::size_t f = first; f <= last; ++f) {
    const double weight = 1 - std::fabs(static_cast<double>(f) - middle) / reach;
    if (!(weight > 0) || !is_seen(f)) continue;
    result.mean += weight * at(f);
    result.weight += weight;
  }
  if (result.weight > 0) result.mean = (1 / result.weight) * result.mean;
  return result;
}

// Places of one point at the steps.
template <class At, class IsSeen>
std::vector<Vec3> resampled(const BodyPoints& soles, std::size_t count, Lookahead lookahead,
                            const At& at, const IsSeen& is_seen) {
  std::vector<Vec3> result(count);
  std::vector<std::uint8_t> known(count);
  for (std::size_t s = 0; s < count; ++s) {
    const HatMean mean = hat_mean(s, soles.frame_rate_hz, soles.frames, lookahead, at, is_seen);
    result[s] = mean.mean;
    known[s] = mean.weight > 0 ? 1 : 0;
  }
  bridge(
      count, [&](std::size_t s) { return known[s] != 0; },
      [&](std::size_t s) -> Vec3& { return result[s]; });
  return result;
}

// The steps from which a value at step s may be taken.
struct StepRange {
  std::size_t first = 0, end = 0;
};
StepRange around(std::size_t s, std::size_t count, std::size_t reach, Lookahead lookahead) {
  if (lookahead == Lookahead::whole)
    return {s - std::min(s, reach), std::min(count, s + reach + 1)};
  return {s - std::min(s, 2 * reach), s + 1};
}

double lowest_level(const FootSteps& foot, StepRange range, Up up) {
  std::vector<double> lowest;
  for (std::size_t s = range.first; s < range.end; ++s)
    lowest.push_back(std::min(along(foot.path[0][s], up), along(foot.path[1][s], up)));
  return quantile_of(lowest, level_quantile);
}

std::vector<double> levels_of(const FootSteps& foot, Up up, Lookahead lookahead) {
  const std::size_t count = foot.path[0].size();
  std::vector<double> levels(count);
  const auto level_at = [&](std::size_t s) {
    return lowest_level(foot, around(s, count, level_reach, lookahead), up);
  };
  for (std::size_t first = 0; first < count; first += level_spacing) {
    const std::size_t end = std::min(first + level_spacing, count);
    const double level = level_at(first);
    const double next = lookahead == Lookahead::none ? level : level_at(std::min(end, count - 1));
    for (std::size_t s = first; s < end; ++s) {
      const double share = static_cast<double>(s - first) / static_cast<double>(level_spacing);
      levels[s] = (1 - share) * level + share * next;
    }
  }
  return levels;
}

// A horizontal direction, for feet that show none.
Vec3 any_heading(Up up) { return up.axis == Axis::x ? Vec3{0, 1, 0} : Vec3{1, 0, 0}; }

// Returns the direction of the sum of foot vectors over a range, or `otherwise` if it shows none.
Vec3 heading_of(Vec3 sum, StepRange range, double height, Vec3 otherwise) {
  constexpr double least = 1e-3;  // body heights: shorter is no direction
  const auto steps = static_cast<double>(range.end - range.first);
  return norm(sum) > least * height * steps ? (1 / norm(sum)) * sum : otherwise;
}

std::vector<Vec3> headings_of(const FootSteps& foot, Up up, double height, Lookahead lookahead) {
  const std::size_t count = foot.path[0].size();
  std::vector<Vec3> sums(count + 1), headings(count);
  for (std::size_t s = 0; s < count; ++s)
    sums[s + 1] = sums[s] + level_part(foot.path[1][s] - foot.path[0][s], up);
  Vec3 before = any_heading(up);
  for (std::size_t s = 0; s < count; ++s) {
    const StepRange range = around(s, count, heading_reach, lookahead);
    before = heading_of(sums[range.end] - sums[range.first], range, height, before);
    headings[s] = before;
  }
  return headings;
}

std::vector<double> sides_of(const FootSteps& foot, const FootSteps& other, Up up,
                             Lookahead lookahead) {
  const std::size_t count = foot.path[0].size();
  std::vector<double> sides(count, 1);
  double sum = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const Vec3 lateral = cross(up.direction(), foot.heading[s]);
    sum += dot(other.path[0][s] - foot.path[0][s], lateral);
    sides[s] = sum < 0 ? -1 : 1;
  }
  if (lookahead == Lookahead::whole) std::fill(sides.begin(), sides.end(), sides.back());
  return sides;
}

std::vector<float> touching_at_steps(std::span<const std::uint8_t> touching,
                                     const BodyPoints& soles, std::size_t point,
                                     std::size_t count) {
  if (touching.empty()) return std::vector<float>(count, 0.5F);
  std::vector<float> result(count);
  for (std::size_t s = 0; s < count; ++s) {
    const double at = static_cast<double>(s) * soles.frame_rate_hz / contact_rate_hz;
    const auto frame = std::min(soles.frames - 1, static_cast<std::size_t>(std::lround(at)));
    result[s] = touching[frame * soles.points + point];
  }
  return result;
}

// Writes the features of one foot.
class FeatureWriter {
 public:
  FeatureWriter(const FootSteps& own, const FootSteps* other, const std::vector<Vec3>& centres,
                Up up, double height, Lookahead lookahead)
      : own_(own),
        other_(other),
        centres_(centres),
        up_(up),
        height_(height),
        lookahead_(lookahead) {}

  void write(std::size_t step, std::span<float> row) {
    row_ = row;
    next_ = 0;
    step_ = step;
    ahead_ = own_.heading[step];
    lateral_ = own_.side[step] * cross(up_.direction(), ahead_);
    const Vec3 heel = own_.path[0][step], toe = own_.path[1][step];
    put_height(toe, own_);
    put_height(heel, own_);
    put_speed(own_.path[1]);
    put_speed(own_.path[0]);
    put_speed(centres_);
    put_place(centres_[step] - 0.5 * (heel + toe));
    if (other_ != nullptr) {
      put_place(other_->path[1][step] - toe);
      put_place(other_->path[0][step] - heel);
      put_speed(other_->path[1]);
      put_speed(other_->path[0]);
      put_height(other_->path[1][step], *other_);
      put_height(other_->path[0][step], *other_);
    } else {
      constexpr std::size_t features_of_other = 14;
      for (std::size_t i = 0; i < features_of_other; ++i) put(0);
    }
    for (const std::size_t reach : {std::size_t{2}, std::size_t{8}}) {
      put_travel(own_.path[1], reach);
      put_travel(own_.path[0], reach);
    }
    put_travel(centres_, 8);
    put(own_.touching[0][step]);
    put(own_.touching[1][step]);
    put(1);
  }

 private:
  void put(double value) {
    row_[next_++] = static_cast<float>(std::clamp(value, -most_feature, most_feature));
  }
  void put_height(Vec3 place, const FootSteps& foot) {
    put(height_scale * (along(place, up_) - foot.levels[step_]) / height_);
  }
  void put_along_axes(Vec3 v, double scale) {
    put(scale * dot(v, ahead_) / height_);
    put(scale * dot(v, lateral_) / height_);
    put(scale * along(v, up_) / height_);
  }
  void put_place(Vec3 v) { put_along_axes(v, place_scale); }
  void put_speed(const std::vector<Vec3>& path) {
    const std::size_t before = step_ - std::min<std::size_t>(step_, 1);
    put_along_axes(contact_rate_hz * (path[step_] - path[before]), speed_scale);
  }
  // The horizontal speed over a time, which does not depend on the axes.
  void put_travel(const std::vector<Vec3>& path, std::size_t reach) {
    const StepRange range = around(step_, path.size(), reach, lookahead_);
    const auto steps = static_cast<double>(std::max<std::size_t>(range.end - range.first - 1, 1));
    const Vec3 way = level_part(path[range.end - 1] - path[range.first], up_);
    put(portable::log1p(contact_rate_hz * norm(way) / steps / height_ / slow_speed));
  }

  const FootSteps& own_;
  const FootSteps* other_;
  const std::vector<Vec3>& centres_;
  Up up_;
  double height_;
  Lookahead lookahead_;
  std::span<float> row_;
  std::size_t next_ = 0, step_ = 0;
  Vec3 ahead_, lateral_;
};

}  // namespace

ContactSteps contact_steps(const BodyPoints& soles, Up up, Lookahead lookahead,
                           std::span<const std::uint8_t> touching) {
  ContactSteps steps;
  steps.feet = soles.points / 2;
  if (soles.frames == 0 || steps.feet == 0) return steps;
  steps.count = steps_of(soles.frames, soles.frame_rate_hz);
  steps.features.resize(steps.feet * steps.count * contact_features);
  const std::vector<Vec3> centres = resampled(
      soles, steps.count, lookahead, [&](std::size_t f) { return soles.centres[f]; },
      [](std::size_t) { return true; });
  std::vector<FootSteps> feet(steps.feet);
  for_each_index(steps.feet, [&](std::size_t l) {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t point = 2 * l + part;
      feet[l].path[part] = resampled(
          soles, steps.count, lookahead, [&](std::size_t f) { return soles.at(f, point); },
          [&](std::size_t f) { return soles.is_observed(f, point); });
      feet[l].touching[part] = touching_at_steps(touching, soles, point, steps.count);
    }
    feet[l].levels = levels_of(feet[l], up, lookahead);
    feet[l].heading = headings_of(feet[l], up, soles.height, lookahead);
  });
  for_each_index(steps.feet, [&](std::size_t l) {
    const FootSteps* const other = (l ^ 1) < steps.feet ? &feet[l ^ 1] : nullptr;
    feet[l].side = other != nullptr ? sides_of(feet[l], *other, up, lookahead)
                                    : std::vector<double>(steps.count, 1);
    FeatureWriter writer(feet[l], other, centres, up, soles.height, lookahead);
    for (std::size_t s = 0; s < steps.count; ++s)
      writer.write(s, std::span(steps.features)
                          .subspan((l * steps.count + s) * contact_features, contact_features));
  });
  return steps;
}

struct LiveContactSteps::Body {
  // The last frames, from which steps are made.
  struct Frame {
    std::vector<Vec3> parts;
    Vec3 centre;
  };

  double rate_hz = 0, height = 0;
  Up up;
  std::size_t frames = 0, steps = 0;  // pushed, made
  std::size_t first_frame = 0;        // of those kept
  std::deque<Frame> kept;
  std::vector<FootSteps> feet;
  std::vector<Vec3> centres;
  std::vector<double> ways_to_other;

  template <class At>
  Vec3 place_at(std::size_t step, const At& at) const {
    return hat_mean(
               step, rate_hz, frames, Lookahead::none,
               [&](std::size_t f) { return at(kept[f - first_frame]); },
               [&](std::size_t f) { return f >= first_frame; })
        .mean;
  }

  // Drops steps on which no later one depends.
  void make_room() {
    constexpr std::size_t most = 1024, needed = 2 * level_reach + level_spacing;
    if (centres.size() < most) return;
    const auto drop = [&](auto& values) {
      values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(needed));
    };
    drop(centres);
    for (FootSteps& foot : feet) {
      for (std::vector<Vec3>& path : foot.path) drop(path);
      for (std::vector<float>& touching : foot.touching) drop(touching);
      drop(foot.levels);
      drop(foot.heading);
      drop(foot.side);
    }
  }

  void add_step() {
    make_room();
    centres.push_back(place_at(steps, [](const Frame& frame) { return frame.centre; }));
    const std::size_t count = centres.size(), now = count - 1;
    for (std::size_t l = 0; l < feet.size(); ++l) {
      FootSteps& foot = feet[l];
      for (std::size_t part = 0; part < 2; ++part) {
        foot.path[part].push_back(
            place_at(steps, [&](const Frame& frame) { return frame.parts[2 * l + part]; }));
        foot.touching[part].push_back(0.5F);
      }
      const bool is_new = steps % level_spacing == 0;
      foot.levels.push_back(
          is_new ? lowest_level(foot, around(now, count, level_reach, Lookahead::none), up)
                 : foot.levels.back());
      const StepRange range = around(now, count, heading_reach, Lookahead::none);
      Vec3 sum;
      for (std::size_t s = range.first; s < range.end; ++s)
        sum += level_part(foot.path[1][s] - foot.path[0][s], up);
      foot.heading.push_back(heading_of(
          sum, range, height, foot.heading.empty() ? any_heading(up) : foot.heading.back()));
    }
    for (std::size_t l = 0; l < feet.size(); ++l) {
      if ((l ^ 1) < feet.size()) {
        const Vec3 way = feet[l ^ 1].path[0][now] - feet[l].path[0][now];
        ways_to_other[l] += dot(way, cross(up.direction(), feet[l].heading[now]));
      }
      feet[l].side.push_back(ways_to_other[l] < 0 ? -1 : 1);
    }
    ++steps;
  }
};

LiveContactSteps::LiveContactSteps(std::size_t feet, double frame_rate_hz, double height, Up up)
    : body_(std::make_unique<Body>()) {
  body_->rate_hz = frame_rate_hz;
  body_->height = height;
  body_->up = up;
  body_->feet.resize(feet);
  body_->ways_to_other.resize(feet);
}
LiveContactSteps::~LiveContactSteps() = default;
LiveContactSteps::LiveContactSteps(LiveContactSteps&&) noexcept = default;

void LiveContactSteps::push(std::span<const Vec3> parts, Vec3 centre) {
  Body& body = *body_;
  body.kept.push_back({{parts.begin(), parts.end()}, centre});
  ++body.frames;
  // The next step lies within a step of the last frame.
  const std::size_t needed =
      2 + static_cast<std::size_t>(2 * std::max(1.0, body.rate_hz / contact_rate_hz));
  for (; body.kept.size() > needed; ++body.first_frame) body.kept.pop_front();
}

bool LiveContactSteps::next_step(std::span<float> rows) {
  Body& body = *body_;
  if (body.frames == 0 || body.steps >= steps_of(body.frames, body.rate_hz)) return false;
  body.add_step();
  const std::size_t now = body.centres.size() - 1;
  for (std::size_t l = 0; l < body.feet.size(); ++l) {
    const FootSteps* const other = (l ^ 1) < body.feet.size() ? &body.feet[l ^ 1] : nullptr;
    FeatureWriter(body.feet[l], other, body.centres, body.up, body.height, Lookahead::none)
        .write(now, rows.subspan(l * contact_features, contact_features));
  }
  return true;
}

}  // namespace kinemend::feet
