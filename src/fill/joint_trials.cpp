#include "fill/joint_trials.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend::fill {

namespace {

// First frames of spans of `length` that are observed, with a sample on either side.
std::vector<std::size_t> starts_of(std::span<const std::uint8_t> observed, std::size_t length) {
  std::vector<std::size_t> starts;
  std::size_t run = 0;
  for (std::size_t f = 0; f < observed.size(); ++f) {
    run = observed[f] ? run + 1 : 0;
    if (run >= length + 2) starts.push_back(f - length);
  }
  return starts;
}

std::vector<Span> trial_spans(const JointTrack& track, std::size_t length, std::size_t most) {
  for (; length > 0; length /= 2) {
    const std::vector<std::size_t> starts = starts_of(track.observed, length);
    if (starts.size() < std::max<std::size_t>(2, length / 2)) continue;
    const std::size_t count = std::min(most, starts.size());
    std::vector<Span> spans;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = starts[(2 * i + 1) * starts.size() / (2 * count)];
      spans.push_back({first, first + length - 1});
    }
    return spans;
  }
  return {};
}

double mean_distance(const JointTrack& track, Span span, std::span<const double> truth) {
  double sum = 0;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double* true_value = truth.data() + 3 * (f - span.first);
    sum += norm(track.at(f) - Vec3{true_value[0], true_value[1], true_value[2]});
  }
  return sum / static_cast<double>(span.length());
}

// The track up to the span's last frame.
JointTrack cut_behind(const JointTrack& track, Span span) {
  JointTrack part = track;
  part.observed.resize(span.last + 1);
  part.values.resize(3 * (span.last + 1));
  return part;
}

// The methods' errors over one span; negative for those that cannot fill it.
std::vector<double> errors_over(JointTrack& track, Span span,
                                std::span<const JointMethod* const> methods,
                                const JointContext& context) {
  const auto first = track.values.begin() + static_cast<std::ptrdiff_t>(3 * span.first);
  const std::vector<double> truth(first, first + static_cast<std::ptrdiff_t>(3 * span.length()));
  const auto mask = track.observed.begin() + static_cast<std::ptrdiff_t>(span.first);
  std::fill_n(mask, span.length(), std::uint8_t{0});
  std::vector<double> errors;
  for (const JointMethod* method : methods) {
    const bool filled = method->fill(track, span, context);
    errors.push_back(filled ? mean_distance(track, span, truth) : -1);
    std::copy(truth.begin(), truth.end(), first);
  }
  std::fill_n(mask, span.length(), std::uint8_t{1});
  return errors;
}

double mean_of_known(std::span<const double> errors) {
  double sum = 0, count = 0;
  for (const double error : errors) {
    if (error >= 0) sum += error, count += 1;
  }
  return count > 0 ? sum / count : 0;
}

// The logarithm of a method's usual error beside slerp's, between the lengths that are known.
double usual_log_error(const JointMethod& method, double length_s) {
  const auto& lengths = usual_lengths_s;
  const double clamped = std::clamp(length_s, lengths.front(), lengths.back());
  const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, clamped);
  const auto k = static_cast<std::size_t>(above - lengths.begin());
  const double t = std::log(clamped / lengths[k - 1]) / std::log(lengths[k] / lengths[k - 1]);
  return (1 - t) * std::log(method.usual_errors[k - 1]) + t * std::log(method.usual_errors[k]);
}

void rank(std::vector<Trial>& trials, double reference, double weight, double length_s) {
  constexpr double prior_trials = 6;
  for (Trial& trial : trials) {
    const double measured = std::log((trial.error + 1e-12) / (reference + 1e-12));
    trial.score = (weight * measured + prior_trials * usual_log_error(*trial.method, length_s)) /
                  (weight + prior_trials);
  }
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.score < b.score; });
}

}  // namespace

std::vector<Trial> try_methods(const JointTrack& track, std::size_t length, bool at_end,
                               std::span<const JointMethod* const> methods,
                               const JointContext& context, std::size_t most) {
  std::vector<Trial> trials;
  for (const JointMethod* method : methods) trials.push_back({method, 0, 0, 0});
  const std::vector<Span> spans = trial_spans(track, length, most);
  const auto count = static_cast<double>(spans.size());
  // Shorter gaps are easier, and tell less.
  const double longer =
      spans.empty() ? 1 : static_cast<double>(length) / static_cast<double>(spans[0].length());
  double reference = 0;
  JointTrack whole = track;
  for (const Span span : spans) {
    JointTrack part = at_end ? cut_behind(track, span) : JointTrack{};
    const std::vector<double> errors = errors_over(at_end ? part : whole, span, methods, context);
    const double usual = mean_of_known(errors);
    for (std::size_t m = 0; m < trials.size(); ++m) {
      const double error = errors[m] >= 0 ? errors[m] : usual;
      trials[m].spans += errors[m] >= 0 ? 1 : 0;
      trials[m].error += longer * error / count;
      if (methods[m]->name == "slerp") reference += longer * error / count;
    }
  }
  rank(trials, reference, count / (longer * longer),
       static_cast<double>(length) / context.frame_rate_hz);
  return trials;
}

}  // namespace kinemend::fill
