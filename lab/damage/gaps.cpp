// Damages that lose spans of samples: frozen spans, random gaps, and gaps of a given length.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

namespace {

const std::vector<std::string> hold_choices{"last", "rest"};

/// Frames [first, last).
struct Span {
  std::size_t first = 0, last = 0;
};

// The values in a span: that of the frame before it ("last"; at the start of the take the rest
// pose) or the rest pose.
struct Filling {
  bool rest = false;
  bool mark = true;  // as not observed
};

// Returns the length of a span, geometric with the given mean.
std::size_t random_length(Random& random, double mean_frames, std::size_t longest) {
  if (mean_frames <= 1) return 1;
  const double length =
      1 + std::floor(portable::log1p(-random.uniform()) / portable::log1p(-1 / mean_frames));
  return length < static_cast<double>(longest) ? static_cast<std::size_t>(length) : longest;
}

// Begins a span with the given probability at each frame whose predecessor is not in a span.
std::vector<Span> random_spans(Random random, std::size_t first_frame, std::size_t frames,
                               double start_probability, double mean_frames) {
  std::vector<Span> spans;
  for (std::size_t f = first_frame; f < frames; ++f) {
    if (!random.chance(start_probability)) continue;
    const std::size_t length = std::min(random_length(random, mean_frames, frames), frames - f);
    spans.push_back({f, f + length});
    f += length;  // keeps the frame after a span outside of spans
  }
  return spans;
}

void mark_lost(Take& clip, std::size_t frame, std::size_t joint) {
  if (clip.observed.empty()) clip.observed.assign(clip.rotations.size(), 1);
  clip.observed[frame * clip.joint_count() + joint] = 0;
}

void lose_joint(Take& clip, std::size_t joint, const std::vector<Span>& spans, Filling filling) {
  for (const Span span : spans) {
    const Quat value =
        filling.rest || span.first == 0 ? Quat{} : clip.rotation(span.first - 1, joint);
    for (std::size_t f = span.first; f < span.last; ++f) {
      clip.rotation(f, joint) = value;
      if (filling.mark) mark_lost(clip, f, joint);
    }
  }
}

void lose_channel(Take& clip, std::size_t joint, std::size_t channel,
                  const std::vector<Span>& spans, Filling filling) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  const auto track = euler_track(clip, joint);
  for (const Span span : spans) {
    const double value = filling.rest || span.first == 0 ? 0.0 : track[span.first - 1][channel];
    for (std::size_t f = span.first; f < span.last; ++f) {
      auto angles = track[f];
      angles[channel] = value;
      clip.rotation(f, joint) = from_euler(angles, order);
      if (filling.mark) mark_lost(clip, f, joint);
    }
  }
}

// Returns the last sample before a span; zero if no earlier sample was seen.
Vec3 last_seen(const VectorMotion& motion, std::size_t track, std::size_t first) {
  for (std::size_t f = first; f-- > 0;) {
    if (is_observed(motion, f, track)) return vector_at(motion, f, track);
  }
  return {};
}

// `channel`: -1 for all three.
void lose_vector(VectorMotion& motion, std::size_t track, int channel,
                 const std::vector<Span>& spans, Filling filling) {
  for (const Span span : spans) {
    const Vec3 held = filling.rest ? Vec3{} : last_seen(motion, track, span.first);
    for (std::size_t f = span.first; f < span.last; ++f) {
      if (!is_observed(motion, f, track)) continue;
      Vec3 value = vector_at(motion, f, track);
      if (channel < 0 || channel == 0) value.x = held.x;
      if (channel < 0 || channel == 1) value.y = held.y;
      if (channel < 0 || channel == 2) value.z = held.z;
      set_vector(motion, f, track, value);
    }
  }
  if (!filling.mark) return;
  for (const Span span : spans) {
    for (std::size_t f = span.first; f < span.last; ++f)
      motion.observed[f * motion.track_count() + track] = 0;
  }
}

void lose(VectorMotion& motion, const Unit& unit, const std::vector<Span>& spans, Filling filling) {
  for (const std::size_t n : unit.joints) lose_vector(motion, n, unit.channel, spans, filling);
}

void lose(Take& clip, const Unit& unit, const std::vector<Span>& spans, Filling filling) {
  for (const std::size_t j : unit.joints) {
    if (unit.channel < 0) {
      lose_joint(clip, j, spans, filling);
    } else {
      lose_channel(clip, j, static_cast<std::size_t>(unit.channel), spans, filling);
    }
  }
}

// Returns a generator for each unit, independent of which other joints are selected.
Random unit_random(const Random& random, const Unit& unit) {
  return random.fork(unit.joints.front())
      .fork(static_cast<std::uint64_t>(std::int64_t{unit.channel} + 1));
}

struct GapOptions : TargetOptions {
  GapOptions() { root = false; }
  std::string scope = "joint";
  std::string hold = "last";
};

template <class Options>
OptionTable<Options>& add_scope(OptionTable<Options>& table, const char* help) {
  return table.choice(&Options::scope, "scope", scopes,
                      std::string(help) + "; for markers, joint and limb mean single markers");
}

template <class Options>
OptionTable<Options>& add_hold(OptionTable<Options>& table) {
  return table.choice(&Options::hold, "hold", hold_choices,
                      "what stands in a gap: the last value seen, or the rest pose");
}

struct Frozen {
  static constexpr auto name = "frozen";
  static constexpr auto summary =
      "spans in which the value of the frame before is repeated, unmarked";
  static constexpr auto paper = "";
  struct Options : GapOptions {
    double share = 0.05;
    double mean_length_s = 0.2;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::share, "share", "", 0, 0.9, "share of frames that are frozen");
      t.number(&Options::mean_length_s, "mean_length_s", "s", 0, 1e4,
               "mean length of a span (at least a frame)");
      return add_target_options(add_scope(t, "what freezes at once"));
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes& notes) {
    const double mean_frames = std::max(1.0, options.mean_length_s * motion.frame_rate_hz);
    // A span and the frame it repeats last mean_frames + 1; the wait for the next start adds 1/p -
    // 1.
    double start = options.share / std::max(mean_frames * (1 - options.share), 1e-9);
    if (start > 1) {
      start = 1;
      notes.push_back(fmt::format("spans of {:.3g} frames freeze {:.3g} of the frames at most",
                                  mean_frames, mean_frames / (mean_frames + 1)));
    }
    for (const Unit& unit : units(motion, options, options.scope)) {
      lose(motion, unit,
           random_spans(unit_random(random, unit), 1, frame_count(motion), start, mean_frames),
           {false, false});
    }
  }
};

struct Gaps {
  static constexpr auto name = "gaps";
  static constexpr auto summary = "gaps at random, their lengths decaying exponentially";
  static constexpr auto paper =
      "Mall et al. 2017, section 4 (10 % start probability); Lou & Chai 2010, section 3.5";
  struct Options : GapOptions {
    double start_probability = 0.1;
    double mean_length_s = 0.025;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::start_probability, "start_probability", "", 0, 1,
               "chance that a gap begins at a frame, for each channel, joint or limb; a frame is "
               "seen between two gaps");
      t.number(&Options::mean_length_s, "mean_length_s", "s", 0, 1e4,
               "mean length of a gap (at least a frame)");
      return add_target_options(add_hold(
          add_scope(t, "what is lost at once; the mask of observed samples knows joints only")));
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double mean_frames = std::max(1.0, options.mean_length_s * motion.frame_rate_hz);
    for (const Unit& unit : units(motion, options, options.scope)) {
      lose(motion, unit,
           random_spans(unit_random(random, unit), 0, frame_count(motion),
                        options.start_probability, mean_frames),
           {options.hold == "rest", true});
    }
  }
};

struct LongGap {
  static constexpr auto name = "long-gap";
  static constexpr auto summary = "gaps of a given length";
  static constexpr auto paper = "Mall et al. 2017, section 4.2 (gaps of 2 to 5 s)";
  struct Options : GapOptions {
    Options() { scope = "limb"; }
    double length_s = 1;
    std::int64_t count = 1;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::length_s, "length_s", "s", 0, 1e4, "length of a gap (at least a frame)");
      t.integer(&Options::count, "count", "", 0, 100000,
                "how many gaps, at random times and places; they may overlap");
      return add_target_options(add_hold(add_scope(t, "what is lost at once")));
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes& notes) {
    const auto places = units(motion, options, options.scope);
    const std::size_t frames = frame_count(motion);
    if (frames < 3 || places.empty()) {
      notes.emplace_back("no room for a gap with a seen frame on either side");
      return;
    }
    const double wanted = std::max(1.0, std::round(options.length_s * motion.frame_rate_hz));
    const auto length = static_cast<std::size_t>(std::min(wanted, static_cast<double>(frames - 2)));
    if (static_cast<double>(length) < wanted) {
      notes.push_back(
          fmt::format("gaps are {} frames long, not {}: the clip is too short", length, wanted));
    }
    for (std::int64_t gap = 0; gap < options.count; ++gap) {
      Random own = random.fork(static_cast<std::uint64_t>(gap));
      const Unit& unit = places[own.below(places.size())];
      const std::size_t first = 1 + own.below(frames - 1 - length);
      lose(motion, unit, {{first, first + length}}, {options.hold == "rest", true});
    }
  }
};

}  // namespace

void add_gaps(std::vector<Damage>& table) {
  table.push_back(entry<Frozen>());
  table.push_back(entry<Gaps>());
  table.push_back(entry<LongGap>());
}

}  // namespace kinemend::corrupt
