#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "kinemend/cleaner.hpp"
#include "kinemend/fill.hpp"

namespace kinemend {

struct Model;

// Every cleaning method as a plain options struct and the function that makes its cleaner. Times
// are seconds and frequencies hertz, taken against the clip's own rate. The factories throw
// `ErrorKind::usage` for a value out of range.

/// Orientation filter of Lee & Shin's construction with a Gaussian mask (Courty 2008, eq. 2-3).
struct GaussianOptions {
  double width_s = 0.02;  ///< standard deviation of the mask
};
std::unique_ptr<Cleaner> make_gaussian(const GaussianOptions& options = {});

/// Low-pass Butterworth on quaternions with continued signs, forward and backward (zero phase).
struct ButterworthOptions {
  std::int64_t order = 4;  ///< of one direction, 1 to 12
  double cutoff_hz = 8;    ///< half power of one direction
  bool causal = false;     ///< forward only: delays the motion, and runs live
};
std::unique_ptr<Cleaner> make_butterworth(const ButterworthOptions& options = {});

/// Running median of rotations (the rotation with the least sum of chordal distances to the
/// window's samples) and of positions.
struct MedianOptions {
  double window_s = 0.06;  ///< whole window
};
std::unique_ptr<Cleaner> make_median(const MedianOptions& options = {});

/// Hampel despiking: a sample further from its window's median than `threshold` times the spread is
/// replaced by the median.
struct HampelOptions {
  double window_s = 0.10;    ///< whole window
  double threshold = 5;      ///< in robust standard deviations per axis
  double minimum_deg = 1.0;  ///< smaller deviations are no spikes
};
std::unique_ptr<Cleaner> make_hampel(const HampelOptions& options = {});

/// Wavelet shrinkage on every channel.
struct WaveletCleanerOptions {
  std::string family = "sym8";     ///< db1..db10, sym2..sym10
  std::string threshold = "sure";  ///< universal or sure
  std::string shrinkage = "soft";  ///< soft or hard
};
std::unique_ptr<Cleaner> make_wavelet(const WaveletCleanerOptions& options = {});

/// Blender's weighted moving mean (its graph editor's Smooth Keys), `passes` times.
struct WeightedMeanOptions {
  std::int64_t passes = 4;
};
std::unique_ptr<Cleaner> make_weighted_mean(const WeightedMeanOptions& options = {});

/// Error-state Kalman filter or Rauch-Tung-Striebel smoother on SO(3).
struct KalmanOptions {
  std::string model = "velocity";  ///< position (Lou & Chai's baseline) or velocity
  bool smoother = true;            ///< off: the causal filter, which also runs live
  double noise_deg = 0;            ///< measurement noise per axis; 0: estimated from the take
  double agility = 1;              ///< process noise, relative to the default for human motion
};
std::unique_ptr<Cleaner> make_kalman(const KalmanOptions& options = {});

/// The 1-euro filter of Casiez et al. 2012, on SO(3): a causal low-pass whose cutoff grows with
/// speed.
struct OneEuroOptions {
  double min_cutoff_hz = 1.5;       ///< cutoff at rest
  double speed_coefficient = 10.0;  ///< hertz of cutoff per radian per second
  double speed_cutoff_hz = 4.0;     ///< low-pass on the speed itself
};
std::unique_ptr<Cleaner> make_one_euro(const OneEuroOptions& options = {});

/// Bilateral filter on SO(3) (Courty 2008): averages samples that are near in time and in angle, so
/// that quick moves stay.
struct BilateralOptions {
  double sigma_t_s = 0.01;  ///< temporal width of one pass
  double sigma_g_deg = 8;   ///< width in rotation angle (geodesic distance |Log(a^-1 b)|)
  std::int64_t passes = 5;
  std::string ends = "reflect";  ///< reflect (a steady turn goes on) or mirror (the paper's)
};
std::unique_ptr<Cleaner> make_bilateral(const BilateralOptions& options = {});

/// Non-local pose means (Dean 2016): a pose becomes the mean of the poses about it in time whose
/// patches, the poses around them, are like its own. Causal, it leaves the root position alone.
/// Errors, beside values out of range: `causal` with the whole take as window.
struct NonlocalOptions {
  double window_s = 0.175;      ///< whole learning window (21 poses at 120 Hz); 0: the whole take
  double patch_s = 0.092;       ///< whole patch (11 poses at 120 Hz)
  std::int64_t neighbours = 0;  ///< the k most similar patches; 0: all in the window
  /// The paper's sigma, as the rotation angle of a channel: patches whose root mean square
  /// difference per channel is this weigh exp(-1/2). 0: from the estimated noise, which needs the
  /// take (or, causal, its past).
  double bandwidth_deg = 0;
  std::string boundary = "neumann";  ///< neumann, mirror or dirichlet
  bool causal = false;               ///< past poses only, for live use
};
std::unique_ptr<Cleaner> make_nonlocal(const NonlocalOptions& options = {});

/// The default: measures each joint's noise, repairs spikes, smooths as much as the noise asks,
/// leaves clean takes alone.
struct AutoOptions {
  double sensitivity = 1;  ///< scales the estimated noise: above 1 cleans more, below 1 less
  bool despike = true;
};
std::unique_ptr<Cleaner> make_auto(const AutoOptions& options = {});

// Methods with a learned model. `model` is the path of a model file; empty: the model that ships.
// `map` is the path of a file of names (`parse_name_map`); empty: names and topology only. A model
// handed over takes the place of the path. Errors, beside values out of range: those of `model_for`
// and `parse_name_map`; of `clean`: `ErrorKind::usage` for a body that the model does not know.
// Parts that the model does not know are cleaned by `auto`. Gaps of parts that it knows are filled
// with `fill`, those of markers that are never seen included.

/// Example-based denoising (Lou & Chai 2010): what the model's filter bases can express is kept
/// (eq. 11 and 16).
struct ExampleOptions {
  std::string model;
  std::string map;
  /// quick; or paper: its alternation (eq. 13 to 15) from what was measured, with its p = 3 and
  /// lambda = 0.1 where these are 0, and nothing after it.
  std::string solver = "quick";
  bool robust = true;              ///< off: the linear filter of eq. 7
  double welsch_deg = 0;           ///< p of eq. 9 (the paper: 3); 0: from the estimated noise
  double lambda = 0;               ///< of eq. 10 (the paper: 0.1); 0: from the noise and the model
  std::int64_t bases = 0;          ///< of those the model has; 0: from the noise, at most all
  std::int64_t iterations = 1000;  ///< at most
  /// Stop where an iteration gains less than this share of the objective; with gaps, which weigh
  /// little in it and settle last, less than a thousandth of that.
  double tolerance = 1e-2;
  bool fill = true;
};
std::unique_ptr<Cleaner> make_example(const ExampleOptions& options = {},
                                      std::shared_ptr<const Model> model = nullptr);

/// Posterior mean under a mixture of Gaussians over windows of half a second, in a temporal DCT:
/// each window is explained by the kinds of motion that its evidence speaks for, or by nothing but
/// smoothness.
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
  /// Of eq. 4 and 5, relative to the largest correlation that noise alone has with the atoms.
  double lambda = 0.1;
  std::int64_t hops = 4;  ///< windows over a frame, whose results are averaged
  /// quick: adds what the atoms do not express of markers, smoothed, and leaves to `auto` what they
  /// are wrong about; or paper: its solver, and nothing after it.
  std::string solver = "quick";
  bool fill = true;
};
std::unique_ptr<Cleaner> make_sparse(const SparseOptions& options = {},
                                     std::shared_ptr<const Model> model = nullptr);

/// A network corrects what `auto` makes of a take of joints: for each joint and frame which bands
/// of motion to keep, and a residual (after Mall et al. 2017). It knows nothing of the noise
/// beforehand. Errors of `clean`, beside those above: a take of markers. Errors: `ErrorKind::usage`
/// for a gap model or `live` beside a model that is no filter network, for both together, and for a
/// gap model of another body.
struct RecurrentOptions {
  std::string model{};
  std::string map{};
  bool fill = true;
  /// A file of a network that fills gaps (EBD), beside a `model` that filters (EBF): the gaps that
  /// the filter sees are filled by it, as in the paper. Empty: by the lines that `auto` lays.
  std::string gap_model{};
  /// The form of a filter network that runs live: what a frame becomes depends on the past and on
  /// 15 frames ahead. Only joints that the model knows change; `auto` has no part in it, and gaps
  /// are held, or bridged where they end within those frames.
  bool live = false;
};
/// `gap_model` takes the place of its option.
std::unique_ptr<Cleaner> make_recurrent(const RecurrentOptions& options = {},
                                        std::shared_ptr<const Model> model = nullptr,
                                        std::shared_ptr<const Model> gap_model = nullptr);

/// The way to fill gaps of joints by a network of Mall et al. 2017 (their EBD), for
/// `FillSettings::learned`. None ships: `kinemend-train paper --network ebd --head pose` makes
/// one. The root, joints that the model does not know, joints that turn farther from its mean than
/// rotation vectors can say, and takes at another rate than the model's are left out. Errors:
/// `ErrorKind::usage` for a model that fills no gaps, and, of a call, for a take with too few of
/// the model's joints; of files that cannot be read, theirs.
struct RecurrentFillOptions {
  std::string model;  ///< a file; empty: `model`
  std::string map;    ///< a file of names in the take for those of the model, or empty
};
LearnedFill make_recurrent_fill(const RecurrentFillOptions& options,
                                std::shared_ptr<const Model> model = nullptr);

/// Kalman filter or smoother with system matrices learned from clips (Lou & Chai 2010, section
/// 4.2). No model ships.
struct KalmanLearnedOptions {
  std::string model;
  std::string map;
  bool smoother = true;  ///< off: the causal filter
  double noise_deg = 0;  ///< measurement noise per channel; 0: estimated from the take
  bool fill = true;
};
std::unique_ptr<Cleaner> make_kalman_learned(const KalmanLearnedOptions& options = {},
                                             std::shared_ptr<const Model> model = nullptr);

}  // namespace kinemend
