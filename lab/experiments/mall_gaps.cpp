// Mall et al. 2017, figures 9 and 10: takes with noise and gaps, and takes with long gaps.
// tools/train_paper makes EBD, the network that fills; without it, this program measures nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/fill.hpp"
#include "mall_networks.hpp"
#include "page.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend::papers {
namespace {

// Fills with EBD; the root and joints unknown to EBD are unchanged.
Take filled_by_ebd(const PaperNetwork& ebd, const Take& clip) {
  const BodyMatch match = match_body(ebd.layout, clip);
  BodyChannels channels = encode_body(clip, ebd.layout, match);
  channels.poses = filled_by_network(ebd.network, ebd.layout, channels);
  Take whole = clip;
  decode_body(channels, ebd.layout, match, whole);
  Take result = clip;
  for (const std::int32_t joint : match.tracks) {
    if (joint <= 0) continue;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const std::size_t at = f * clip.joint_count() + static_cast<std::size_t>(joint);
      if (clip.observed.empty() || clip.observed[at] != 0) continue;
      result.rotations[at] = whole.rotations[at];
      result.observed[at] = 1;
    }
  }
  return result;
}

Take filled_by(const Take& clip, const std::string& method) {
  Take result = clip;
  FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  fill_gaps(result, settings);
  return result;
}

// Root mean square angle over the samples missing in `damaged`, degrees.
double gap_error(const Take& truth, const Take& damaged, const Take& result) {
  double square = 0, count = 0;
  for (std::size_t i = 0; i < damaged.observed.size(); ++i) {
    if (damaged.observed[i] != 0) continue;
    const double angle =
        degrees_per_radian * angle_between(truth.rotations[i], result.rotations[i]);
    square += angle * angle;
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : 0;
}

struct GapSums {
  double error = 0;
  std::size_t count = 0;
};

void write(Table& table, const std::string& words, const std::map<std::string, GapSums>& errors) {
  const double linear = errors.begin()->second.count > 0 && errors.count("slerp") > 0
                            ? errors.at("slerp").error
                            : errors.at("lerp and gaussian 58 ms").error;
  for (const auto& [method, sums] : errors) {
    const double mean = sums.error / static_cast<double>(sums.count);
    table.add({quoted(words), method, fmt::format("{}", sums.count), figure(mean),
               figure(sums.error / linear)});
    fmt::print("{:26} {:26} {:.3f} deg, {:.3f} of straight lines\n", words, method, mean,
               sums.error / linear);
  }
}

void noise_and_gaps(const Arguments& arguments, const std::vector<HeldOut>& takes,
                    const PaperNetwork& ebd) {
  Table table(arguments, "mall_gaps_noise.csv", "damage,method,clips,rms_deg,of_straight_lines");
  const auto ebf = paper_network(arguments, "ebf");
  std::map<std::string, GapSums> errors;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Take truth = take_of(arguments, takes[i]);
    const Take noise = damaged(truth, "gaussian-channels", {{"k", 0.5}}, i);
    const Take clip = damaged(noise, "gaps", {}, 1000 + i);
    const auto add = [&](const std::string& method, const Take& result) {
      errors[method].error += rms_deg(truth, result);
      ++errors[method].count;
    };
    const Take lines = filled_by(clip, "slerp"), network = filled_by_ebd(ebd, clip);
    add("lerp and gaussian 58 ms", cleaned(lines, "gaussian", {{"width_s", 0.058}}));
    add("ebd and gaussian 58 ms", cleaned(network, "gaussian", {{"width_s", 0.058}}));
    if (ebf) {
      add("lerp and ebf", by_network(*ebf, lines));
      add("ebd and ebf", by_network(*ebf, network));
    }
    add("auto and fill", cleaned(filled_by(clip, "auto"), "auto"));
    add("ebd and auto", cleaned(network, "auto"));
  }
  write(table, "0.5 angular, gaps", errors);
  table.close();
}

struct LongGap {
  std::string words, scope;
  double length_s;
};

// Joints of CMU skeletons; other skeletons have no lower back.
std::string joints_with_gaps(const Take& clip) {
  const std::string all = "*Leg,*Foot,*Arm,*ForeArm,Spine*,Neck1,Head";
  const auto& names = clip.skeleton.names;
  return std::count(names.begin(), names.end(), "LowerBack") > 0 ? all + ",LowerBack" : all;
}

// Adds the methods' errors over `draws` gaps of one take.
void fill_long_gaps(const Take& truth, const LongGap& gap, const PaperNetwork& ebd,
                    const std::vector<std::string>& methods, std::uint64_t first_seed,
                    std::uint64_t draws, std::map<std::string, GapSums>& errors) {
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    const Take clip = damaged(
        truth, "long-gap",
        {{"length_s", gap.length_s}, {"scope", gap.scope}, {"joints", joints_with_gaps(truth)}},
        100 * draw + first_seed);
    const auto add = [&](const std::string& method, const Take& result) {
      errors[method].error += gap_error(truth, clip, result);
      ++errors[method].count;
    };
    for (const std::string& method : methods)
      add(method, method == "example" ? cleaned(clip, method) : filled_by(clip, method));
    add("ebd", filled_by_ebd(ebd, clip));
  }
}

void long_gaps(const Arguments& arguments, const std::vector<HeldOut>& takes,
               const PaperNetwork& ebd) {
  Table table(arguments, "mall_gaps_long.csv", "damage,method,clips,rms_deg,of_straight_lines");
  for (const LongGap& gap : std::vector<LongGap>{{"a joint, 0.5 s", "joint", 0.5},
                                                 {"a joint, 2 s", "joint", 2},
                                                 {"a joint, 5 s", "joint", 5},
                                                 {"a limb, 0.5 s", "limb", 0.5},
                                                 {"a limb, 2 s", "limb", 2}}) {
    if (arguments.quick && gap.length_s != 0.5) continue;
    std::map<std::string, GapSums> errors;
    for (std::size_t i = 0; i < takes.size(); ++i) {
      const Take truth = take_of(arguments, takes[i]);
      if (static_cast<double>(truth.frame_count()) >= 1.2 * gap.length_s * truth.frame_rate_hz)
        fill_long_gaps(truth, gap, ebd, {"slerp", "spline", "cyclic", "pca", "auto", "example"}, i,
                       arguments.quick ? 1 : 5, errors);
    }
    if (!errors.empty()) write(table, gap.words, errors);
  }
  table.close();
}

// Takes outside EBD's training and longer than its training takes, together with the longest take
// of the hold-out: 20 s of each, and parts hardly longer than the gap. Only methods of `fill` are
// tried.
void gaps_of_other_takes(const Arguments& arguments, const PaperNetwork& ebd) {
  struct Case {
    std::string words;
    LongGap gap;
    double take_s;
    std::size_t parts;
  };
  Table table(arguments, "mall_gaps_takes.csv", "damage,method,clips,rms_deg,of_straight_lines");
  for (const Case& c : std::vector<Case>{{"a joint, 2 s of 3.5 s", {"", "joint", 2}, 3.5, 4},
                                         {"a limb, 2 s of 3.5 s", {"", "limb", 2}, 3.5, 4},
                                         {"a joint, 2 s of 20 s", {"", "joint", 2}, 20, 1},
                                         {"a limb, 2 s of 20 s", {"", "limb", 2}, 20, 1},
                                         {"a joint, 5 s of 20 s", {"", "joint", 5}, 20, 1},
                                         {"a limb, 5 s of 20 s", {"", "limb", 5}, 20, 1}}) {
    std::map<std::string, GapSums> all;
    std::uint64_t seed = 0;
    for (const char* name :
         {"10_01", "02_06", "06_13", "13_30", "14_20", "36_05", "49_21", "131_09", "135_09"}) {
      const Take whole = take_of(arguments, {name, "", 1});
      const std::size_t length =
          std::min(static_cast<std::size_t>(c.take_s * whole.frame_rate_hz), whole.frame_count());
      for (std::size_t part = 0; part < c.parts; ++part) {
        const std::size_t first = (whole.frame_count() - length) * part / c.parts;
        fill_long_gaps(slice(whole, first, first + length), c.gap, ebd, {"slerp", "pca", "auto"},
                       seed++, 4 / c.parts, all);
      }
    }
    write(table, c.words, all);
  }
  table.close();
}

// One channel through a long gap of a noisy take, as in figure 10.
void gap_curves(const Arguments& arguments, const PaperNetwork& ebd) {
  struct Drawn {
    const char *take, *joint;
    double first_s, length_s;
  };
  Table table(arguments, "mall_gap_curves.csv", "take,joint,version,time_s,angle_deg,is_missing");
  const auto ebf = paper_network(arguments, "ebf");
  for (const Drawn& drawn : {Drawn{"35_03", "LeftLeg", 0.6, 2}, Drawn{"07_02", "RightLeg", 0.3, 2},
                             Drawn{"10_01", "LeftLeg", 1.5, 4}}) {
    const Take truth = take_of(arguments, {drawn.take, "", 1});
    const auto joint = static_cast<std::size_t>(
        std::find(truth.skeleton.names.begin(), truth.skeleton.names.end(), drawn.joint) -
        truth.skeleton.names.begin());
    Take clip = damaged(truth, "gaussian-channels", {{"k", 0.5}}, 1);
    clip.observed.assign(clip.rotations.size(), 1);
    const auto frame = [&](double time_s) {
      return std::min(clip.frame_count() - 2,
                      static_cast<std::size_t>(time_s * clip.frame_rate_hz));
    };
    const std::size_t first = frame(drawn.first_s), last = frame(drawn.first_s + drawn.length_s);
    for (std::size_t f = first; f < last; ++f) clip.observed[f * clip.joint_count() + joint] = 0;
    const Take lines = filled_by(clip, "slerp");
    std::map<std::string, Take> versions{
        {"truth", truth},
        {"lerp and gaussian 58 ms", cleaned(lines, "gaussian", {{"width_s", 0.058}})},
        {"auto", cleaned(filled_by(clip, "auto"), "auto")}};
    if (ebf) {
      versions["lerp and ebf"] = by_network(*ebf, lines);
      versions["ebd and ebf"] = by_network(*ebf, filled_by_ebd(ebd, clip));
    }
    // The angle is that about the knee's axis.
    const RotationOrder order = truth.skeleton.rotation_order(joint);
    const auto axis = static_cast<std::size_t>(
        std::find(order.axes.begin(), order.axes.end(), Axis::x) - order.axes.begin());
    for (const auto& [version, result] : versions) {
      std::array<double, 3> angles{};
      for (std::size_t f = 0; f < result.frame_count(); ++f) {
        angles = to_euler_near(result.rotation(f, joint), order, angles);
        if (f % 4 != 0) continue;
        table.add({drawn.take, drawn.joint, version,
                   figure(static_cast<double>(f) / clip.frame_rate_hz),
                   figure(degrees_per_radian * angles[axis]), f >= first && f < last ? "1" : "0"});
      }
    }
  }
  table.close();
}

void mall_gaps(const Arguments& arguments) {
  const auto ebd = paper_network(arguments, "ebd");
  if (!ebd) {
    fmt::print("skipped: networks in {} are wanted (tools/train_paper DATA)\n",
               arguments.models.string());
    return;
  }
  const std::vector<HeldOut> takes = takes_of_hold_outs(arguments, "1");
  noise_and_gaps(arguments, takes, *ebd);
  long_gaps(arguments, takes, *ebd);
  if (arguments.quick || arguments.data.empty()) return;
  gaps_of_other_takes(arguments, *ebd);
  gap_curves(arguments, *ebd);
}

const Registration mall_gaps_entry("mall_gaps", mall_gaps);

}  // namespace
}  // namespace kinemend::papers
