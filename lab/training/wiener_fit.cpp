// Sums up the moments of windows, finds the basis, draws windows, and fits the mixture to them.
#include "lab/training/wiener_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "lab/training/mixture_fit.hpp"
#include "methods/prior/window_bases.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rotation vectors jump by a full turn when a joint passes half of one. Chosen by hand, not swept.
constexpr double jump_deg = 90;
constexpr double least_variance = 1e-6;  // square degrees

bool jumps(const PoseMatrix& poses, std::size_t first, std::size_t last) {
  for (std::size_t f = first + 1; f < last; ++f) {
    for (std::size_t c = 0; c < poses.channels; ++c) {
      if (std::abs(poses(f, c) - poses(f - 1, c)) > jump_deg) return true;
    }
  }
  return false;
}

void write_matrix(const MatrixXd& matrix, StageWriter& writer) {
  writer.value(matrix.rows());
  writer.value(matrix.cols());
  writer.values(std::span<const double>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

MatrixXd read_matrix(StageReader& reader) {
  const auto rows = reader.value<Index>(), columns = reader.value<Index>();
  const std::vector<double> values = reader.values<double>();
  const auto count = static_cast<Index>(values.size());
  reader.expect(rows >= 0 && columns >= 0 &&
                (rows == 0 ? count == 0 : count % rows == 0 && count / rows == columns));
  return Eigen::Map<const MatrixXd>(values.data(), rows, columns);
}

VectorXd read_vector(StageReader& reader) {
  const MatrixXd matrix = read_matrix(reader);
  reader.expect(matrix.cols() == 1);
  return matrix.col(0);
}

std::string stored_mixture(const MixtureState& state) {
  StageWriter writer;
  writer.value(state.rounds);
  writer.value(state.components.size());
  for (const WienerPrior::Component& component : state.components) {
    writer.value(component.weight);
    write_matrix(component.mean, writer);
    write_matrix(component.covariance, writer);
  }
  return writer.take();
}

std::optional<MixtureState> restored_mixture(std::string_view bytes, Index rank) {
  if (bytes.empty()) return {};
  StageReader reader(bytes);
  MixtureState state;
  state.rounds = reader.value<std::size_t>();
  for (auto left = reader.value<std::size_t>(); left > 0; --left) {
    const auto weight = reader.value<double>();
    VectorXd mean = read_vector(reader);
    MatrixXd covariance = read_matrix(reader);
    reader.expect(mean.size() == rank && covariance.rows() == rank && covariance.cols() == rank);
    state.components.push_back({weight, std::move(mean), std::move(covariance)});
  }
  reader.end();
  return state;
}

}  // namespace

WienerFit::WienerFit(std::size_t channels, const WienerFitSettings& settings)
    : settings_(settings),
      channels_(static_cast<Index>(channels)),
      frames_(kinemend::window_frames(settings.window_s, settings.rate_hz)),
      coefficients_(std::min(static_cast<Index>(settings.coefficients), frames_)),
      cosines_(window_cosines(frames_, frames_)),
      halves_{WindowMoments(channels_ * coefficients_), WindowMoments(channels_ * coefficients_)},
      tail_(MatrixXd::Zero(channels_, frames_)) {}

std::size_t WienerFit::window_frames() const noexcept { return static_cast<std::size_t>(frames_); }

MatrixXd WienerFit::coefficients_of(const PoseMatrix& sequence) const {
  const auto frames = static_cast<Index>(sequence.frames);
  if (frames < frames_) return {};
  std::vector<Index> starts = window_starts(frames, frames_);
  std::erase_if(starts, [&](Index start) {
    return jumps(sequence, static_cast<std::size_t>(start),
                 static_cast<std::size_t>(start + frames_));
  });
  MatrixXd result(channels_ * frames_, static_cast<Index>(starts.size()));
  for (std::size_t w = 0; w < starts.size(); ++w) {
    const Eigen::Map<const MatrixXd> window(sequence.values.data() + starts[w] * channels_,
                                            channels_, frames_);
    Eigen::Map<MatrixXd>(result.col(static_cast<Index>(w)).data(), frames_, channels_).noalias() =
        cosines_.transpose() * window.transpose() / static_cast<double>(frames_);
  }
  return result;
}

MatrixXd WienerFit::low(const MatrixXd& all) const {
  MatrixXd result(channels_ * coefficients_, all.cols());
  for (Index d = 0; d < channels_; ++d)
    result.middleRows(d * coefficients_, coefficients_) =
        all.middleRows(d * frames_, coefficients_);
  return result;
}

void WienerFit::add_moments(const PoseMatrix& sequence, double weight, std::size_t half) {
  const MatrixXd all = coefficients_of(sequence);
  if (all.cols() == 0) return;
  halves_.at(half).add(low(all), weight);
  const VectorXd squares = weight * all.rowwise().squaredNorm();
  tail_ += Eigen::Map<const MatrixXd>(squares.data(), frames_, channels_).transpose();
}

void WienerFit::find_basis() {
  WindowMoments all = halves_[0];
  all.add(halves_[1]);
  if (all.weight() <= 0)
    throw Error(ErrorKind::usage, "all takes are shorter than a window, or turn too far in one");
  prior_.window_s = settings_.window_s;
  prior_.mean = all.mean();
  const auto frames = static_cast<double>(frames_);
  const auto rank = static_cast<Index>(
      std::min(settings_.rank, static_cast<std::size_t>(channels_ * coefficients_)));
  const MatrixXd covariance = all.covariance();
  const Directions directions = leading_directions(covariance, rank);
  prior_.basis = directions.vectors;
  const bool has_halves = halves_[0].weight() > 0 && halves_[1].weight() > 0;
  const VectorXd outside =
      has_halves ? cross_validated_rest(halves_[0], halves_[1], rank)
                 : VectorXd(covariance.diagonal() -
                            prior_.basis.array().square().matrix() * directions.variances);
  prior_.rest = (tail_ / all.weight()).cwiseMax(least_variance / frames);
  for (Index d = 0; d < channels_; ++d) {
    for (Index k = 0; k < coefficients_; ++k)
      prior_.rest(d, k) = std::max(outside(d * coefficients_ + k), least_variance / frames);
  }
  halves_.fill(WindowMoments(0));
}

void WienerFit::add_windows(const PoseMatrix& sequence) {
  const MatrixXd kept = low(coefficients_of(sequence));
  const MatrixXd z = prior_.basis.transpose() * (kept.colwise() - prior_.mean);
  // Reservoir sampling (Vitter), with one generator per window so that the sample depends on the
  // seed only.
  const Random random(settings_.seed);
  for (Index w = 0; w < z.cols(); ++w, ++seen_) {
    if (sample_.size() < settings_.windows) {
      sample_.emplace_back(z.col(w));
      continue;
    }
    Random own = random.fork(seen_);
    const std::uint64_t place = own.below(seen_ + 1);
    if (place < sample_.size()) sample_[place] = z.col(w);
  }
}

std::string WienerFit::stored() const {
  StageWriter writer;
  write_matrix(prior_.mean, writer);
  write_matrix(prior_.basis, writer);
  write_matrix(prior_.rest, writer);
  writer.value(sample_.size());
  for (const VectorXd& window : sample_) write_matrix(window, writer);
  return writer.take();
}

void WienerFit::restore(std::string_view bytes) {
  StageReader reader(bytes);
  prior_.window_s = settings_.window_s;
  prior_.mean = read_vector(reader);
  prior_.basis = read_matrix(reader);
  prior_.rest = read_matrix(reader);
  sample_.clear();
  for (auto left = reader.value<std::size_t>(); left > 0; --left) {
    sample_.push_back(read_vector(reader));
    reader.expect(sample_.back().size() == prior_.basis.cols());
  }
  reader.end();
  reader.expect(prior_.mean.size() == channels_ * coefficients_ &&
                prior_.basis.rows() == prior_.mean.size() && prior_.rest.rows() == channels_ &&
                prior_.rest.cols() == frames_);
}

WienerPrior WienerFit::finish(TrainingStages* stages) const {
  MatrixXd points(prior_.rank(), static_cast<Index>(sample_.size()));
  for (std::size_t w = 0; w < sample_.size(); ++w) points.col(static_cast<Index>(w)) = sample_[w];
  WienerPrior prior = prior_;
  const std::string stage = "mixture";
  std::optional<MixtureState> start;
  if (stages != nullptr) start = restored_mixture(stages->kept(stage), prior_.rank());
  const auto keep = [&](const MixtureState& state) {
    if (stages == nullptr) return;
    if (state.rounds == settings_.rounds || stages->is_due(stage))
      stages->keep(stage, stored_mixture(state));
    stages->stop_if_asked();
  };
  prior.components = fit_mixture(
      points, {settings_.components, settings_.rounds, settings_.pooling, settings_.seed}, keep,
      start ? &*start : nullptr);
  return prior;
}

}  // namespace kinemend
