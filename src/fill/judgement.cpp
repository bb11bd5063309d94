// Chooses the trial spans, runs the candidates on them, scales their errors by how much the
// candidates differ in the gap, and weights the candidates by them.
#include "fill/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable.hpp"

namespace kinemend::fill {

namespace {

// The number of trials near the gap and elsewhere: chosen on the takes that docs/measured/fill.md
// names.
constexpr std::size_t most_near = 6, most_elsewhere = 3, least_places = 3;
// The evidence on either side of a gap; for speed.
constexpr double evidence_s = 60;
constexpr std::size_t evidence_lengths = 10;  // gap lengths, if that is more

// Returns the frames at which a span of `length` usable frames may start.
std::vector<std::size_t> starts_of(std::span<const std::uint8_t> usable, std::size_t first,
                                   std::size_t length) {
  std::vector<std::size_t> starts;
  std::size_t run = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    run = usable[i] ? run + 1 : 0;
    if (run >= length + 2) starts.push_back(first + i - length);
  }
  return starts;
}

std::vector<std::size_t> nearest(const std::vector<std::size_t>& starts, FrameSpan gap,
                                 std::size_t length, std::size_t most) {
  const std::size_t apart = std::max<std::size_t>(1, length / 2);
  std::vector<std::pair<std::size_t, std::size_t>> found;  // distance, start
  const auto behind = std::upper_bound(starts.begin(), starts.end(), gap.last);
  std::size_t count = 0;
  for (auto s = behind; s != starts.end() && count < most; ++s) {
    if (count > 0 && *s < found.back().second + apart) continue;
    found.emplace_back(*s - gap.last, *s);
    ++count;
  }
  count = 0;
  for (auto s = behind; s != starts.begin() && count < most;) {
    --s;
    if (count > 0 && *s + apart > found.back().second) continue;
    found.emplace_back(gap.first - (*s + length - 1), *s);
    ++count;
  }
  std::sort(found.begin(), found.end());
  if (found.size() > most) found.resize(most);
  std::vector<std::size_t> chosen;
  chosen.reserve(found.size());
  for (const auto& [distance, start] : found) chosen.push_back(start);
  return chosen;
}

// Returns the number of disjoint trials to which the spans amount.
double independent(std::vector<FrameSpan> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const FrameSpan& a, const FrameSpan& b) { return a.first < b.first; });
  std::size_t covered = 0, end = 0;
  for (const FrameSpan span : spans) {
    covered += span.last + 1 - std::min(span.last + 1, std::max(span.first, end));
    end = std::max(end, span.last + 1);
  }
  return static_cast<double>(covered) / static_cast<double>(spans[0].length());
}

}  // namespace

FrameSpan evidence_around(FrameSpan gap, std::size_t frames, double frame_rate_hz) {
  const std::size_t reach =
      std::max(frames_in(evidence_s, frame_rate_hz, 1), evidence_lengths * gap.length());
  return surroundings(gap, {}, reach, frames);
}

std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap) {
  for (std::size_t length = gap.length(); length > 0; length /= 2) {
    const std::vector<std::size_t> starts = starts_of(usable, first_frame, length);
    if (starts.size() < least_places) continue;
    std::vector<std::size_t> chosen = nearest(starts, gap, length, most_near);
    for (const std::size_t start : evenly(starts, most_elsewhere)) chosen.push_back(start);
    std::vector<FrameSpan> spans;
    spans.reserve(chosen.size());
    for (const std::size_t start : chosen) spans.push_back({start, start + length - 1});
    return spans;
  }
  return {};
}

TrialRoom room_around(FrameSpan gap, std::size_t frames, double frame_rate_hz) {
  const FrameSpan evidence = evidence_around(gap, frames, frame_rate_hz);
  return {gap,
          {gap.first == 0, gap.last + 1 == frames},
          evidence,
          std::vector<std::uint8_t>(evidence.length())};
}

Trials try_out(const TrialRoom& room, const TryOn& try_on) {
  Trials trials;
  trials.at_end = room.ends.any();
  const std::vector<FrameSpan> spans = trial_places(room.usable, room.evidence.first, room.gap);
  if (spans.empty()) return trials;
  for (const FrameSpan span : spans)
    trials.products.push_back(products_of(try_on(span, frames_of(span, trial_frames))));
  trials.longer = static_cast<double>(room.gap.length()) / static_cast<double>(spans[0].length());
  trials.weight = independent(spans) / (trials.longer * trials.longer);
  return trials;
}

namespace {

// Exponents of the ratios of mean square differences, for the choice and for the expected error:
// differences of candidates from each other, and from the straight line. They and `caution` are
// regressed from artificial gaps in the takes that docs/measured/fill.md names; the bounds of the
// ratio are not swept.
constexpr double choice_exponent = 0.5;
constexpr double error_exponent = 0.5, line_exponent = 0.3;
// Few trials miss the worst case, so the expected error is raised above their root mean square.
constexpr double caution = 1.45, caution_at_end = 2;
constexpr double least_ratio = 1.0 / 16, most_ratio = 1e4;
// Shares of the squared grain, added to the spline's square error and to the differences that scale
// the expected error. Not swept.
constexpr double spline_floor = 0.01, error_floor = 0.25;

using Matrix = Eigen::MatrixXd;
using Indices = std::vector<Eigen::Index>;

template <class Accept>
Indices indices_of(std::span<const CandidateKind> kinds, const Accept& accept) {
  Indices found;
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    if (accept(kinds[c])) found.push_back(static_cast<Eigen::Index>(c));
  }
  return found;
}

Indices lines_among(std::span<const CandidateKind> kinds) {
  return indices_of(kinds, [](CandidateKind kind) { return kind == CandidateKind::line; });
}

// Returns the mean square distance of the candidates from their average with these weights.
double spread_about(const Matrix& products, const Indices& candidates,
                    const Eigen::VectorXd& weights) {
  const Eigen::VectorXd with_average = products * weights;
  const double average = weights.dot(with_average);
  double sum = 0;
  for (const Eigen::Index c : candidates) sum += products(c, c) - 2 * with_average[c] + average;
  return std::max(0.0, sum / static_cast<double>(candidates.size()));
}

double square_distance(const Matrix& products, Eigen::Index a, Eigen::Index b) {
  return std::max(0.0, products(a, a) + products(b, b) - 2 * products(a, b));
}

double mean_over(const std::vector<Matrix>& trials, const auto& value) {
  double sum = 0;
  for (const Matrix& trial : trials) sum += value(trial);
  return sum / static_cast<double>(trials.size());
}

// Returns the ratio of `difference(products)` in the gap to its mean in the trials.
double ratio_of(const Matrix& gap, const std::vector<Matrix>& trials, double floor,
                const auto& difference) {
  const double usual = mean_over(trials, difference) + floor;
  if (!(usual > 0)) return 1;
  return std::clamp((difference(gap) + floor) / usual, least_ratio, most_ratio);
}

}  // namespace

Eigen::MatrixXd products_of(const Proposals& offsets) {
  const auto count = static_cast<Eigen::Index>(offsets.size());
  const std::size_t frames = offsets.empty() ? 0 : offsets.front().size();
  Matrix rows(count, static_cast<Eigen::Index>(3 * frames));
  for (Eigen::Index c = 0; c < count; ++c) {
    for (std::size_t i = 0; i < frames; ++i) {
      const Vec3 off = offsets[static_cast<std::size_t>(c)][i];
      const auto column = static_cast<Eigen::Index>(3 * i);
      rows(c, column) = off.x, rows(c, column + 1) = off.y, rows(c, column + 2) = off.z;
    }
  }
  return rows * rows.transpose() / static_cast<double>(frames);
}

Judgement::Judgement(std::vector<CandidateKind> kinds, Eigen::MatrixXd gap, Trials trials,
                     double grain)
    : kinds_(std::move(kinds)),
      gap_(std::move(gap)),
      trials_(std::move(trials)),
      floor_(grain * grain),
      squares_(kinds_.size(), std::numeric_limits<double>::infinity()) {
  judge_models();
  for (std::size_t c = 0; c < kinds_.size(); ++c) {
    if (kinds_[c] == CandidateKind::spline || kinds_[c] == CandidateKind::curve) judge_curve(c);
  }
}

void Judgement::judge_models() {
  const Indices models =
      indices_of(kinds_, [](CandidateKind kind) { return kind == CandidateKind::model; });
  if (models.empty()) return;
  Eigen::VectorXd even = Eigen::VectorXd::Zero(gap_.rows());
  for (const Eigen::Index c : models) even[c] = 1 / static_cast<double>(models.size());
  const double ratio = ratio_of(gap_, trials_.products, floor_, [&](const Matrix& products) {
    return spread_about(products, models, even);
  });
  const double harder = portable::pow(ratio, choice_exponent);
  for (const Eigen::Index c : models) {
    squares_[static_cast<std::size_t>(c)] =
        harder * mean_over(trials_.products, [&](const Matrix& trial) { return trial(c, c); });
  }
}

void Judgement::judge_curve(std::size_t candidate) {
  const auto c = static_cast<Eigen::Index>(candidate);
  double& square = squares_[candidate];
  if (kinds_[candidate] == CandidateKind::spline) {
    square = portable::exp(mean_over(trials_.products, [&](const Matrix& trial) {
      return portable::log(trial(c, c) + spline_floor * floor_ +
                           std::numeric_limits<double>::min());
    }));
  } else {
    square = mean_over(trials_.products, [&](const Matrix& trial) { return trial(c, c); });
  }
  const Indices lines = lines_among(kinds_);
  if (lines.empty()) return;
  const double ratio = ratio_of(gap_, trials_.products, floor_, [&](const Matrix& products) {
    return square_distance(products, c, lines.front());
  });
  square *= portable::pow(ratio, choice_exponent);
}

std::vector<double> Judgement::weights(double favour) const {
  std::vector<double> squares = squares_;
  for (std::size_t c = 0; c < squares.size(); ++c) {
    if (kinds_[c] == CandidateKind::spline) squares[c] /= favour;
  }
  const double least = *std::min_element(squares.begin(), squares.end()) + floor_;
  std::vector<double> weights;
  double sum = 0;
  for (const double square : squares) {
    const double share = square + floor_ > 0 ? least / (square + floor_) : 1;
    weights.push_back(share * share);
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double Judgement::expected_error(std::span<const double> weights) const {
  const Eigen::Map<const Eigen::VectorXd> w(weights.data(),
                                            static_cast<Eigen::Index>(weights.size()));
  // A single candidate is compared with the line.
  Indices others =
      indices_of(kinds_, [](CandidateKind kind) { return kind != CandidateKind::line; });
  if (others.size() < 2) others = lines_among(kinds_);
  double harder = 1;
  if (!others.empty()) {
    const double ratio =
        ratio_of(gap_, trials_.products, error_floor * floor_,
                 [&](const Matrix& products) { return spread_about(products, others, w); });
    harder = portable::pow(ratio, error_exponent);
  }
  // A gap in which the track turns farther than in the trials is harder. A straighter one may only
  // look so because its filling misses the turn.
  if (const Indices lines = lines_among(kinds_); !lines.empty()) {
    const double ratio =
        ratio_of(gap_, trials_.products, error_floor * floor_,
                 [&](const Matrix& products) { return spread_about(products, lines, w); });
    harder *= portable::pow(std::max(1.0, ratio), line_exponent);
  }
  const double square = mean_over(
      trials_.products, [&](const Matrix& trial) { return std::max(0.0, w.dot(trial * w)); });
  return (trials_.at_end ? caution_at_end : caution) *
         std::sqrt(trials_.longer * square * harder + floor_);
}

}  // namespace kinemend::fill
