// The table of all methods, with their rules and the functions that fill joints and markers, and
// the methods that fill a track from its own samples.
#include "fill/methods.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fill/curves.hpp"
#include "fill/samples.hpp"
#include "kinemend/error.hpp"

namespace kinemend::fill {

namespace {

constexpr bool yes = true, no = false;

// `about`: name, summary, paper, rules, markers, joints. `joint_rules`: place, kind, usual errors.
constexpr std::array methods = {
    Method{
        .about =
            {"auto",
             "tests the other methods on artificial gaps in the take and uses the best of them", "",
             "markers: the expected error is at most an eighth of the body's radius; joints: the "
             "chosen method accepts the gap and the expected error is at most 12.5 degrees "
             "(positions: 6 % of the skeleton's height)",
             yes, yes},
        .fill_marker = fill_by_auto},
    Method{.about = {"spline", "natural cubic spline through the samples around the gap", "",
                     "both ends are observed; at most 0.25 s", yes, yes},
           .curve = Curve::cubic,
           .joint_rules = {3, CandidateKind::spline, {1.02, 1.02, 1.03, 1.5, 1.6, 1.9}}},
    Method{
        .about =
            {"quintic", "quintic smoothing spline; cross-validation sets how much it smooths",
             "Woltring 1986, A FORTRAN package for generalized, cross-validatory spline smoothing "
             "and differentiation",
             "both ends are observed; at most 0.25 s", yes, yes},
        .curve = Curve::quintic,
        .joint_rules = {4, CandidateKind::curve, {0.87, 0.86, 0.88, 1.6, 2.0, 2.8}}},
    Method{.about = {"pchip", "shape-preserving cubic that does not overshoot",
                     "Fritsch & Carlson 1980, Monotone piecewise cubic interpolation",
                     "both ends are observed; at most 0.25 s", yes, yes},
           .curve = Curve::shape_preserving,
           .joint_rules = {5, CandidateKind::curve, {0.88, 0.8, 0.84, 0.91, 0.91, 0.95}}},
    Method{.about = {"hermite",
                     "cubic from the position and velocity at one end to those at the other; the "
                     "velocities fade in long gaps",
                     "", "at most 0.25 s; joints: at most 0.1 s at an end of the take", yes, yes},
           .curve = Curve::hermite,
           .joint_rules = {6, CandidateKind::curve, {0.95, 0.92, 0.77, 0.93, 0.97, 1.0}}},
    Method{.about = {"slerp", "shortest turn from one end to the other, at constant speed",
                     "Shoemake 1985, Animating rotation with quaternion curves",
                     "both ends are observed; at most 0.25 s", no, yes},
           .curve = Curve::linear,
           .joint_rules = {1, CandidateKind::line, {1, 1, 1, 1, 1, 1}}},
    Method{.about = {"squad", "smooth turn through the samples around the gap",
                     "Shoemake 1987, Quaternion calculus and fast animation",
                     "both ends are observed; at most 0.25 s", no, yes},
           .fill_joint = fill_by_squad,
           .joint_rules = {2, CandidateKind::curve, {0.95, 1.0, 0.8, 1.1, 1.15, 1.3}}},
    Method{
        .about =
            {"pattern",
             "copies the movement of a named marker (the donor) and moves it to meet both ends", "",
             "the donor is observed throughout the gap, and the marker with it at both ends; any "
             "length",
             yes, no},
        .fill_marker = fill_by_pattern},
    Method{
        .about =
            {"rigid-body", "moves the marker with three or more markers of the same body segment",
             "Horn 1987, Closed-form solution of absolute orientation using unit quaternions",
             "three markers that are not on one line are observed throughout the gap, and their "
             "distances to the marker vary by at most 2 % of the body's radius; any length",
             yes, no},
        .fill_marker = fill_by_rigid_body},
    Method{
        .about =
            {"pca", "regression on the principal components of the take",
             "Gloersen & Federolf 2016, Predicting missing marker trajectories in human motion "
             "data using marker intercorrelations",
             "markers: three others are observed throughout the gap, and 30 other frames show them "
             "and the marker; any length. Joints: four others are observed throughout the gap, "
             "and other frames show all of them for 0.5 s and as long as the gap; at most 5 s",
             yes, yes},
        .fill_joint = fill_by_poses,
        .fill_marker = fill_by_pca,
        .joint_rules = {8,
                        CandidateKind::model,
                        {0.98, 0.93, 0.8, 0.72, 0.6, 0.55},
                        5.0,
                        1.0,
                        false,
                        "too few other joints or frames are observed to predict the joint"}},
    Method{.about =
               {"local-regression",
                "predicts the marker from those that keep their distance to it, by several "
                "regressions weighted by likelihood",
                "Tits, Tilmanne & Dutoit 2018, Robust and automatic motion-capture data recovery "
                "using soft skeleton constraints and model averaging",
                "three other markers are observed throughout the gap, and 8 other frames show them "
                "and the marker; any length",
                yes, no},
           .fill_marker = fill_by_local_regression},
    Method{
        .about = {"cyclic", "copies the same phase of other cycles of the movement", "",
                  "at two other times of the take, the movement beside the gap is the same within "
                  "35 % of its size",
                  yes, yes},
        .fill_joint = fill_joint_by_cycles,
        .fill_marker = fill_marker_by_cycles,
        .joint_rules = {7,
                        CandidateKind::model,
                        {0.88, 0.8, 0.8, 0.85, 0.85, 0.9},
                        2.0,
                        1.0,
                        true,
                        "no other part of the take moves like the frames around the gap"}},
    Method{
        .about =
            {"recurrent",
             "neural network, trained on takes with gaps, that reads all joints before and after "
             "the gap; needs --model",
             "Mall et al. 2017, A deep recurrent framework for cleaning motion capture "
             "data (EBD)",
             "the model knows the joint, and the take has the model's frame rate; at most 5 s, "
             "or 1 s at an end of the take. auto fills the rest: the root, positions, joints "
             "that the model does not know, takes at other rates",
             no, yes, yes},
        .joint_rules = {.longest_s = 5.0, .longest_at_end_s = 1.0, .positions = false},
        .model = &FillModels::recurrent},
    Method{.about =
               {"learned",
                "network of the cleaner of this name, which reads the whole take; moved to meet "
                "both ends",
                "",
                "rotations; the take lasts half a second at least, at 20 Hz or more; at most 2 s, "
                "or 1 s at an end of the take. auto fills the rest: positions, shorter and "
                "slower takes",
                no, yes, yes},
           .joint_rules = {.longest_s = 2.0, .longest_at_end_s = 1.0, .positions = false},
           .model = &FillModels::learned},
};

}  // namespace

std::vector<const Method*> joint_methods() {
  std::vector<const Method*> found;
  for (const Method& method : methods) {
    if (method.joint_rules.place > 0) found.push_back(&method);
  }
  std::sort(found.begin(), found.end(), [](const Method* a, const Method* b) {
    return a->joint_rules.place < b->joint_rules.place;
  });
  return found;
}

const Method& find_method(std::string_view name, bool of_joints) {
  std::vector<std::string_view> known;
  for (const Method& method : methods) {
    if (!(of_joints ? method.about.joints : method.about.markers)) {
      if (method.about.learned && method.about.name == name)
        throw Error(ErrorKind::usage,
                    fmt::format("fill: the method {} fills joints: its networks are trained on "
                                "rotations, and this is a take of markers",
                                name));
      continue;
    }
    if (method.about.name == name) return method;
    known.push_back(method.about.name);
  }
  if (of_joints) {
    known.resize(1);
    for (const Method* method : joint_methods()) known.push_back(method->about.name);
    for (const Method& method : methods) {
      if (method.about.learned) known.push_back(method.about.name);
    }
  }
  throw Error(ErrorKind::usage,
              fmt::format("fill: expected a method for {} ({}), found \"{}\"",
                          of_joints ? "joints" : "markers", fmt::join(known, ", "), name));
}

void check_model(const Method& method, const FillModels& models) {
  if (method.model == nullptr || models.*method.model) return;
  if (method.model == &FillModels::learned)
    throw Error(ErrorKind::usage, "fill: the method learned needs its model: FillModels::learned");
  throw Error(ErrorKind::usage,
              fmt::format("fill: the method {0} needs a model that fills gaps: --model FILE; none "
                          "ships, and kinemend-train paper --network ebd --head pose makes one of "
                          "takes without gaps",
                          method.about.name));
}

const LearnedFill* model_of(const Method& method, const FillModels& models) {
  return method.model == nullptr ? nullptr : &(models.*method.model);
}

bool fill_joint(const Method& method, Track& track, FrameSpan span, const JointContext& context) {
  return method.curve ? fill_with_curve(track, span, *method.curve, context.curve())
                      : method.fill_joint(track, span, context);
}

Filling fill_marker(const Method& method, const Samples& samples, const MarkerGap& gap,
                    const GapRequest& request) {
  return method.curve ? fill_by_curve(samples, gap, request, *method.curve, method.about.name)
                      : method.fill_marker(samples, gap, request);
}

}  // namespace kinemend::fill

namespace kinemend {

std::span<const FillMethod> fill_methods() {
  static const std::vector<FillMethod> all = [] {
    std::vector<FillMethod> found;
    found.reserve(fill::methods.size());
    for (const fill::Method& method : fill::methods) found.push_back(method.about);
    return found;
  }();
  return all;
}

std::size_t FillReport::filled() const {
  return static_cast<std::size_t>(
      std::count_if(gaps.begin(), gaps.end(), [](const GapOutcome& gap) { return gap.filled; }));
}

std::size_t FillReport::refused() const { return gaps.size() - filled(); }

}  // namespace kinemend

namespace kinemend::fill {

namespace {

// Not swept. The number of other cycles that a method needs.
constexpr std::size_t least_cycles_of_joints = 1, least_cycles_of_markers = 2;
constexpr std::size_t most_cycle_companions = 12,
                      most_cycle_shape_frames = 128;  // of a mean shape

}  // namespace

// squad (Shoemake 1987): slerp(slerp(a, b, t), slerp(a', b', t), 2 t (1 - t)). Its inner rotations
// a' = a Exp((L v - d) / 2) and b' = b Exp((d - L w) / 2), with d = Log(a^-1 b), give the curve the
// velocities v and w at its ends, L steps apart.
bool fill_by_squad(Track& track, FrameSpan span, const JointContext& context) {
  const CurveSettings settings = context.curve();
  const EndState before = state_before(track, span, settings);
  const EndState behind = state_behind(track, span, settings);
  if (track.is_position || !before.known || !behind.known) {
    return fill_with_curve(track, span, Curve::hermite, settings);
  }
  const Quat a = track.rotation(span.first - 1);
  const Quat b = align_hemisphere(track.rotation(span.last + 1), a);
  const Vec3 d = log(conjugate(a) * b);
  const auto length = static_cast<double>(span.length() + 1);
  const Quat inner_a = a * exp(0.5 * (length * before.velocity - d));
  const Quat inner_b = b * exp(0.5 * (d - length * behind.velocity));
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = static_cast<double>(f - span.first + 1) / length;
    const Quat q = slerp(slerp(a, b, t), slerp(inner_a, inner_b, t), 2 * t * (1 - t));
    track.values[f] = track.chart.vector_of(f, q);
  }
  return true;
}

std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve) {
  Track track = track_around(samples, gap);
  if (std::find(track.observed.begin(), track.observed.end(), 1) == track.observed.end()) {
    return {};
  }
  const FrameSpan span = within(track, gap.span);
  fill_with_curve(track, span, curve, {.frame_rate_hz = samples.frame_rate_hz});
  return values_in(track, span);
}

Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const GapRequest& request,
                      Curve curve, std::string_view name) {
  const double length_s = static_cast<double>(gap.span.length()) / samples.frame_rate_hz;
  const double longest_s = request.longest_gap_s > 0 ? request.longest_gap_s : longest_curve_s;
  if (!request.fill_all) {
    if (gap.span.first == 0 || gap.span.last + 1 == samples.frames) {
      return Filling::refused(name, "the gap is at an end of the take");
    }
    if (length_s > longest_s) {
      return Filling::refused(
          name, fmt::format("the gap of {:.2f} s is longer than {:.2f} s", length_s, longest_s));
    }
  }
  Filling filling{curve_positions(samples, gap, curve), std::string(name)};
  filling.is_evidence = false;
  return filling.made() ? filling : Filling::refused(name, "the marker is never seen");
}

bool fill_joint_by_cycles(Track& track, FrameSpan span, const JointContext& context) {
  return fill_by_cycles(track, span, context.curve(), least_cycles_of_joints);
}

// The marker's track is expressed in the frame of reference of the rest of the body, so that a
// cycle may happen elsewhere and in another direction. The whole body is used: its shape is placed
// alike in every cycle, however the gap's marker moves.
Filling fill_marker_by_cycles(const Samples& samples, const MarkerGap& gap, const GapRequest&) {
  constexpr std::string_view name = "cyclic";
  std::vector<std::size_t> markers;
  for (const Companion& companion : companions_of(samples, gap, helpers_of(samples, gap))) {
    if (markers.size() < most_cycle_companions) markers.push_back(companion.marker);
  }
  MarkerGroup body(markers, std::vector<double>(markers.size(), 1.0));
  std::vector<std::size_t> whole;
  for (std::size_t f = 0; f < samples.frames; ++f) {
    if (samples.sees(f, markers)) whole.push_back(f);
  }
  if (!markers.empty() && !whole.empty())
    body.fit_shape(samples, evenly(whole, most_cycle_shape_frames));
  std::vector<Placement> placements(samples.frames);
  Track track{std::vector<Vec3>(samples.frames), std::vector<std::uint8_t>(samples.frames)};
  for (const std::size_t f : whole) {
    if (!markers.empty()) placements[f] = body.placement(samples, f);
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    track.observed[f] = 1;
    track.values[f] = placements[f].to_local(samples.at(f, gap.marker));
  }
  if (!fill_by_cycles(track, gap.span, {.frame_rate_hz = samples.frame_rate_hz},
                      least_cycles_of_markers)) {
    return Filling::refused(name, "no two other times of the take show the same movement");
  }
  Filling filling{values_in(track, gap.span), std::string(name)};
  for (std::size_t i = 0; i < filling.values.size(); ++i)
    filling.values[i] = placements[gap.span.first + i].to_world(filling.values[i]);
  return filling;
}

}  // namespace kinemend::fill
