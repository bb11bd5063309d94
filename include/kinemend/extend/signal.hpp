// Filters on F x D matrices of equally spaced samples, in place, each channel by itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinemend/extend/frames.hpp"

/// The filters do not depend on skeletons: widths are in frames, and only `butterworth_lowpass`
/// takes hertz.
///
/// All filters accept any F and D, 0 included. A channel's result does not depend on its
/// neighbours; the negated signal gives the negated result bit for bit; results do not depend on
/// the processor. Values are finite. Marks of samples are F x D bytes, frame-major, 0 or not 0; an
/// empty span marks nothing. Errors: `ErrorKind::usage` for a parameter out of range or a span of
/// the wrong size.
namespace kinemend {

/// A second-order section: y[t] = b0 x[t] + b1 x[t-1] + b2 x[t-2] - a1 y[t-1] - a2 y[t-2].
struct Biquad {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};

/// Gaussian of standard deviation `sigma_frames` (>= 0; 0 changes nothing), cut at 4 sigma (to the
/// nearest frame) and normalised to sum 1; at most 100,000. The signal is extended by its point
/// reflection, x[-k] = 2 x[0] - x[k], so that a straight line stays straight and the ends do not
/// bend towards the mean.
void gaussian_filter(PoseMatrix& matrix, double sigma_frames);

/// Low-pass Butterworth filter by the bilinear transform, |H|^2 = 1/2 at `cutoff_hz`, gain 1 at 0
/// Hz, as second-order sections. `order` is 1 to 12; 0 < cutoff_hz < rate_hz / 2.
std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double rate_hz);

/// Returns the frames that `filter_zero_phase` adds at each end by default: three times the
/// filter's length, as in SciPy's `sosfiltfilt`. Always less than `frames`.
std::size_t default_pad_frames(const std::vector<Biquad>& sections, std::size_t frames);
/// Returns the frames after which the sections' impulse response has decayed below `tolerance`.
/// With this padding even low cutoffs keep straight lines straight up to the ends. At most
/// 1,000,000.
std::size_t settling_frames(const std::vector<Biquad>& sections, double tolerance = 1e-6);

/// Runs the sections forward and backward: no shift in time, and the squared gain. The signal is
/// extended at both ends by its point reflection over `pad_frames`, repeated if `pad_frames` is F
/// or more. Each pass starts from the steady state of its first sample. With the default padding
/// this is SciPy's `sosfiltfilt`.
void filter_zero_phase(PoseMatrix& matrix, const std::vector<Biquad>& sections);
void filter_zero_phase(PoseMatrix& matrix, const std::vector<Biquad>& sections,
                       std::size_t pad_frames);

/// Runs the sections forward only, frame by frame, from the steady state of the first frame.
class CausalState {
 public:
  explicit CausalState(std::vector<Biquad> sections) : sections_(std::move(sections)) {}
  /// Filters the next frame in place. The first frame sets the number of channels, and is not
  /// changed if the gain at 0 Hz is 1. Errors: `ErrorKind::usage` if a later frame has another
  /// number of channels.
  void step(std::span<double> frame);
  /// Forgets the past: the next frame is a first frame.
  void reset() { memory_.clear(), started_ = false; }

 private:
  std::vector<Biquad> sections_;
  std::vector<double> memory_;
  std::size_t channels_ = 0;
  bool started_ = false;
};

/// Running median over 2 * half_window + 1 frames. Near the ends the window shrinks and stays
/// centred; the first and the last frame follow Tukey's end-point rule, y0 = median(x0, y1, 3 y1 -
/// 2 y2), so that a spike in these frames is removed too.
void median_filter(PoseMatrix& matrix, std::size_t half_window);

enum class WaveletFamily { daubechies, symlet };
enum class WaveletThreshold {
  universal,  ///< sigma * sqrt(2 ln n): removes nearly all noise, and most small detail
  sure  ///< SureShrink: per level the threshold of least estimated risk; universal if details are
        ///< sparse
};
enum class WaveletShrinkage { soft, hard };

struct WaveletOptions {
  WaveletFamily family = WaveletFamily::symlet;
  int vanishing_moments = 4;  ///< 1 to 10 for daubechies (1 is Haar), 2 to 10 for symlet
  WaveletThreshold threshold = WaveletThreshold::sure;
  WaveletShrinkage shrinkage = WaveletShrinkage::soft;
  int levels = 0;            ///< 0 to 20; 0: the most that the length and the wavelet allow
  double noise_scale = 1.0;  ///< >= 0, multiplies the estimated noise; 0 changes nothing
};

/// Denoises each channel by thresholding the details of its orthonormal wavelet transform (Donoho &
/// Johnstone 1994, 1995). The noise is the MAD of the finest details / 0.6745, per channel. At each
/// level the signal is extended by its point reflection, so that its ends are not edges; straight
/// lines are kept (2 vanishing moments or more). Under 4 frames nothing changes.
void wavelet_denoise(PoseMatrix& matrix, const WaveletOptions& options = {});
/// Returns the 2 * vanishing_moments scaling (low-pass) coefficients; orthonormal, sum sqrt(2). By
/// spectral factorisation: minimum phase for Daubechies, nearest to linear phase for symlets.
std::vector<double> wavelet_filter(WaveletFamily family, int vanishing_moments);

/// How `weighted_mean_filter` extends the signal beyond its ends.
enum class WeightedMeanEnds {
  reflect,  ///< point reflection: straight lines are kept, time reversal changes nothing
  blender   ///< as Blender: frames 0 and F - 1 are kept; 1, 2 and F - 2 use the nearest neighbour
            ///< for the missing second
};

/// The weighted moving mean of Blender's "Smooth Keys", `passes` times (>= 0). Blender averages a
/// mean that favours the past, weights 3:5:2:1:1 over five keys, and its mirror image: y[t] = (2
/// x[t-2] + 3 x[t-1] + 2 x[t] + 3 x[t+1] + 2 x[t+2]) / 12. Under 3 frames nothing changes.
void weighted_mean_filter(PoseMatrix& matrix, int passes,
                          WeightedMeanEnds ends = WeightedMeanEnds::reflect);

/// Fills marked samples on the straight line between their unmarked neighbours; before the first
/// and behind the last unmarked sample the value is held. A channel that is marked throughout is
/// not changed.
void fill_linear(PoseMatrix& matrix, std::span<const std::uint8_t> missing);
/// Fills marked samples on the natural cubic spline through the channel's unmarked samples.
void fill_cubic(PoseMatrix& matrix, std::span<const std::uint8_t> missing);

}  // namespace kinemend
