#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"

// Feet on the floor: when they stand, how they slide, and how to stop them sliding.
namespace kinemend {

/// The point of a foot that a contact holds.
enum class FootPart : std::uint8_t { heel, toe };
std::string_view to_string(FootPart part);

/// A foot of a skeleton and the joints that move it.
struct Leg {
  std::string side;  ///< "left", "right", or the ankle's name where there are no two
  std::int32_t hip = 0;
  std::int32_t knee = 0;
  std::int32_t ankle = 0;
  std::int32_t toe = -1;  ///< joint; -1 where the foot ends at an end site, or at the ankle
};
/// By names and topology. Errors: none; skeletons without legs have none.
std::vector<Leg> find_legs(const Skeleton& skeleton);

/// A time in which a part of a foot stands.
struct FootContact {
  std::size_t leg = 0;  ///< index into `find_legs`
  FootPart part = FootPart::heel;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
};

struct ContactSettings {
  /// A part is down where it is lower than `begin_height` and slower than `begin_speed`, and stays
  /// down while below the others (statures above its level; statures a second).
  double begin_height = 0.015, keep_height = 0.03;
  double begin_speed = 0.15, keep_speed = 0.25;
  double least_s = 0.05;  ///< shorter contacts are none, shorter lifts are bridged
};
/// By leg, part, then frame. The floor may be at any height, and steps and ramps are levels too.
std::vector<FootContact> find_contacts(const Clip& clip, const ContactSettings& settings = {});

/// Contacts as text, one a line: `left heel 12 40`, frames from 1; `#` starts a comment. Edited by
/// hand and read back.
std::string contacts_text(const Clip& clip, const std::vector<FootContact>& contacts);
/// Errors: `ErrorKind::unreadable_input`, `<name>:<line>: ...`.
std::vector<FootContact> parse_contacts(std::string_view text, std::string_view name,
                                        const Clip& clip);

enum class FeetMode : std::uint8_t {
  off,
  automatic,  ///< contacts whose slide is an error: an intended slide is left alone
  force       ///< every contact
};

struct FeetSettings {
  FeetMode mode = FeetMode::automatic;
  ContactSettings contact;
  /// Instead of those found; frames of the whole take.
  std::optional<std::vector<FootContact>> contacts;
  double blend_s = 0.15;       ///< in which a correction fades out beside a contact
  double most_stretch = 0.02;  ///< share by which a leg's bones may lengthen before the root moves
};

/// Feet of a clip, for the report. Lengths in file units.
struct FeetFigures {
  double slide = 0;         ///< mean horizontal travel a frame of parts in contact
  double most_slide = 0;    ///< longest travel within one contact
  double sink = 0;          ///< deepest below the floor
  double knee_pop_deg = 0;  ///< largest second difference of a knee's angle
};

struct FeetReport {
  std::vector<FootContact> contacts;  ///< all
  std::vector<std::uint8_t> held;     ///< one a contact, 1 where the slide was taken out
  std::vector<std::string> reasons;   ///< one a contact: why it was not held; empty where held
  FeetFigures before, after;
  std::vector<std::uint8_t> changed;       ///< F x J, 1 where a rotation changed
  std::vector<std::uint8_t> root_changed;  ///< F
  std::vector<std::string> warnings;
};

/// Stops feet in contact from sliding, after Kovar, Schreiner & Gleicher 2002, "Footskate cleanup
/// for motion capture editing": place each contact, move the root so that all feet reach, solve
/// each leg, lengthen its bones a little rather than let the knee pop (of files that cannot hold
/// lengths: bring the root nearer), and blend at the ends. Nothing outside contacts and their
/// blends changes. Errors: `ErrorKind::usage` for settings out of range, and contacts of legs or
/// frames that there are not.
FeetReport clean_feet(Clip& clip, const FeetSettings& settings = {});

/// The figures of a clip under given contacts.
FeetFigures feet_figures(const Clip& clip, const std::vector<FootContact>& contacts);

}  // namespace kinemend
