// Implements `kinemend/take.hpp`: checks the rules of a take, slices its frames, makes takes of
// markers, finds units by name, numbers frames, and removes the calibration pose while work is done
// on the motion.
#include "motion/take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

namespace {

template <class T>
std::vector<T> rows(const std::vector<T>& values, std::size_t first, std::size_t last,
                    std::size_t width) {
  if (values.empty()) return {};
  return {values.begin() + static_cast<std::ptrdiff_t>(first * width),
          values.begin() + static_cast<std::ptrdiff_t>(last * width)};
}

void check_mask(const std::vector<std::uint8_t>& mask, std::size_t samples, const char* what) {
  if (!mask.empty()) check_length(mask.size(), samples, what);
}

void check_translated_joints(const Take& take) {
  const auto& translated = take.translated_joints;
  for (std::size_t i = 0; i < translated.size(); ++i) {
    const bool ascending = i == 0 || translated[i] > translated[i - 1];
    const bool is_joint =
        translated[i] >= 1 && translated[i] < static_cast<std::int32_t>(take.joint_count());
    if (!is_joint || !ascending) {
      throw Error(ErrorKind::usage, "translated joints are not ascending joint numbers above 0");
    }
  }
}

void check_joint_samples(const Take& take, std::size_t frame) {
  if (!is_finite(take.root_position(frame)))
    throw Error(ErrorKind::usage, fmt::format("frame {}: root position is not finite", frame));
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    if (std::fabs(norm(take.rotation(frame, j)) - 1) <= 1e-6) continue;
    throw Error(ErrorKind::usage,
                fmt::format("frame {}, joint \"{}\": rotation is not a unit quaternion", frame,
                            take.skeleton.names[j]));
  }
}

void validate_joints(const Take& take) {
  take.skeleton.validate();
  check_frame_rate(take.frame_rate_hz);
  const std::size_t frames = take.frame_count();
  check_length(take.positions.size(), frames * take.point_count(), "positions");
  check_length(take.rotations.size(), frames * take.joint_count(), "rotations");
  check_mask(take.observed, frames * take.joint_count(), "observed mask");
  check_mask(take.observed_positions, frames * take.point_count(), "mask of observed positions");
  check_translated_joints(take);
  for (std::size_t f = 0; f < frames; ++f) check_joint_samples(take, f);
  if (!std::all_of(take.positions.begin(), take.positions.end(), is_finite))
    throw Error(ErrorKind::usage, "a joint translation is not finite");
}

void validate_markers(const Take& take) {
  check_frame_rate(take.frame_rate_hz);
  const std::size_t markers = take.marker_count(), samples = take.frame_count() * markers;
  check_length(take.positions.size(), samples, "positions");
  check_length(take.observed.size(), samples, "observed mask");
  if (!take.residuals.empty()) check_length(take.residuals.size(), samples, "residuals");
  check_mask(take.is_position, markers, "kinds of points");
  for (std::size_t i = 0; i < samples; ++i) {
    if (take.observed[i] == 0 || is_finite(take.positions[i])) continue;
    throw Error(ErrorKind::usage,
                fmt::format("frame {}, marker {} \"{}\": the position is not finite", i / markers,
                            i % markers, take.names[i % markers]));
  }
}

}  // namespace

std::int32_t Take::find(std::string_view name) const noexcept {
  const auto index_of = [&](auto matches) {
    const auto found = std::find_if(names.begin(), names.end(), matches);
    return found == names.end() ? -1 : static_cast<std::int32_t>(found - names.begin());
  };
  const std::int32_t whole = index_of([&](const std::string& known) { return known == name; });
  if (whole >= 0) return whole;
  return index_of([&](const std::string& known) { return without_subject(known) == name; });
}

std::size_t Take::position_count() const noexcept {
  std::size_t count = 0;
  for (std::size_t m = 0; m < marker_count(); ++m) count += holds_positions(m) ? 1 : 0;
  return count;
}

void Take::validate() const {
  if (has_joints()) {
    validate_joints(*this);
  } else {
    validate_markers(*this);
  }
}

Take slice(const Take& take, std::size_t first, std::size_t last) {
  const std::size_t points = take.point_count();
  const std::size_t owners = take.has_joints() ? take.joint_count() : points;
  Take result;
  result.skeleton = take.skeleton;
  result.names = take.names;
  result.frame_rate_hz = take.frame_rate_hz;
  result.metres_per_unit = take.metres_per_unit;
  result.unit = take.unit;
  result.first_frame = take.first_frame + static_cast<std::int64_t>(first);
  result.rotations = rows(take.rotations, first, last, take.joint_count());
  result.positions = rows(take.positions, first, last, points);
  result.translated_joints = take.translated_joints;
  result.observed = rows(take.observed, first, last, owners);
  result.observed_positions = rows(take.observed_positions, first, last, points);
  result.residuals = rows(take.residuals, first, last, points);
  result.is_position = take.is_position;
  result.events = take.events;
  result.source.name = take.source.name;
  if (!take.has_joints()) result.source.format = take.source.format;
  return result;
}

std::string_view without_subject(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Take make_marker_take(std::vector<std::string> names, std::size_t frames, double frame_rate_hz) {
  Take clip;
  clip.names = std::move(names);
  clip.frame_rate_hz = frame_rate_hz;
  const std::size_t samples = frames * clip.names.size();
  clip.positions.resize(samples);
  clip.observed.resize(samples, 0);
  clip.is_position.assign(clip.names.size(), 1);
  return clip;
}

Take positions_only(const Take& clip) {
  std::vector<std::size_t> kept;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) kept.push_back(m);
  }
  Take result = clip;
  const auto keep = [&](auto& values, std::size_t rows) {
    if (values.empty()) return;
    auto out = values.begin();
    for (std::size_t row = 0; row < rows; ++row) {
      for (const std::size_t m : kept) *out++ = values[row * clip.marker_count() + m];
    }
    values.erase(out, values.end());
  };
  keep(result.names, 1);
  keep(result.is_position, 1);
  keep(result.positions, clip.frame_count());
  keep(result.observed, clip.frame_count());
  keep(result.residuals, clip.frame_count());
  return result;
}

double metres_per_unit(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 18> known{{
      {"m", 1},
      {"metre", 1},
      {"metres", 1},
      {"meter", 1},
      {"meters", 1},
      {"dm", 0.1},
      {"cm", 0.01},
      {"centimeters", 0.01},
      {"mm", 0.001},
      {"millimetres", 0.001},
      {"millimeters", 0.001},
      {"um", 1e-6},
      {"in", 0.0254},
      {"inch", 0.0254},
      {"inches", 0.0254},
      {"ft", 0.3048},
      {"foot", 0.3048},
      {"feet", 0.3048},
  }};
  const std::string lower = lower_case(unit);
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const auto& entry) { return entry.first == lower; });
  return found == known.end() ? 0 : found->second;
}

std::string unit_name(double metres) {
  for (const char* const name : {"m", "cm", "mm", "in"}) {
    const double known = metres_per_unit(name);
    if (std::fabs(metres - known) <= 1e-9 * known) return name;
  }
  return "";
}

namespace {

constexpr std::string_view first_frame_fact = "first frame";

}  // namespace

void note_first_frame(Take& clip, double number) {
  // Larger whole numbers are not exact; a round number below 2^53, by definition.
  constexpr double most = 9e15;
  if (number == 1 || number != std::floor(number) || !(std::fabs(number) < most)) return;
  clip.source.facts.push_back({std::string(first_frame_fact), fmt::format("{:.0f}", number)});
}

std::int64_t first_frame_number(const Take& take) {
  if (!take.has_joints()) return take.first_frame;
  std::int64_t number = 1;
  for (const SourceFact& fact : take.source.facts) {
    if (fact.name == first_frame_fact)
      std::from_chars(fact.text.data(), fact.text.data() + fact.text.size(), number);
  }
  return number;
}

std::int64_t frame_number(std::size_t frame, std::int64_t first) {
  return static_cast<std::int64_t>(frame) + first;
}

namespace {

template <class T>
void take_front(std::vector<T>& values, std::size_t count) {
  if (!values.empty())
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

Take take_front(Take& clip, std::size_t frames) {
  const std::size_t joints = clip.joint_count(), points = clip.point_count();
  Take front = slice(clip, 0, frames);
  take_front(clip.rotations, frames * joints);
  take_front(clip.positions, frames * points);
  take_front(clip.observed, frames * joints);
  take_front(clip.observed_positions, frames * points);
  return front;
}

template <class T>
void put_front(std::vector<T>& values, const std::vector<T>& front) {
  values.insert(values.begin(), front.begin(), front.end());
}

// Puts the mask of the front frames back. An empty mask means that all samples are observed.
void put_mask(std::vector<std::uint8_t>& mask, std::size_t samples,
              const std::vector<std::uint8_t>& front, std::size_t front_samples) {
  if (mask.empty() && std::find(front.begin(), front.end(), 0) == front.end()) return;
  if (mask.empty()) mask.assign(samples, 1);
  if (front.empty()) {
    mask.insert(mask.begin(), front_samples, 1);
  } else {
    put_front(mask, front);
  }
}

void put_front(Take& clip, const Take& front) {
  const std::size_t tracks = 1 + clip.translated_joints.size();
  put_mask(clip.observed, clip.rotations.size(), front.observed, front.rotations.size());
  put_mask(clip.observed_positions, clip.frame_count() * tracks, front.observed_positions,
           front.frame_count() * tracks);
  put_front(clip.positions, front.positions);
  put_front(clip.rotations, front.rotations);
}

struct Turn {
  double mean = 0, largest = 0;  // over joints
};

Turn turn_between(const Take& clip, std::size_t first, std::size_t second) {
  Turn turn;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const double angle = angle_between(clip.rotation(first, j), clip.rotation(second, j));
    turn.mean += angle / static_cast<double>(clip.joint_count());
    turn.largest = std::max(turn.largest, angle);
  }
  return turn;
}

// The pose of a calibration frame: roots may be turned, joints are nearly at rest. The T-pose
// of the CMU files turns hips and feet by up to 21 degrees, 3.5 on average.
bool is_near_rest(const Take& clip, std::size_t frame) {
  // Chosen by hand, above the angles in these files; not swept.
  constexpr double largest = 25 * radians_per_degree, largest_mean = 6 * radians_per_degree;
  double sum = 0;
  std::size_t joints = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (clip.skeleton.parents[j] < 0) continue;
    const double angle = angle_between(clip.rotation(frame, j), Quat{});
    if (angle > largest) return false;
    sum += angle;
    ++joints;
  }
  return sum <= largest_mean * static_cast<double>(joints);
}

// 90 % quantile of the joints' mean turn per step, from `first` on.
double usual_step(const Take& clip, std::size_t first, std::size_t last) {
  std::vector<double> steps;
  for (std::size_t f = first; f + 1 < last; ++f) steps.push_back(turn_between(clip, f, f + 1).mean);
  return of_rank(steps, (steps.size() - 1) * 9 / 10);
}

}  // namespace

void on_motion(Take& clip, std::size_t frames, const std::function<void(Take&)>& work) {
  if (frames == 0) return work(clip);
  const Take front = take_front(clip, frames);
  try {
    work(clip);
  } catch (...) {
    put_front(clip, front);
    throw;
  }
  put_front(clip, front);
}

const Take& frames_from(const Take& clip, std::size_t first, std::optional<Take>& sliced) {
  return first == 0 ? clip : sliced.emplace(slice(clip, first, clip.frame_count()));
}

std::size_t leading_calibration_frames(const Take& clip) {
  // Limits for the frames of a calibration pose and for the compared frames; the least jump to the
  // motion, and its least ratio to the jumps within the motion. Chosen by hand, not swept.
  constexpr std::size_t most_frames = 10, compared_frames = 240;
  constexpr double clear_jump = 25 * radians_per_degree, clear_ratio = 1.5;
  const std::size_t frames = std::min(clip.frame_count(), compared_frames);
  std::size_t count = 0;
  while (count < most_frames && count < frames && is_near_rest(clip, count)) ++count;
  if (count == 0 || count == most_frames || count + 2 > frames) return 0;
  // Motion that starts from the rest pose accelerates over several frames; after a calibration pose
  // one step is an outlier. Means over joints and a percentile of the steps make this robust to
  // noise.
  const Turn jump = turn_between(clip, count - 1, count);
  const double next = turn_between(clip, count, count + 1).mean;
  const double usual = usual_step(clip, count, frames);
  const bool stands_out =
      jump.largest > clear_jump && jump.mean > clear_ratio * std::max(next, usual);
  return stands_out ? count : 0;
}

bool joint_moves(const Take& clip, std::size_t joint) {
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    if (clip.rotation(f, joint) != clip.rotation(0, joint)) return true;
  }
  return false;
}

std::vector<std::size_t> moving_joints(const Take& clip) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (joint_moves(clip, j)) joints.push_back(j);
  }
  return joints;
}

std::optional<std::size_t> point_of_joint(const Take& take, std::size_t joint) {
  if (joint == 0) return 0;
  const auto& translated = take.translated_joints;
  const auto found =
      std::lower_bound(translated.begin(), translated.end(), static_cast<std::int32_t>(joint));
  if (found == translated.end() || *found != static_cast<std::int32_t>(joint)) return std::nullopt;
  return static_cast<std::size_t>(found - translated.begin()) + 1;
}

std::vector<Quat> rotations_of(const Take& take, std::size_t joint, std::size_t first) {
  std::vector<Quat> rotations;
  rotations.reserve(take.frame_count() - first);
  for (std::size_t f = first; f < take.frame_count(); ++f)
    rotations.push_back(take.rotation(f, joint));
  return rotations;
}

}  // namespace kinemend
