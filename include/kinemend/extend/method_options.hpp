// Every other cleaning method: a struct of options and the function that makes its cleaner. Which
// methods can clean a take.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

// Times are in seconds and frequencies in hertz, so that options mean the same at every frame rate.
// The functions throw `ErrorKind::usage` for a value out of range.

/// Smoothing with Gaussian weights in time, by Lee & Shin's orientation filter (Courty 2008, eq.
/// 2-3).
struct GaussianOptions {
  double width_s = 0.02;  ///< standard deviation of the weights
};
std::unique_ptr<Cleaner> make_gaussian(const GaussianOptions& options = {});

/// Low-pass Butterworth on quaternions with continued signs, forward and backward (zero phase).
struct ButterworthOptions {
  std::int64_t order = 4;  ///< filter order of each pass, 1 to 12
  double cutoff_hz = 8;    ///< half power of one pass; below half of the frame rate
  bool causal = false;     ///< forward pass only: delays the motion, and can run live
};
std::unique_ptr<Cleaner> make_butterworth(const ButterworthOptions& options = {});

/// Running median of rotations (the rotation with the least sum of chordal distances to the
/// window's samples) and of positions.
struct MedianOptions {
  double window_s = 0.06;  ///< length of the whole window
};
std::unique_ptr<Cleaner> make_median(const MedianOptions& options = {});

/// Hampel despiking: a sample farther from the median of its window than `threshold` robust
/// deviations is replaced by the median.
struct HampelOptions {
  double window_s = 0.10;    ///< length of the whole window
  double threshold = 5;      ///< in robust standard deviations per axis
  double minimum_deg = 1.0;  ///< smallest distance from the median of a spike
};
std::unique_ptr<Cleaner> make_hampel(const HampelOptions& options = {});

/// Wavelet shrinkage on every channel.
struct WaveletCleanerOptions {
  std::string family = "sym8";     ///< db1..db10, sym2..sym10
  std::string threshold = "sure";  ///< universal or sure
  std::string shrinkage = "soft";  ///< soft or hard
};
std::unique_ptr<Cleaner> make_wavelet(const WaveletCleanerOptions& options = {});

/// The weighted moving mean of five frames of Blender's Smooth Keys, applied `passes` times.
struct WeightedMeanOptions {
  std::int64_t passes = 4;
};
std::unique_ptr<Cleaner> make_weighted_mean(const WeightedMeanOptions& options = {});

/// Error-state Kalman filter or Rauch-Tung-Striebel smoother on SO(3).
struct KalmanOptions {
  std::string model = "velocity";  ///< position (Lou & Chai's baseline) or velocity
  bool smoother = true;            ///< off: past frames only, which can run live
  double noise_deg = 0;            ///< measurement noise per axis; 0: estimated from the take
  double agility = 1;              ///< how quickly the motion may change, 1: everyday motion
};
std::unique_ptr<Cleaner> make_kalman(const KalmanOptions& options = {});

/// The 1-euro filter of Casiez et al. 2012, on SO(3): a causal low-pass whose cutoff grows with
/// speed.
struct OneEuroOptions {
  double min_cutoff_hz = 1.5;       ///< cutoff at rest
  double speed_coefficient = 10.0;  ///< hertz of cutoff per radian per second
  double speed_cutoff_hz = 4.0;     ///< cutoff of the low-pass filter on the speed
};
std::unique_ptr<Cleaner> make_one_euro(const OneEuroOptions& options = {});

/// Bilateral filter on SO(3) (Courty 2008): averages samples that are near in time and in angle, so
/// that quick moves are kept.
struct BilateralOptions {
  double sigma_t_s = 0.01;  ///< standard deviation of the weights in time, of one pass
  /// Standard deviation in rotation angle (geodesic distance |Log(a^-1 b)|).
  double sigma_g_deg = 8;
  std::int64_t passes = 5;
  std::string ends = "reflect";  ///< reflect (continues a steady turn) or mirror (the paper's)
};
std::unique_ptr<Cleaner> make_bilateral(const BilateralOptions& options = {});

/// Non-local pose means (Dean 2016): replaces a pose by the mean of nearby poses that occur in
/// similar stretches of motion (patches). With `causal` the root position is not changed.
/// Errors, besides values out of range: `causal` with the whole take as window.
struct NonlocalOptions {
  double window_s = 0.175;      ///< whole window that is searched (21 poses at 120 Hz); 0: all
  double patch_s = 0.092;       ///< whole patch (11 poses at 120 Hz)
  std::int64_t neighbours = 0;  ///< number of similar poses that are averaged; 0: all
  /// The paper's sigma, as the rotation angle of a channel: patches whose root mean square
  /// difference per channel is this weigh exp(-1/2). 0: from the estimated noise, which needs the
  /// take (or, causal, its past).
  double bandwidth_deg = 0;
  std::string boundary = "neumann";  ///< neumann, mirror or dirichlet
  bool causal = false;               ///< past poses only, for live use
};
std::unique_ptr<Cleaner> make_nonlocal(const NonlocalOptions& options = {});

// Methods with a learned model. `model` is the path of a model file; empty: the shipped model.
// `map` is the path of a file that maps names (`parse_name_map`); empty: joints are matched by name
// and topology. A model that is passed to the function replaces the path. Errors, besides values
// out of range: as for `model_for` and `parse_name_map`; `clean` throws `ErrorKind::usage` for a
// body that the model does not know. Parts that the model does not know are cleaned by `auto`. With
// `fill`, gaps of parts that it knows are filled, including markers that are never seen.

/// Example-based denoising (Lou & Chai 2010): keeps the motion that the model's filter bases can
/// express (eq. 11 and 16).
struct ExampleOptions {
  std::string model;
  std::string map;
  /// quick; or paper: the alternation of the paper (eq. 13 to 15), started from the measured data,
  /// with p = 3 and lambda = 0.1 if these options are 0, and without later steps.
  std::string solver = "quick";
  bool robust = true;      ///< off: the linear filter of eq. 7
  double welsch_deg = 0;   ///< p of eq. 9 (the paper: 3); 0: from the estimated noise
  double lambda = 0;       ///< lambda of eq. 10 (the paper: 0.1); 0: from the noise and the model
  std::int64_t bases = 0;  ///< number of filter bases; 0: all bases of the model
  std::int64_t iterations = 1000;  ///< maximum number of iterations
  /// Stops when an iteration gains less than this share of the objective. With gaps, which have
  /// little weight in it and converge last, the limit is a thousandth of this.
  double tolerance = 1e-2;
  bool fill = true;
};
std::unique_ptr<Cleaner> make_example(const ExampleOptions& options = {},
                                      std::shared_ptr<const Model> model = nullptr);

/// Posterior mean under a mixture of Gaussians over windows of half a second, in a temporal DCT:
/// each window is explained by the kinds of motion that its samples support, or by smoothness
/// alone.
struct WienerOptions {
  std::string model;
  std::string map;
  double noise_deg = 0;    ///< standard deviation per channel; 0: estimated, for each joint
  double sensitivity = 1;  ///< scales the noise
  bool despike = true;
  bool fill = true;
};
std::unique_ptr<Cleaner> make_wiener(const WienerOptions& options = {},
                                     std::shared_ptr<const Model> model = nullptr);

/// Sparse selection of motion bases (Xiao et al. 2015): windows of five parts of the body, in local
/// coordinates, as sums of few atoms of learned dictionaries (eq. 4 and 5).
struct SparseOptions {
  std::string model;
  std::string map;
  std::string loss = "mixed";  ///< mixed, l2 (eq. 4) or l1 (eq. 5)
  /// Lambda of eq. 4 and 5, relative to the largest correlation that noise alone has with the
  /// atoms.
  double lambda = 0.1;
  std::int64_t hops = 4;  ///< number of overlapping windows that are averaged in each frame
  /// quick: adds the motion of markers that the atoms cannot express, smoothed, and takes the
  /// result of `auto` where the atoms are wrong; or paper: the algorithm of the paper alone.
  std::string solver = "quick";
  bool fill = true;
};
std::unique_ptr<Cleaner> make_sparse(const SparseOptions& options = {},
                                     std::shared_ptr<const Model> model = nullptr);

/// A neural network predicts a filter for each joint and frame (Mall et al. 2017). It does not use
/// the noise level. The root, and takes at another rate than the network's, are cleaned by `auto`.
/// `clean` also throws for a take of markers. Errors: `ErrorKind::usage` for a model that fills
/// gaps, for a gap model together with `live`, and for a gap model of another body.
struct RecurrentOptions {
  std::string model{};
  std::string map{};
  bool fill = true;
  /// A file of a network that fills gaps (EBD), in addition to a `model` that filters (EBF): it
  /// fills the gaps in the filter's input, as in the paper. Empty: these gaps are filled with the
  /// lines of `auto`.
  std::string gap_model{};
  /// The form of a filter network that runs live: a frame depends on the past and on 15 frames
  /// ahead. Only joints that the model knows change; `auto` is not used. Gaps hold the last value,
  /// or are bridged if they end within those frames.
  bool live = false;
};
/// Makes the cleaner. `gap_model` replaces the option of that name.
std::unique_ptr<Cleaner> make_recurrent(const RecurrentOptions& options = {},
                                        std::shared_ptr<const Model> model = nullptr,
                                        std::shared_ptr<const Model> gap_model = nullptr);

/// Fills gaps of joints with a network of Mall et al. 2017 (their EBD), for
/// `FillModels::recurrent`. No model ships; `kinemend-train paper --network ebd --head pose` makes
/// one. It leaves out the root, joints that the model does not know, joints that turn farther from
/// the model's mean than rotation vectors can express, and takes at another rate than the model's.
/// Errors: `ErrorKind::usage` for a model that does not fill gaps, and the errors of reading the
/// files; the result throws `ErrorKind::usage` for a take with too few of the model's joints.
struct RecurrentFillOptions {
  std::string model;  ///< a file; empty: `model`
  std::string map;    ///< a file that maps names in the take to names in the model, or empty
};
LearnedFill make_recurrent_fill(const RecurrentFillOptions& options,
                                std::shared_ptr<const Model> model = nullptr);

/// Kalman filter or smoother with system matrices learned from clips (Lou & Chai 2010, section
/// 4.2). No model ships with the program.
struct KalmanLearnedOptions {
  std::string model;
  std::string map;
  bool smoother = true;  ///< off: past frames only
  double noise_deg = 0;  ///< measurement noise per channel; 0: estimated from the take
  bool fill = true;
};
std::unique_ptr<Cleaner> make_kalman_learned(const KalmanLearnedOptions& options = {},
                                             std::shared_ptr<const Model> model = nullptr);

/// Returns why a method with default options refuses this take, or leaves all its joints or markers
/// to `auto`: "the network filters takes of 120 Hz only, and this one has 60"; empty: it cleans
/// some of them. A missing model is also such a reason. Looks at names, skeleton and frame rate,
/// not at the samples of joints. Throws nothing but `std::bad_alloc`.
std::string why_not(const Method& method, const Take& take);

}  // namespace kinemend
