// Shows a take of joints or of markers as one kind of thing: a set of tracks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/source.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Where the samples of a track live: SO(3), unit quaternions; or R^3, file units.
enum class Space : std::uint8_t { rotation, position };

/// What becomes of samples that were not measured.
enum class GapTreatment : std::uint8_t {
  /// Joints: every frame needs a value, so that gaps of any length are bridged (rotations along the
  /// geodesic, positions along the line, at the ends the nearest sample).
  bridge,
  /// Markers: gaps up to 0.25 s are bridged while a track is filtered, none is filtered across that
  /// is longer, and what is missing stays missing.
  cut,
};

/// Noise that is known, in place of what a method finds. `auto` and the learned methods go by it.
struct TakeNoise {
  std::optional<double> correlation;  ///< from one measurement to the next, 0 to 0.99; 0: white
  /// J or M, per axis: degrees of joints, file units of markers; 0: as measured. Empty: all so.
  std::vector<double> strengths;
};

/// What may change. A joint's rotation, or a marker's position, and what becomes of positions of
/// joints.
struct Selection {
  std::vector<std::uint8_t> owners{};  ///< J or M, 1 where it may change; empty: all
  bool root_position = true;           ///< position of joint 0
  bool translations = true;            ///< positions of translated joints that are selected
  double body_height = 0;  ///< of the person, file units, by which markers are measured; 0: found
  TakeNoise noise{};
  Source source = Source::unknown;  ///< what recorded the take

  bool includes(std::size_t owner) const { return owners.empty() || owners[owner] != 0; }
};

/// The samples of one joint's rotation, one joint's position or one marker over all frames.
struct Track {
  Space space = Space::position;
  std::int32_t owner = -1;  ///< joint or marker; -1: the root position
  std::size_t frames = 0;
  const Quat* rotations = nullptr;  ///< of `Space::rotation`: that of frame f is [f * stride]
  const Vec3* positions = nullptr;  ///< of `Space::position`
  std::size_t stride = 1;
  const std::uint8_t* observed = nullptr;  ///< that of frame f is [f * observed_stride]; null: all
  std::size_t observed_stride = 1;
  /// The distance that counts as one radian: 1 of rotations; the mean length of the bones of
  /// joints' positions; a quarter of the body height of markers, about the length of a limb's
  /// segment.
  double radian = 1;
  double noise = 0;  ///< of each axis, where it is known: degrees or file units; 0: not known
  bool selected = true;

  Quat rotation(std::size_t frame) const { return rotations[frame * stride]; }
  Vec3 position(std::size_t frame) const { return positions[frame * stride]; }
  bool is_observed(std::size_t frame) const {
    return observed == nullptr || observed[frame * observed_stride] != 0;
  }
};

/// A take as its tracks, which refer to a clip that outlives the view. Joints: J rotations, the
/// root position, then the positions of the translated joints. Markers: M positions.
struct TakeView {
  const Take* joints = nullptr;   ///< the clip of a take of joints, else null
  const Take* markers = nullptr;  ///< that of a take of markers, else null
  std::vector<Track> tracks;
  std::size_t owners = 0;  ///< J or M: track n < owners is that of joint or marker n
  std::size_t frames = 0;
  double frame_rate_hz = 0;
  GapTreatment gaps = GapTreatment::bridge;
  /// Of markers: file units, by which distances are measured. That of joints is their skeleton's.
  double body_height = 1;
  std::optional<double> noise_correlation;  ///< `TakeNoise::correlation`
  Source source = Source::unknown;          ///< `Selection::source`

  /// The track of the root position; of joints only.
  std::size_t root_track() const noexcept { return owners; }
};

/// Markers that are no positions are never selected.
TakeView view_of(const Take& take, const Selection& selection = {});

/// `Track::radian` of the positions of a take, which is the same for all of them.
double radian_of_positions(const TakeView& take);

/// Whether a track of rotations has two samples that differ, observed or not; true of positions.
bool moves(const Track& track);
/// The tracks that are selected, were observed at all and, of rotations, have two samples that
/// differ, in their order.
std::vector<std::size_t> changeable_tracks(const TakeView& take);

/// Samples of a track as they stand; none of a track of the other space.
std::vector<Quat> rotations_of(const Track& track);
std::vector<Vec3> positions_of(const Track& track);
/// One mark a frame; empty where all were observed.
std::vector<std::uint8_t> observed_of(const Track& track);

/// Writes samples of track `track` of the clip that a view was made of, from frame `first` on.
void set_track(Take& take, std::size_t track, std::span<const Quat> samples, std::size_t first = 0);
void set_track(Take& take, std::size_t track, std::span<const Vec3> samples, std::size_t first = 0);

/// Mean length of the bones (offsets that are not zero), file units; 1 when there are none. It puts
/// positions and rotations on one scale: a turn of one radian moves a bone's end by about this.
double typical_bone_length(const Skeleton& skeleton);

}  // namespace kinemend
