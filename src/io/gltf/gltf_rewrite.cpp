// Compares a take with its source, replaces the differences, and appends new accessors, samplers
// and channels to the file's arrays.
#include "io/gltf/gltf_rewrite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/gltf_json.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/motion/motion_write.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// The values of a track in its node's frame, and which frames differ from the source.
struct GltfValues {
  std::size_t width = 3;
  std::vector<std::array<double, 4>> frames;
  std::vector<std::uint8_t> changed;

  bool any() const { return std::find(changed.begin(), changed.end(), 1) != changed.end(); }
};

std::array<double, 4> components(Quat q) { return {q.x, q.y, q.z, q.w}; }
std::array<double, 4> components(Vec3 v) { return {v.x, v.y, v.z, 0}; }

double dot4(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

// A value to write into the bytes of a buffer.
struct GltfStored {
  GltfPlace place;
  std::array<char, 16> bytes{};  // at most four components
  std::size_t size = 0;
};

class GltfTrackValues {
 public:
  GltfTrackValues(const Take& take, const GltfMotion& source, bool same_frames)
      : take_(take), source_(source), same_frames_(same_frames) {}

  // Whether the track may differ from the source. Most tracks do not, and need not be decoded
  // again.
  bool may_change(const GltfTrack& track) const {
    if (!same_frames_ || source_.held_keys > 0 || !take_.has_joints()) return true;
    const std::size_t frames = take_.frame_count();
    const bool turns = track.path == GltfPath::rotation;
    for (std::size_t f = 0; f < frames; ++f) {
      if (turns ? !is_same_turn(f, track.owner)
                : !(take_.position(f, track.owner) == source_.take.position(f, track.owner)))
        return true;
    }
    return false;
  }

  // Returns the values of a track. `curve`: the source's curve, or null.
  GltfValues of(const GltfTrack& track, const GltfCurve* curve, const std::string& name) const {
    GltfValues values;
    values.frames.resize(take_.frame_count());
    values.changed.resize(take_.frame_count(), same_frames_ ? 0 : 1);
    if (track.path == GltfPath::rotation) {
      add_rotations(track, values);
    } else if (track.path == GltfPath::scale) {
      add_presence(track, curve, values);
    } else if (take_.has_joints()) {
      add_positions(track, curve, name, values);
    } else {
      add_markers(track, curve, name, values);
    }
    if (curve != nullptr && same_frames_) change_held_keys(track, *curve, values);
    return values;
  }

 private:
  bool is_same_turn(std::size_t frame, std::size_t joint) const {
    const Quat now = take_.rotation(frame, joint), was = source_.take.rotation(frame, joint);
    return now == was || now == -was;
  }

  void add_rotations(const GltfTrack& track, GltfValues& values) const {
    values.width = 4;
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      const Quat q = take_.rotation(f, track.owner);
      values.frames[f] = components(unit_rotation(track.rest * q));
      if (!same_frames_) continue;
      values.changed[f] = is_same_turn(f, track.owner) ? 0 : 1;
    }
  }

  void add_positions(const GltfTrack& track, const GltfCurve* curve, const std::string& name,
                     GltfValues& values) const {
    const std::vector<Vec3> kept = source_translations(curve);
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      const Vec3 p = take_.position(f, track.owner);
      if (same_frames_) values.changed[f] = p == source_.take.position(f, track.owner) ? 0 : 1;
      const bool is_kept = values.changed[f] == 0 && !kept.empty();
      // A scale of 0 is an error only if a position below it must change.
      values.frames[f] = components(is_kept                  ? kept[f]
                                    : values.changed[f] != 0 ? track.to_file(p, f, name)
                                                             : Vec3{});
    }
    if (!kept.empty() || !values.any()) return;
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      if (values.changed[f] == 0)
        values.frames[f] = components(track.to_file(take_.position(f, track.owner), f, name));
    }
  }

  // Returns the source's translations in each frame, without rounding by the conversion to the
  // take.
  std::vector<Vec3> source_translations(const GltfCurve* curve) const {
    if (curve == nullptr || !same_frames_) return {};
    return vectors_at(*curve, source_.grid.times);
  }

  // A missing marker keeps its position in the source, or its last position.
  void add_markers(const GltfTrack& track, const GltfCurve* curve, const std::string& name,
                   GltfValues& values) const {
    std::size_t first = 0;
    while (first < values.frames.size() && !take_.is_observed(first, track.owner)) ++first;
    if (first == values.frames.size()) return values.changed.assign(first, 0);
    Vec3 last = track.to_file(take_.position(first, track.owner), first, name);
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      const bool is_there = take_.is_observed(f, track.owner);
      if (is_there) last = track.to_file(take_.position(f, track.owner), f, name);
      values.frames[f] = components(last);
      if (!same_frames_) continue;
      const bool moved = !source_.take.is_observed(f, track.owner) ||
                         !(take_.position(f, track.owner) == source_.take.position(f, track.owner));
      values.changed[f] = is_there && moved ? 1 : 0;
      if (!is_there && curve != nullptr && track.has_key_each_frame)
        values.frames[f] = components(curve->vector(f));
    }
  }

  void add_presence(const GltfTrack& track, const GltfCurve* curve, GltfValues& values) const {
    Vec3 size{1, 1, 1};
    for (std::size_t k = 0; curve != nullptr && k < curve->keys(); ++k) {
      if (!(curve->vector(k) == Vec3{})) size = curve->vector(k);
    }
    bool always = true;
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      const bool is_there = take_.is_observed(f, track.owner);
      always = always && is_there;
      values.frames[f] = components(is_there ? size : Vec3{});
      if (same_frames_)
        values.changed[f] = is_there == source_.take.is_observed(f, track.owner) ? 0 : 1;
    }
    if (curve == nullptr && always) std::fill(values.changed.begin(), values.changed.end(), 0);
  }

  // Marks keys that were not finite as changed, because outputs never contain NaN or infinity.
  static void change_held_keys(const GltfTrack& track, const GltfCurve& curve, GltfValues& values) {
    if (curve.held.empty() || values.changed.empty()) return;
    if (!track.has_key_each_frame) {
      values.changed[0] = 1;
      return;
    }
    for (std::size_t f = 0; f < values.changed.size(); ++f) values.changed[f] |= curve.held[f];
  }

  const Take& take_;
  const GltfMotion& source_;
  bool same_frames_;
};

// Uses the sign of the source, so that its other keys still fit; if the rotation is very different,
// the sign of the key before.
void follow_signs(GltfValues& values, const GltfCurve& curve) {
  // Chosen by hand, not swept.
  constexpr double clear = 0.5;  // within 120 degrees
  for (std::size_t f = 0; f < values.frames.size(); ++f) {
    auto& now = values.frames[f];
    if (values.changed[f] == 0) {
      std::copy_n(curve.value(f), 4, now.begin());
      continue;
    }
    double agreement = dot4(now.data(), curve.value(f));
    if (std::fabs(agreement) < clear && f > 0)
      agreement = dot4(now.data(), values.frames[f - 1].data());
    if (agreement < 0) {
      for (double& value : now) value = -value;
    }
  }
}

void continue_signs(GltfValues& values) {
  for (std::size_t f = 1; f < values.frames.size(); ++f) {
    if (dot4(values.frames[f].data(), values.frames[f - 1].data()) >= 0) continue;
    for (double& value : values.frames[f]) value = -value;
  }
}

std::string json_of_float(float value) { return fmt::format("{}", value); }

// Returns the buffer that holds the animation.
std::size_t home_of(const GltfDocument& document) {
  for (const GltfSampler& sampler : document.model.animations[document.animation].samplers) {
    const auto view = document.model.accessors[sampler.output].view;
    if (!view || *view >= document.model.views.size()) continue;
    const std::size_t buffer = document.model.views[*view].buffer;
    if (document.buffers.is_loaded(buffer)) return buffer;
  }
  throw Error(ErrorKind::usage, fmt::format("{}: no buffer holds keys of the animation, so none "
                                            "can be added",
                                            document.file.name));
}

const char* name_of(GltfPath path) {
  if (path == GltfPath::rotation) return "rotation";
  return path == GltfPath::scale ? "scale" : "translation";
}

// Returns the changed content of a buffer, which is its content in the file at first.
std::string& changed_buffer(const GltfDocument& document, std::size_t buffer,
                            GltfChanges& changes) {
  const auto [found, is_new] = changes.buffers.try_emplace(buffer);
  if (is_new) found->second = document.buffers.bytes(document.file, buffer);
  return found->second;
}

// Collects additions; `finish` turns them into changes. Floats are appended to the buffer that
// holds the animation.
class GltfAdditions {
 public:
  GltfAdditions(const GltfDocument& document, GltfChanges& changes)
      : document_(document), changes_(changes) {
    const GltfAnimation& animation = document.model.animations[document.animation];
    views_.before = document.model.views.size();
    accessors_.before = document.model.accessors.size();
    samplers_.before = animation.samplers.size();
    channels_.before = animation.channels.size();
  }

  // Appends elements of `width` floats and returns the number of their accessor. Times get their
  // range, which glTF requires. Errors: `usage` for a value that overflows a float.
  std::size_t add_floats(const std::vector<double>& values, std::size_t width) {
    if (views_.items.empty()) home_ = home_of(document_);
    std::string& bytes = changed_buffer(document_, home_, changes_);
    bytes.append((4 - bytes.size() % 4) % 4, '\0');
    const std::size_t begin = bytes.size();
    for (const double value : values) {
      std::array<char, sizeof(float)> stored{};
      if (!store_component(value, gltf_float, false, stored.data()))
        throw Error(ErrorKind::usage, "a number is too large for a glTF file");
      bytes.append(stored.data(), stored.size());
    }
    const std::size_t view =
        views_.add(fmt::format("{{\"buffer\":{},\"byteOffset\":{},\"byteLength\":{}}}", home_,
                               begin, bytes.size() - begin));
    std::string range;
    if (width == 1 && !values.empty()) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      range = fmt::format(",\"min\":[{}],\"max\":[{}]", json_of_float(static_cast<float>(*least)),
                          json_of_float(static_cast<float>(*most)));
    }
    return accessors_.add(
        fmt::format("{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                    view, gltf_float, values.size() / width, gltf_type_of_width(width), range));
  }

  // Appends a sampler and returns its number.
  std::size_t add_sampler(std::size_t input, std::size_t output, bool in_steps) {
    return samplers_.add(fmt::format("{{\"input\":{},\"output\":{},\"interpolation\":\"{}\"}}",
                                     input, output, in_steps ? "STEP" : "LINEAR"));
  }

  void set_sampler(std::size_t channel, std::size_t sampler) {
    set_samplers_.emplace_back(channel, sampler);
  }

  // Appends a channel. A node with a matrix gets translation, rotation and scale instead, as
  // animated nodes must.
  void add_channel(std::size_t node, GltfPath path, std::size_t sampler) {
    if (document_.model.nodes[node].has_matrix) split_matrix(node);
    channels_.add(fmt::format("{{\"sampler\":{},\"target\":{{\"node\":{},\"path\":\"{}\"}}}}",
                              sampler, node, name_of(path)));
  }

  void finish() {
    const std::string_view text = document_.file.json_text();
    append(json_member(text, {"bufferViews"}), views_);
    append(json_member(text, {"accessors"}), accessors_);
    const auto animation = json_element(text, "animations", document_.animation);
    const auto member = [&](const char* key) {
      return animation ? json_member(text, *animation, key) : std::nullopt;
    };
    append(member("samplers"), samplers_);
    append(member("channels"), channels_);
    const auto channels = member("channels");
    const auto elements = channels ? json_elements(text, *channels) : std::vector<ByteSpan>{};
    for (const auto& [channel, sampler] : set_samplers_) {
      const auto place = json_member(text, elements.at(channel), "sampler");
      if (place) changes_.edits.push_back({*place, std::to_string(sampler)});
    }
    if (views_.items.empty()) return;
    const auto grown = json_element(text, "buffers", home_);
    const auto length = grown ? json_member(text, *grown, "byteLength") : std::nullopt;
    if (length) changes_.edits.push_back({*length, std::to_string(changes_.buffers[home_].size())});
  }

 private:
  // Items for an array of the file that has `before` elements.
  struct Additions {
    std::size_t before = 0;
    std::vector<std::string> items;

    std::size_t add(std::string item) {
      items.push_back(std::move(item));
      return before + items.size() - 1;
    }
  };

  void append(std::optional<ByteSpan> array, const Additions& additions) {
    if (additions.items.empty()) return;
    if (!array || array->size < 2) {
      throw Error(ErrorKind::usage, fmt::format("{}: an array that keys are added to is not there",
                                                document_.file.name));
    }
    changes_.edits.push_back(
        {{array->begin + array->size - 1, 0},
         fmt::format("{}{}", additions.before > 0 ? "," : "", fmt::join(additions.items, ","))});
  }

  void split_matrix(std::size_t node) {
    if (!split_.insert(node).second) return;
    const std::string_view text = document_.file.json_text();
    const auto object = json_element(text, "nodes", node);
    const auto matrix = object ? json_named_member(text, *object, "matrix") : std::nullopt;
    if (!matrix) return;
    const GltfNode& n = document_.model.nodes[node];
    changes_.edits.push_back(
        {matrix->whole(),
         fmt::format("\"translation\":[{},{},{}],\"rotation\":[{},{},{},{}],\"scale\":[{},{},{}]",
                     n.translation.x, n.translation.y, n.translation.z, n.rotation.x, n.rotation.y,
                     n.rotation.z, n.rotation.w, n.scale.x, n.scale.y, n.scale.z)});
  }

  const GltfDocument& document_;
  GltfChanges& changes_;
  std::size_t home_ = 0;  // the buffer that is extended
  Additions views_, accessors_, samplers_, channels_;
  std::vector<std::pair<std::size_t, std::size_t>> set_samplers_;
  std::set<std::size_t> split_;
};

class GltfRewriter {
 public:
  GltfRewriter(const Take& take, const GltfDocument& document, const GltfMotion& motion)
      : take_(take),
        document_(document),
        model_(document.model),
        motion_(motion),
        loaded_(document.buffers),
        same_frames_(take.frame_count() == motion.take.frame_count() &&
                     take.frame_rate_hz == motion.take.frame_rate_hz),
        additions_(document, changes_) {
    count_uses();
    const auto grows = [](const GltfTrack& track) { return track.scale.size() > 1; };
    if (same_frames_ || std::none_of(motion.tracks.begin(), motion.tracks.end(), grows)) return;
    throw Error(ErrorKind::usage,
                fmt::format("{}: nodes change their scale, which has no other frames than those "
                            "of the file",
                            document.file.name));
  }

  GltfChanges rewrite() {
    for (const GltfTrack& track : motion_.tracks) rewrite_track(track);
    for (const std::size_t accessor : written_) update_range(accessor);
    additions_.finish();
    return std::move(changes_);
  }

 private:
  const GltfAnimation& animation() const { return model_.animations[document_.animation]; }

  void count_uses() {
    accessor_uses_.resize(model_.accessors.size());
    sampler_uses_.resize(animation().samplers.size());
    for (const GltfAnimation& each : model_.animations) {
      for (const GltfSampler& sampler : each.samplers) {
        ++accessor_uses_[sampler.input];
        ++accessor_uses_[sampler.output];
      }
    }
    for (const std::size_t accessor : model_.used_elsewhere) {
      if (accessor < accessor_uses_.size()) ++accessor_uses_[accessor];
    }
    for (const GltfChannel& channel : animation().channels) ++sampler_uses_[channel.sampler];
  }

  const GltfSampler& sampler_of(const GltfTrack& track) const {
    return animation().samplers[animation().channels[track.channel].sampler];
  }

  void rewrite_track(const GltfTrack& track) {
    const GltfTrackValues track_values(take_, motion_, same_frames_);
    if (!track_values.may_change(track)) return;
    std::optional<GltfCurve> curve;
    if (track.channel != GltfTrack::none) {
      curve =
          read_gltf_curve(document_.file, model_, loaded_, sampler_of(track), track.path, clocks_);
    }
    GltfValues values =
        track_values.of(track, curve ? &*curve : nullptr, name_of_node(model_, track.node));
    if (!values.any()) return;
    const bool in_place = curve && track.has_key_each_frame && same_frames_;
    if (in_place && values.width == 4) follow_signs(values, *curve);
    if (in_place && write_in_place(track, *curve, values)) return;
    if (!in_place && values.width == 4) continue_signs(values);
    append_track(track, curve ? &*curve : nullptr, values, in_place);
  }

  // Returns false if the bytes are shared with other data or cannot hold the values.
  bool write_in_place(const GltfTrack& track, const GltfCurve& curve, const GltfValues& values) {
    const std::size_t accessor = sampler_of(track).output;
    const bool is_own = accessor_uses_[accessor] == 1 &&
                        sampler_uses_[animation().channels[track.channel].sampler] == 1 &&
                        is_stored_alone(model_, accessor);
    if (!is_own) return false;
    const GltfNumbers numbers(document_.file, model_, loaded_, accessor, values.width);
    const auto places = numbers.places();
    std::vector<GltfStored> stored;
    const auto store = [&](std::size_t element, const double* components) {
      return places[element] &&
             store_element(numbers.accessor(), *places[element], components, stored);
    };
    const bool is_spline = curve.interpolation == GltfInterpolation::cubic_spline;
    for (std::size_t f = 0; f < values.frames.size(); ++f) {
      if (values.changed[f] != 0 && !store(is_spline ? 3 * f + 1 : f, values.frames[f].data()))
        return false;
      if (is_spline && !store_tangents(curve, values, f, store)) return false;
    }
    for (const GltfStored& value : stored) {
      std::string& bytes = changed_buffer(document_, value.place.buffer, changes_);
      std::copy_n(value.bytes.data(), value.size,
                  bytes.begin() + static_cast<std::ptrdiff_t>(value.place.at));
    }
    written_.push_back(accessor);
    return true;
  }

  bool store_element(const GltfAccessor& accessor, GltfPlace place, const double* components,
                     std::vector<GltfStored>& stored) const {
    const std::size_t step = size_of_component(accessor.component);
    GltfStored value{place, {}, accessor.width * step};
    for (std::size_t c = 0; c < accessor.width; ++c) {
      if (!store_component(components[c], accessor.component, accessor.normalized,
                           value.bytes.data() + c * step))
        return false;
    }
    stored.push_back(value);
    return true;
  }

  // Stores tangents of keys at or beside a changed key: the slope between the neighbours, as in
  // Catmull-Rom splines.
  template <class Store>
  bool store_tangents(const GltfCurve& curve, const GltfValues& values, std::size_t f,
                      const Store& store) const {
    const std::size_t last = values.frames.size() - 1;
    const std::size_t before = f == 0 ? 0 : f - 1, after = std::min(f + 1, last);
    if ((values.changed[before] | values.changed[f] | values.changed[after]) == 0) return true;
    const double length = curve.times()[after] - curve.times()[before];
    std::array<double, 4> slope{};
    for (std::size_t c = 0; c < values.width && length > 0; ++c)
      slope[c] = (value_at(curve, values, after, c) - value_at(curve, values, before, c)) / length;
    return store(3 * f, slope.data()) && store(3 * f + 2, slope.data());
  }

  static double value_at(const GltfCurve& curve, const GltfValues& values, std::size_t f,
                         std::size_t c) {
    return values.changed[f] != 0 ? values.frames[f][c] : curve.value(f)[c];
  }

  void append_track(const GltfTrack& track, const GltfCurve* curve, const GltfValues& values,
                    bool keeps_times) {
    std::vector<double> numbers;
    for (const auto& frame : values.frames)
      numbers.insert(numbers.end(), frame.begin(),
                     frame.begin() + static_cast<std::ptrdiff_t>(values.width));
    const std::size_t output = additions_.add_floats(numbers, values.width);
    const std::size_t input = keeps_times ? sampler_of(track).input : new_times();
    const bool in_steps = curve != nullptr ? curve->interpolation == GltfInterpolation::step
                                           : track.path == GltfPath::scale;
    const std::size_t sampler = additions_.add_sampler(input, output, in_steps);
    if (curve != nullptr) {
      additions_.set_sampler(track.channel, sampler);
    } else {
      additions_.add_channel(track.node, track.path, sampler);
    }
  }

  std::size_t new_times() {
    if (new_times_) return *new_times_;
    std::vector<double> times;
    for (std::size_t f = 0; f < take_.frame_count(); ++f)
      times.push_back(motion_.grid.times.start_s + static_cast<double>(f) / take_.frame_rate_hz);
    new_times_ = additions_.add_floats(times, 1);
    return *new_times_;
  }

  // Updates the least and the largest value of each component, if the file states them.
  void update_range(std::size_t index) {
    const GltfAccessor& accessor = model_.accessors[index];
    if (!accessor.has_range) return;
    const GltfNumbers numbers(document_.file, model_, loaded_, index, accessor.width);
    const std::size_t step = size_of_component(accessor.component);
    std::vector<double> least(accessor.width, HUGE_VAL), most(accessor.width, -HUGE_VAL);
    for (const auto& place : numbers.places()) {
      for (std::size_t c = 0; c < accessor.width; ++c) {
        const double value =
            place ? read_component(changed_buffer(document_, place->buffer, changes_).data() +
                                       place->at + c * step,
                                   accessor.component, false)
                  : 0.0;
        least[c] = std::fmin(least[c], value);
        most[c] = std::fmax(most[c], value);
      }
    }
    replace_range(index, "min", least);
    replace_range(index, "max", most);
  }

  void replace_range(std::size_t accessor, const char* key, const std::vector<double>& values) {
    const std::string_view text = document_.file.json_text();
    if (accessor_texts_.empty()) {
      const auto array = json_member(text, {"accessors"});
      if (array) accessor_texts_ = json_elements(text, *array);
    }
    if (accessor >= accessor_texts_.size()) return;
    const auto place = json_member(text, accessor_texts_[accessor], key);
    if (!place) return;
    const auto stated = GltfJson::parse(text.substr(place->begin, place->size), nullptr, false);
    bool is_same = stated.is_array() && stated.size() == values.size();
    for (std::size_t c = 0; is_same && c < values.size(); ++c)
      is_same = stated[c].is_number() && stated[c].get<float>() == static_cast<float>(values[c]);
    if (is_same) return;
    std::string array;
    for (const double value : values) {
      array += array.empty() ? '[' : ',';
      array += json_of_float(static_cast<float>(value));
    }
    changes_.edits.push_back({*place, array + "]"});
  }

  const Take& take_;
  const GltfDocument& document_;
  const GltfModel& model_;
  const GltfMotion& motion_;
  GltfBuffers loaded_;
  GltfClocks clocks_;
  bool same_frames_;
  GltfChanges changes_;
  GltfAdditions additions_;
  std::vector<std::size_t> accessor_uses_, sampler_uses_;
  std::vector<std::size_t> written_;      // accessors that were written
  std::vector<ByteSpan> accessor_texts_;  // spans of accessors in the JSON, found once
  std::optional<std::size_t> new_times_;
};

}  // namespace

GltfChanges changes_of_gltf(const Take& take, const GltfDocument& document,
                            const GltfMotion& motion) {
  if (document.animation == GltfTrack::none || take.frame_count() == 0) return {};
  return GltfRewriter(take, document, motion).rewrite();
}

}  // namespace kinemend
