// Mall et al. 2017, figures 9 and 10: takes with noise and gaps, and takes with long gaps, on the
// takes of a hold-out. The network that fills, EBD, is made by tools/train_paper; without it there
// is nothing to measure.
#include <cmath>
#include <map>

#include "kinemend/fill.hpp"
#include "mall_networks.hpp"
#include "page.hpp"
#include "priors/gap_network.hpp"

namespace kinemend::papers {
namespace {

// By the EBD; the root and what it does not know stay as they are.
Clip filled_by_ebd(const PaperNetwork& ebd, const Clip& clip) {
  const BodyMatch match = match_body(ebd.layout, clip);
  BodyChannels channels = encode_body(clip, ebd.layout, match);
  channels.poses = filled_by_network(ebd.network, ebd.layout, channels);
  Clip whole = clip;
  decode_body(channels, ebd.layout, match, whole);
  Clip result = clip;
  for (const std::int32_t joint : match.tracks) {
    if (joint <= 0) continue;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const std::size_t at = f * clip.joint_count() + static_cast<std::size_t>(joint);
      if (clip.observed.empty() || clip.observed[at] != 0) continue;
      result.local_rotations[at] = whole.local_rotations[at];
      result.observed[at] = 1;
    }
  }
  return result;
}

Clip filled_by(const Clip& clip, const std::string& method) {
  Clip result = clip;
  FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  fill_gaps(result, settings);
  return result;
}

// Root mean square angle over the samples that are missing in `damaged`, degrees.
double gap_error(const Clip& truth, const Clip& damaged, const Clip& result) {
  double square = 0, count = 0;
  for (std::size_t i = 0; i < damaged.observed.size(); ++i) {
    if (damaged.observed[i] != 0) continue;
    const double angle =
        degrees_per_radian * angle_between(truth.local_rotations[i], result.local_rotations[i]);
    square += angle * angle;
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : 0;
}

struct Sums {
  double error = 0;
  std::size_t count = 0;
};

void write(Table& table, const std::string& words, const std::map<std::string, Sums>& errors) {
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
  std::map<std::string, Sums> errors;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Clip truth = load_take(arguments, takes[i].name + ".bvh", {}).clip;
    const Clip noise = damaged(truth, "gaussian-channels", {{"k", 0.5}}, i);
    const Clip clip = damaged(noise, "gaps", {}, 1000 + i);
    const auto add = [&](const std::string& method, const Clip& result) {
      errors[method].error += rms_deg(truth, result);
      ++errors[method].count;
    };
    const Clip lines = filled_by(clip, "slerp"), network = filled_by_ebd(ebd, clip);
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

void long_gaps(const Arguments& arguments, const std::vector<HeldOut>& takes,
               const PaperNetwork& ebd) {
  Table table(arguments, "mall_gaps_long.csv", "damage,method,clips,rms_deg,of_straight_lines");
  struct Case {
    std::string words, scope;
    double length_s;
  };
  for (const Case& c : std::vector<Case>{{"a joint, 0.5 s", "joint", 0.5},
                                         {"a joint, 2 s", "joint", 2},
                                         {"a joint, 5 s", "joint", 5},
                                         {"a limb, 0.5 s", "limb", 0.5},
                                         {"a limb, 2 s", "limb", 2}}) {
    std::map<std::string, Sums> errors;
    for (std::size_t i = 0; i < takes.size(); ++i) {
      const Clip truth = load_take(arguments, takes[i].name + ".bvh", {}).clip;
      if (static_cast<double>(truth.frame_count()) < 1.2 * c.length_s * truth.frame_rate_hz)
        continue;
      for (std::uint64_t draw = 0; draw < 5; ++draw) {
        const Clip clip = damaged(
            truth, "long-gap",
            {{"length_s", c.length_s},
             {"scope", c.scope},
             {"joints", std::string("*Leg,*Foot,*Arm,*ForeArm,Spine*,LowerBack,Neck1,Head")}},
            100 * draw + i);
        const auto add = [&](const std::string& method, const Clip& result) {
          errors[method].error += gap_error(truth, clip, result);
          ++errors[method].count;
        };
        for (const char* method : {"slerp", "spline", "cyclic", "pca", "auto"})
          add(method, filled_by(clip, method));
        add("example", cleaned(clip, "example"));
        add("ebd", filled_by_ebd(ebd, clip));
      }
    }
    if (!errors.empty()) write(table, c.words, errors);
  }
  table.close();
}

void experiment(const Arguments& arguments) {
  std::vector<HeldOut> takes;
  for (const HeldOut& take : hold_outs_of(arguments)) {
    if (take.holdout == 1) takes.push_back(take);
  }
  const auto ebd = paper_network(arguments, "ebd");
  if (arguments.quick || takes.empty() || !ebd) {
    fmt::print("skipped: networks in {} are wanted (tools/train_paper DATA), and real takes\n",
               arguments.models.string());
    return;
  }
  noise_and_gaps(arguments, takes, *ebd);
  long_gaps(arguments, takes, *ebd);
}

const Registration registration("mall_gaps", experiment);

}  // namespace
}  // namespace kinemend::papers
