// Fills the parameter groups from the take and from its source file.
#include "io/c3d/c3d.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "io/c3d/c3d_parameters.hpp"

namespace kinemend {

namespace {

// For speed, not swept.
constexpr std::size_t most_frames_looked_at = 200;

// Makes a parameter of the low and the high word of a frame's number.
C3dParameter frame_field(const char* name, std::int64_t frame) {
  const auto number = static_cast<std::uint64_t>(std::clamp<std::int64_t>(frame, 0, 0xFFFFFFFF));
  return c3d_integers(name,
                      {static_cast<double>(number & 0xFFFF), static_cast<double>(number >> 16)});
}

// Returns the extents of the markers along y and z, summed over some frames.
std::array<double, 2> extents(const Take& clip) {
  std::array<double, 2> sums{};
  const std::size_t stride = clip.frame_count() / most_frames_looked_at + 1;
  for (std::size_t f = 0; f < clip.frame_count(); f += stride) {
    Vec3 low, high;
    bool any = false;
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      if (!clip.is_observed(f, m) || !clip.holds_positions(m)) continue;
      const Vec3 p = clip.position(f, m);
      low = any ? Vec3{0, std::min(low.y, p.y), std::min(low.z, p.z)} : p;
      high = any ? Vec3{0, std::max(high.y, p.y), std::max(high.z, p.z)} : p;
      any = true;
    }
    if (any) sums = {sums[0] + high.y - low.y, sums[1] + high.z - low.z};
  }
  return sums;
}

class ParameterMaker {
 public:
  ParameterMaker(const Take& clip, const C3dOrigin& origin, const C3dNewFile& file)
      : clip_(clip), source_(origin.document), change_(origin.change), file_(file) {
    if (source_ != nullptr) all_ = source_->parameters;
    part_groups();
  }

  C3dParameters make() {
    describe_points();
    describe_kinds();
    describe_screen();
    describe_trial();
    describe_analog();
    describe_plates();
    describe_events();
    // The data of these groups is not kept.
    remove_group(all_, "ROTATION");
    remove_group(all_, "DATA_BLOCKS");
    return std::move(all_);
  }

 private:
  // Removes groups whose number is taken: in damaged files two groups share a number, and a value
  // written to one would appear in both.
  void part_groups() {
    std::set<std::int32_t> numbers;
    std::erase_if(all_.groups,
                  [&](const C3dGroup& group) { return !numbers.insert(group.number).second; });
  }

  bool has_source_names() const { return source_ != nullptr && source_->names == clip_.names; }

  void describe_points() {
    const auto frames = static_cast<double>(file_.frame_count);
    constexpr auto most_counted_frames = static_cast<double>(most_in_a_word);
    set("POINT", c3d_integer("USED", static_cast<double>(clip_.marker_count())));
    set("POINT", c3d_integer("FRAMES", std::min(frames, most_counted_frames)));
    remove_parameter(all_, "POINT", "LONG_FRAMES");
    if (frames > most_counted_frames) set("POINT", c3d_real("LONG_FRAMES", frames));
    set("POINT", c3d_integer("DATA_START", 0));
    set("POINT", c3d_real("SCALE", -file_.scale));
    set("POINT", c3d_real("RATE", clip_.frame_rate_hz));
    if (source_ == nullptr || source_->unit != clip_.unit) {
      if (!clip_.unit.empty()) set("POINT", c3d_text("UNITS", clip_.unit));
      if (clip_.unit.empty()) remove_parameter(all_, "POINT", "UNITS");
    }
    if (has_source_names()) return;
    set_texts(all_, "POINT", "LABELS", clip_.names);
    set_texts(all_, "POINT", "DESCRIPTIONS", std::vector<std::string>(clip_.marker_count()));
  }

  // The source's lists (ANGLES, FORCES, ...) are valid as long as the names are the same.
  void describe_kinds() {
    if (has_source_names()) return;
    for (const char* const list :
         {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS", "TYPE_GROUPS"}) {
      remove_parameter(all_, "POINT", list);
    }
    std::vector<std::string> others;
    for (std::size_t m = 0; m < clip_.marker_count(); ++m) {
      if (!clip_.holds_positions(m)) others.push_back(clip_.names[m]);
    }
    if (!others.empty()) set_texts(all_, "POINT", "SCALARS", others);
  }

  // Returns the axis nearest to a rotated axis, with its sign ("+X", or "X" if the source writes no
  // plus).
  std::string turned_axis(std::string_view axis) const {
    const bool negative = axis.substr(0, 1) == "-";
    const bool has_sign = negative || axis.substr(0, 1) == "+";
    const std::size_t index = std::string_view("XYZ").find(axis.substr(has_sign ? 1 : 0));
    if (axis.size() != (has_sign ? 2 : 1) || index > 2) return std::string(axis);
    const Vec3 v = negative ? -change_.axes[index] : change_.axes[index];
    const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
    const char letter = x >= y && x >= z ? 'X' : y >= z ? 'Y' : 'Z';
    const bool is_negative = (letter == 'X' ? v.x : letter == 'Y' ? v.y : v.z) < 0;
    std::string turned = is_negative ? "-" : has_sign || negative ? "+" : "";
    turned += letter;
    return turned;
  }

  // Sets the up direction of the screen. Only a source states it; otherwise it is the direction in
  // which the person is tallest.
  void describe_screen() {
    if (all_.find("POINT", "X_SCREEN") != nullptr || all_.find("POINT", "Y_SCREEN") != nullptr) {
      for (const char* const name : {"X_SCREEN", "Y_SCREEN"}) {
        const std::string axis = all_.text("POINT", name);
        if (const std::string turned = turned_axis(axis); turned != axis)
          set("POINT", c3d_text(name, turned));
      }
      return;
    }
    const auto [along_y, along_z] = extents(clip_);
    set("POINT", c3d_text("X_SCREEN", "+X"));
    set("POINT", c3d_text("Y_SCREEN", along_y > along_z ? "+Y" : "+Z"));
  }

  void describe_trial() {
    const std::int64_t first = std::max<std::int64_t>(clip_.first_frame, 0);
    const auto frames = static_cast<std::int64_t>(file_.frame_count);
    set("TRIAL", frame_field("ACTUAL_START_FIELD", first));
    set("TRIAL", frame_field("ACTUAL_END_FIELD", first + frames - 1));
    // The cameras' own rate is kept, unless it only repeats the rate of the points.
    const auto cameras = all_.number("TRIAL", "CAMERA_RATE");
    if (source_ == nullptr || (cameras && *cameras == source_->layout.rate_hz &&
                               clip_.frame_rate_hz != source_->frame_rate_hz)) {
      set("TRIAL", c3d_real("CAMERA_RATE", clip_.frame_rate_hz));
    }
  }

  void describe_analog() {
    if (file_.analog_count > 0) {
      set("ANALOG", c3d_integer("USED", static_cast<double>(file_.analog_count)));
      set("ANALOG",
          c3d_real("RATE", clip_.frame_rate_hz * static_cast<double>(file_.analog_instants)));
      return;
    }
    const bool left_out = source_ != nullptr && source_->layout.analog_values > 0;
    if (left_out) {
      remove_group(all_, "ANALOG");
      remove_group(all_, "FORCE_PLATFORM");
    }
    set("ANALOG", c3d_integer("USED", 0));
    set("ANALOG", c3d_real("RATE", clip_.frame_rate_hz));
    const auto set_if_missing = [&](const char* group, C3dParameter parameter) {
      if (all_.find(group, parameter.name) == nullptr) set(group, std::move(parameter));
    };
    set_if_missing("ANALOG", c3d_real("GEN_SCALE", 1));
    set_if_missing("FORCE_PLATFORM", c3d_integer("USED", 0));
  }

  // Calls `action` with the values of NAME, NAME2, ...
  template <class Action>
  void change_numbers(std::string_view group, const std::string& name, std::optional<C3dType> type,
                      Action action) {
    std::string part = name;
    for (int number = 2; const C3dParameter* const found = all_.find(group, part); ++number) {
      C3dParameter& parameter = all_.entries[static_cast<std::size_t>(found - all_.entries.data())];
      action(parameter.numbers);
      if (type) parameter.type = *type;
      part = name + std::to_string(number);
    }
  }

  // Corners are in the laboratory's frame; ORIGIN is along the plate's own axes. Both are in the
  // unit of the points. The plates' measurements, including moments, have the units of the analog
  // channels.
  void describe_plates() {
    const double factor = change_.length_factor;
    if (change_.moves()) {
      change_numbers("FORCE_PLATFORM", "CORNERS", C3dType::real, [&](std::vector<double>& values) {
        for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
          const Vec3 corner = change_.moved({values[i], values[i + 1], values[i + 2]});
          values[i] = corner.x;
          values[i + 1] = corner.y;
          values[i + 2] = corner.z;
        }
      });
    }
    if (factor != 1) {
      change_numbers("FORCE_PLATFORM", "ORIGIN", C3dType::real, [&](std::vector<double>& values) {
        for (double& value : values) value *= factor;
      });
    }
    if (!change_.resampled) return;
    // Frames in which the plates are unloaded, from 1.
    const double frames = clip_.frame_rate_hz / source_->frame_rate_hz;
    change_numbers("FORCE_PLATFORM", "ZERO", std::nullopt, [&](std::vector<double>& values) {
      for (double& value : values) value = value > 0 ? std::round(1 + (value - 1) * frames) : value;
    });
  }

  void describe_events() {
    if (source_ != nullptr && same_c3d_events(clip_.events, source_->events)) return;
    if (has_only_other_times()) return set_times();
    remove_group(all_, "EVENTS");
    std::vector<std::string> labels, contexts;
    for (const MarkerEvent& event : clip_.events) {
      labels.push_back(event.label);
      contexts.push_back(event.context);
    }
    for (const char* const list :
         {"CONTEXTS", "LABELS", "TIMES", "SUBJECTS", "DESCRIPTIONS", "ICON_IDS", "GENERIC_FLAGS"}) {
      remove_parameter(all_, "EVENT", list);
    }
    set("EVENT", c3d_integer("USED", static_cast<double>(clip_.events.size())));
    if (clip_.events.empty()) return;
    set_texts(all_, "EVENT", "CONTEXTS", contexts);
    set_texts(all_, "EVENT", "LABELS", labels);
    set_times();
  }

  // Whether the events are the source's, at other times.
  bool has_only_other_times() const {
    if (source_ == nullptr || clip_.events.empty() ||
        clip_.events.size() != source_->events.size() ||
        all_.count("EVENT", "USED").value_or(0) != clip_.events.size()) {
      return false;
    }
    return std::equal(clip_.events.begin(), clip_.events.end(), source_->events.begin(),
                      [](const MarkerEvent& a, const MarkerEvent& b) {
                        return a.label == b.label && a.context == b.context;
                      });
  }

  void set_times() {
    std::vector<double> times;
    for (const MarkerEvent& event : clip_.events) {
      const double minutes = std::floor(event.time_s / 60);
      times.insert(times.end(), {minutes, event.time_s - 60 * minutes});
    }
    remove_parameter(all_, "EVENT", "TIMES");
    constexpr std::size_t most = 255;
    for (std::size_t first = 0, part = 1; first < clip_.events.size(); first += most, ++part) {
      const auto begin = times.begin() + static_cast<std::ptrdiff_t>(2 * first);
      const auto count =
          static_cast<std::ptrdiff_t>(2 * std::min(most, clip_.events.size() - first));
      set("EVENT", c3d_reals(part == 1 ? "TIMES" : "TIMES" + std::to_string(part),
                             {begin, begin + count}, 2));
    }
  }

  void set(const char* group, C3dParameter parameter) {
    set_parameter(all_, group, std::move(parameter));
  }

  const Take& clip_;
  const C3dDocument* source_;
  const TakeChange& change_;
  const C3dNewFile& file_;
  C3dParameters all_;
};

}  // namespace

C3dParameters new_c3d_parameters(const Take& clip, const C3dOrigin& origin,
                                 const C3dNewFile& file) {
  return ParameterMaker(clip, origin, file).make();
}

}  // namespace kinemend
