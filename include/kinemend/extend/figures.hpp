// Every error figure of the project, defined once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/metrics.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

// A figure compares `other` with `reference`, from `first_frame` on: pass
// `leading_calibration_frames(reference)` to leave a calibration pose out. Both clips must have the
// same joints (number and names) and the same number of frames, and `first_frame` must be one of
// them; otherwise the function throws `ErrorKind::usage`. The figure of two equal clips is 0.

/// Mall et al. 2017: per frame the root mean square, over joint-angle channels, of the wrapped
/// difference in degrees; averaged over frames. The channels are the Euler angles of each joint's
/// own rotation channels in the reference; only channels that move in the reference (by more than
/// 0.001 degrees in all) are included, and roots are left out. The other clip's angles are the ones
/// nearest to the reference's in the same frame, so that no branch or whole turn is mistaken for a
/// difference. Over a set of clips the figure is the mean of the clips' figures. 0 when no channel
/// moves.
double rms_deg(const Take& reference, const Take& other, std::size_t first_frame = 0);
/// Returns the figure of each frame from `first_frame` on; their mean is `rms_deg`.
std::vector<double> rms_deg_per_frame(const Take& reference, const Take& other,
                                      std::size_t first_frame = 0);

/// Root mean square, over all joints and frames, of the angle between local rotations, in degrees.
double geodesic_rms_deg(const Take& reference, const Take& other, std::size_t first_frame = 0);
/// `geodesic_rms_deg` of each joint, J values.
std::vector<double> geodesic_rms_deg_per_joint(const Take& reference, const Take& other,
                                               std::size_t first_frame = 0);
/// A percentile (0 to 100, linear interpolation between order statistics as in NumPy) of the angles
/// between local rotations, in degrees.
double geodesic_percentile_deg(const Take& reference, const Take& other, double percentile = 99,
                               std::size_t first_frame = 0);

/// Mean distance of joint positions (end sites left out), in file units times `scale`: for a result
/// in centimetres pass the centimetres in a file unit.
double mpjpe(const Take& reference, const Take& other, std::size_t first_frame = 0,
             double scale = 1.0);

/// Mean norm, over joints and inner frames, of the difference of the second derivatives of joint
/// positions (central differences at the reference's frame rate), file units / s^2. 0 for fewer
/// than three frames.
double accel_error(const Take& reference, const Take& other, std::size_t first_frame = 0);

/// Dean 2016: 10 log10(peak^2 / MSE), the mean squared error taken over frames, joints and the
/// three channels of the logarithm of the quaternion (half the rotation vector) of reference^-1
/// other, radians. The paper does not state its peak. Default pi / 2: the largest value that a
/// channel of that logarithm takes. Infinity when the clips are the same.
double psnr_db(const Take& reference, const Take& other, std::size_t first_frame = 0,
               double peak = pi / 2);

/// Xiao et al. 2015, eq. 6: per frame the root mean squared distance of the markers, here the joint
/// positions, in metres.
MeanAndDeviation rmse_per_marker_m(const Take& reference, const Take& other, double metres_per_unit,
                                   std::size_t first_frame = 0);
/// `rmse_per_marker_m` for F x M positions in any unit. `noisy` (F x M, empty: all) is 1 for each
/// sample that was damaged: the paper divides by the number of noisy markers in the frame. Frames
/// without noisy markers are left out.
MeanAndDeviation rmse_per_marker(std::span<const Vec3> reference, std::span<const Vec3> other,
                                 std::size_t markers, std::span<const std::uint8_t> noisy = {});

/// Courty 2008, section 5: 1/N sum_{i=0}^{N} |Log(q1_i^-1 q2_i)|^2 of two signals of N + 1
/// orientations, radians^2. Log is the rotation vector, so the figure is in angles of rotation; the
/// paper's logarithm of the quaternion gives a quarter of it. As the paper writes it, the sum of N
/// + 1 terms is divided by N. A signal of one orientation is divided by 1. Errors:
/// `ErrorKind::usage` when the lengths differ.
double mse_rad2(std::span<const Quat> reference, std::span<const Quat> other);
/// Returns the mean of `mse_rad2` over joints.
double mse_rad2(const Take& reference, const Take& other, std::size_t first_frame = 0);

/// Largest angular speed of each local rotation from a frame to the next, degrees / s, noise and
/// spikes included; 0 for fewer than two frames. J values.
std::vector<double> peak_angular_speed_deg_s(const Take& clip, std::size_t first_frame = 0);

/// The joints whose travel on the floor is foot slide: heel (`foot`, `ankle`, `heel`) and toe
/// (`toe`, `ball`), found by parts of their names; case is ignored.
std::vector<std::size_t> foot_joints(const Skeleton& skeleton);

/// Horizontal travel of toes and heels in `other` while the reference is in contact with the floor.
/// Zero without contact.
FootSlide foot_slide(const Take& reference, const Take& other,
                     const FootSlideSettings& settings = {}, std::size_t first_frame = 0);

}  // namespace kinemend
