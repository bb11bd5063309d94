// Changes the rate of the system, stores it in a model, and filters and smooths poses with it.
#include "classic/linear_dynamics.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include "kinemend/error.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The largest growth of a step, so that the stationary covariance is finite. Chosen by hand, not
// swept.
constexpr double largest_growth = 0.9999;

MatrixXd symmetric(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

// S = A S A^T + Q by doubling: S_{k+1} = S_k + A_k S_k A_k^T, A_{k+1} = A_k^2.
MatrixXd stationary_spread(MatrixXd transition, const MatrixXd& drive) {
  MatrixXd spread = drive;
  for (int k = 0; k < 60; ++k) {
    const MatrixXd more = transition * spread * transition.transpose();
    spread += more;
    if (more.cwiseAbs().maxCoeff() <= 1e-15 * spread.cwiseAbs().maxCoeff()) break;
    transition = (transition * transition).eval();
  }
  return symmetric(spread);
}

// Eigenvalues on the negative axis and at zero have no real power.
MatrixXd with_real_powers(const MatrixXd& transition) {
  // Chosen by hand, not swept.
  constexpr double forgotten = 1e-6;  // an eigenvalue without memory
  const Eigen::EigenSolver<MatrixXd> solver(transition);
  Eigen::VectorXcd values = solver.eigenvalues();
  bool changed = false;
  for (std::complex<double>& value : values) {
    const bool is_negative = value.real() < 0 && std::abs(value.imag()) < -1e-6 * value.real();
    if (!is_negative && std::abs(value) >= forgotten) continue;
    value = forgotten;
    changed = true;
  }
  if (!changed) return transition;
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::MatrixXcd product = vectors * values.asDiagonal();
  return vectors.transpose().partialPivLu().solve(product.transpose().eval()).transpose().real();
}

}  // namespace

MatrixXd covariance_near(const MatrixXd& matrix) {
  const SymmetricEigen eigen = symmetric_eigen(symmetric(matrix));
  const VectorXd variances = eigen.values.cwiseMax(0.0);
  return eigen.vectors * variances.asDiagonal() * eigen.vectors.transpose();
}

void make_stable(MatrixXd& transition) {
  const double growth = transition.eigenvalues().cwiseAbs().maxCoeff();
  if (growth > largest_growth) transition *= largest_growth / growth;
}

LinearDynamics at_rate(const LinearDynamics& dynamics, double rate_hz) {
  const double step = dynamics.rate_hz / rate_hz;
  if (std::abs(step - 1) < 1e-6) return dynamics;
  LinearDynamics result = dynamics;
  result.rate_hz = rate_hz;
  const MatrixXd one = with_real_powers(dynamics.transition);
  const MatrixXd spread = stationary_spread(dynamics.transition, dynamics.drive);
  result.transition = one.pow(step);
  result.drive =
      covariance_near(spread - result.transition * spread * result.transition.transpose());
  return result;
}

namespace {

Tensor tensor_of(const MatrixXd& matrix, std::vector<std::size_t> shape) {
  Tensor tensor{TensorType::f32, std::move(shape), std::vector<double>(matrix.size())};
  Eigen::Map<Rows>(tensor.values.data(), matrix.rows(), matrix.cols()) = matrix;
  return tensor;
}

MatrixXd square_of(const Model& model, std::string_view name, std::size_t size) {
  const Tensor& tensor = model.tensor(name, {size, size});
  return Eigen::Map<const Rows>(tensor.values.data(), static_cast<Index>(size),
                                static_cast<Index>(size));
}

VectorXd vector_of(const Model& model, std::string_view name, std::size_t size) {
  const Tensor& tensor = model.tensor(name, std::vector<std::size_t>{size});
  return Eigen::Map<const VectorXd>(tensor.values.data(), static_cast<Index>(size));
}

}  // namespace

void store_dynamics(const LinearDynamics& dynamics, Model& model) {
  const auto d = static_cast<std::size_t>(dynamics.channels());
  const auto n = static_cast<std::size_t>(dynamics.states());
  model.rate_hz = dynamics.rate_hz;
  model.numbers["order"] = static_cast<double>(dynamics.order);
  model.tensors["mean"] = tensor_of(dynamics.mean, {d});
  model.tensors["outside"] = tensor_of(dynamics.outside, {d});
  model.tensors["transition"] = tensor_of(dynamics.transition, {n, n});
  model.tensors["drive"] = tensor_of(dynamics.drive, {n, n});
  model.tensors["spread"] = tensor_of(dynamics.spread, {n, n});
  if (dynamics.basis.size() > 0) {
    model.tensors["basis"] =
        tensor_of(dynamics.basis, {d, static_cast<std::size_t>(dynamics.basis.cols())});
  }
}

LinearDynamics dynamics_of(const Model& model) {
  const std::size_t d = model.layout.channel_count();
  const double order = model.number("order");
  if (order != 1 && order != 2)
    throw Error(ErrorKind::unreadable_input, "the model's order of motion is neither 1 nor 2");
  LinearDynamics dynamics;
  dynamics.rate_hz = model.rate_hz;
  dynamics.order = static_cast<std::size_t>(order);
  dynamics.mean = vector_of(model, "mean", d);
  dynamics.outside = vector_of(model, "outside", d).cwiseMax(0.0);
  std::size_t k = d;
  if (model.tensors.contains("basis")) {
    const Tensor& basis = model.tensor("basis", 2);
    k = basis.shape[1];
    if (basis.shape[0] != d || k < 1 || k > d)
      throw Error(ErrorKind::unreadable_input, "the model's basis does not fit its channels");
    dynamics.basis =
        Eigen::Map<const Rows>(basis.values.data(), static_cast<Index>(d), static_cast<Index>(k));
  }
  const std::size_t n = k * dynamics.order;
  dynamics.transition = square_of(model, "transition", n);
  // Rounded or edited numbers become valid covariances and stable dynamics.
  make_stable(dynamics.transition);
  dynamics.drive = covariance_near(square_of(model, "drive", n));
  dynamics.spread = covariance_near(square_of(model, "spread", n));
  return dynamics;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Not swept.
constexpr double least_noise_deg = 1e-3;  // against division by zero
// Gains have converged when a frame changes no covariance by more than this, relative to the
// variances of the two directions. Not swept.
constexpr double settled_change = 1e-9;
// Most covariances kept between the passes; beyond it they are recomputed from every
// `segment_frames`-th. Limits memory; not swept.
constexpr std::size_t kept_numbers = std::size_t{1} << 24;
constexpr std::size_t segment_frames = 128;

// The filter's covariance after a frame, shared by frames once it has converged.
using Covariance = std::shared_ptr<const MatrixXd>;

struct FilterState {
  VectorXd mean;          // n
  Covariance covariance;  // after the last frame; none before the first
  VectorXd weights;       // D: of the last frame's channels, 1 / R; 0: not observed
  bool settled = false;
};

// Data of a frame for the backward pass.
struct FilteredFrame {
  VectorXd mean;     // n, after the update
  VectorXd force;    // n: H^T R^-1 (y - H predicted mean)
  VectorXd weights;  // D
  Covariance covariance;
};

class Filter {
 public:
  Filter(const PoseMatrix& poses, const MeasurementFacts& facts, const LinearDynamics& dynamics)
      : poses_(poses), facts_(facts), model_(dynamics), precision_(dynamics.channels()) {
    if (static_cast<std::size_t>(dynamics.channels()) != poses.channels ||
        facts.noise_deg.size() != poses.channels ||
        (!facts.observed.empty() && facts.observed.size() != poses.values.size()))
      throw Error(ErrorKind::usage, "the motion's model and its measurements do not fit");
    for (Index d = 0; d < precision_.size(); ++d) {
      const double noise = std::max(facts.noise_deg[static_cast<std::size_t>(d)], least_noise_deg);
      precision_[d] = 1 / (noise * noise + dynamics.outside[d]);
    }
  }

  FilterState start() const {
    return {VectorXd::Zero(model_.states()), nullptr, VectorXd::Zero(model_.channels()), false};
  }

  // Predicts a frame's state from that of the frame before and updates it. P' is the predicted
  // covariance and H = [U 0].
  FilteredFrame step(FilterState& state, std::size_t frame) const {
    const VectorXd weights = weights_of(frame);
    if (state.covariance) state.mean = (model_.transition * state.mean).eval();
    if (!state.settled || weights != state.weights) advance_covariance(state, weights);
    state.weights = weights;
    const VectorXd innovation = measured(frame) - channels_of(state.mean);
    FilteredFrame result{
        {}, states_of(weights.cwiseProduct(innovation)), weights, state.covariance};
    state.mean.noalias() += *state.covariance * result.force;
    result.mean = state.mean;
    return result;
  }

  // The products H x and H^T y.
  VectorXd channels_of(const VectorXd& state) const {
    if (model_.basis.size() == 0) return state.head(model_.channels());
    return model_.basis * state.head(model_.directions());
  }
  VectorXd states_of(const VectorXd& channels) const {
    VectorXd state = VectorXd::Zero(model_.states());
    if (model_.basis.size() == 0) {
      state.head(model_.channels()) = channels;
    } else {
      state.head(model_.directions()).noalias() = model_.basis.transpose() * channels;
    }
    return state;
  }

 private:
  VectorXd weights_of(std::size_t frame) const {
    if (facts_.observed.empty()) return precision_;
    VectorXd weights = precision_;
    const std::uint8_t* seen = facts_.observed.data() + frame * poses_.channels;
    for (Index d = 0; d < weights.size(); ++d) weights[d] *= seen[d] ? 1.0 : 0.0;
    return weights;
  }

  // Unobserved samples have no weight; any finite number works.
  VectorXd measured(std::size_t frame) const {
    VectorXd values =
        Eigen::Map<const VectorXd>(poses_.row(frame).data(), model_.channels()) - model_.mean;
    if (facts_.observed.empty()) return values;
    const std::uint8_t* seen = facts_.observed.data() + frame * poses_.channels;
    for (Index d = 0; d < values.size(); ++d) {
      if (!seen[d]) values[d] = 0;
    }
    return values;
  }

  // P = P' - B^T B with B = chol(I + V H P' H^T V)^-1 V H P', V^2 = R^-1: the system is well
  // conditioned whatever the noise, and rows of unobserved samples are those of I.
  void advance_covariance(FilterState& state, const VectorXd& weights) const {
    const MatrixXd predicted =
        state.covariance ? predicted_covariance(*state.covariance) : model_.spread;
    MatrixXd across = model_.basis.size() == 0
                          ? MatrixXd(predicted.topRows(model_.channels()))
                          : MatrixXd(model_.basis * predicted.topRows(model_.directions()));
    const VectorXd scale = weights.cwiseSqrt();
    across = (scale.asDiagonal() * across).eval();
    MatrixXd system(scale.size(), scale.size());
    if (model_.basis.size() == 0) {
      system = across.leftCols(scale.size());
    } else {
      system.noalias() = across.leftCols(model_.directions()) * model_.basis.transpose();
    }
    system = (system * scale.asDiagonal()).eval();
    system.diagonal().array() += 1;
    const Eigen::LLT<MatrixXd> factor(system);
    factor.matrixL().solveInPlace(across);
    auto updated = std::make_shared<MatrixXd>(predicted);
    updated->selfadjointView<Eigen::Lower>().rankUpdate(across.transpose(), -1);
    updated->triangularView<Eigen::StrictlyUpper>() = updated->transpose();
    state.settled = state.covariance && weights == state.weights &&
                    change_of(*state.covariance, *updated) <= settled_change;
    state.covariance = std::move(updated);
  }

  MatrixXd predicted_covariance(const MatrixXd& covariance) const {
    const MatrixXd half = model_.transition * covariance;
    MatrixXd predicted = model_.drive;
    predicted.noalias() += half * model_.transition.transpose();
    return predicted;
  }

  static double change_of(const MatrixXd& before, const MatrixXd& after) {
    const VectorXd scale = after.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    return (scale.asDiagonal() * (after - before) * scale.asDiagonal()).cwiseAbs().maxCoeff();
  }

  const PoseMatrix& poses_;
  const MeasurementFacts& facts_;
  const LinearDynamics& model_;
  VectorXd precision_;  // D: 1 / R
};

void write(PoseMatrix& poses, std::size_t frame, const VectorXd& values,
           const LinearDynamics& dynamics) {
  Eigen::Map<VectorXd>(poses.row(frame).data(), values.size()) = values + dynamics.mean;
}

// The forward pass in segments. Earlier segments are freed when memory exceeds its limit; their
// initial states are kept.
class ForwardPass {
 public:
  ForwardPass(const Filter& filter, std::size_t frames) : filter_(filter), frames_(frames) {
    FilterState state = filter.start();
    std::size_t kept = 0;
    for (std::size_t first = 0; first < frames; first += segment_frames) {
      starts_.push_back(state);
      segments_.push_back(run(state, first));
      kept += numbers_in(segments_.back());
      while (kept > kept_numbers && given_up_ + 1 < segments_.size()) {
        kept -= numbers_in(segments_[given_up_]);
        segments_[given_up_++].clear();
      }
    }
  }

  std::size_t segments() const { return segments_.size(); }
  // Frees the segments after this one.
  const std::vector<FilteredFrame>& segment(std::size_t index) {
    segments_.resize(index + 1);
    if (segments_[index].empty()) {
      FilterState state = starts_[index];
      segments_[index] = run(state, index * segment_frames);
    }
    return segments_[index];
  }

 private:
  std::vector<FilteredFrame> run(FilterState& state, std::size_t first) const {
    std::vector<FilteredFrame> result;
    const std::size_t last = std::min(first + segment_frames, frames_);
    result.reserve(last - first);
    for (std::size_t f = first; f < last; ++f) result.push_back(filter_.step(state, f));
    return result;
  }

  static std::size_t numbers_in(const std::vector<FilteredFrame>& segment) {
    std::size_t numbers = 0;
    for (std::size_t i = 0; i < segment.size(); ++i) {
      const FilteredFrame& frame = segment[i];
      numbers += static_cast<std::size_t>(2 * frame.mean.size() + frame.weights.size());
      if (i == 0 || frame.covariance != segment[i - 1].covariance)
        numbers += static_cast<std::size_t>(frame.covariance->size());
    }
    return numbers;
  }

  const Filter& filter_;
  std::size_t frames_;
  std::size_t given_up_ = 0;
  std::vector<FilterState> starts_;
  std::vector<std::vector<FilteredFrame>> segments_;
};

}  // namespace

void filter_with_dynamics(PoseMatrix& poses, const MeasurementFacts& facts,
                          const LinearDynamics& dynamics) {
  const Filter filter(poses, facts, dynamics);
  FilterState state = filter.start();
  for (std::size_t f = 0; f < poses.frames; ++f) {
    const FilteredFrame frame = filter.step(state, f);
    write(poses, f, filter.channels_of(frame.mean), dynamics);
  }
}

// With b the force of a frame and J = H^T R^-1 H, the information of later frames is
//   l = A^T r,   smoothed = mean + P l,   r of the frame before = (I - J P) (b + l).
void smooth_with_dynamics(PoseMatrix& poses, const MeasurementFacts& facts,
                          const LinearDynamics& dynamics) {
  const Filter filter(poses, facts, dynamics);
  ForwardPass forward(filter, poses.frames);
  VectorXd from_later = VectorXd::Zero(dynamics.states());
  for (std::size_t s = forward.segments(); s-- > 0;) {
    const std::vector<FilteredFrame>& segment = forward.segment(s);
    for (std::size_t i = segment.size(); i-- > 0;) {
      const FilteredFrame& frame = segment[i];
      const VectorXd smoothed = frame.mean + *frame.covariance * from_later;
      const VectorXd force = frame.force + from_later;
      const VectorXd seen = filter.channels_of(*frame.covariance * force);
      from_later = dynamics.transition.transpose() *
                   (force - filter.states_of(frame.weights.cwiseProduct(seen)));
      write(poses, s * segment_frames + i, filter.channels_of(smoothed), dynamics);
    }
  }
}

}  // namespace kinemend
