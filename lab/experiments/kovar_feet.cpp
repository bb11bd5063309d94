// Footskate after Kovar, Schreiner & Gleicher 2002: how far feet slide before and after clean-up,
// in damaged and smoothed takes, in takes as recorded, and in pairs cleaned by others.
#include <algorithm>
#include <cmath>
#include <set>

#include "experiment.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/lab/corrupt.hpp"

namespace kinemend::papers {
namespace {

const std::vector<std::string>& walks() {
  static const std::vector<std::string> names{"02_01", "07_01", "07_03", "08_01",
                                              "16_15", "16_22", "35_01"};
  return names;
}
const std::vector<std::string>& runs() {
  static const std::vector<std::string> names{"09_01", "09_05", "16_35", "35_26"};
  return names;
}
const std::vector<std::string>& dances() {
  static const std::vector<std::string> names{"05_02", "49_01", "49_04"};
  return names;
}

// As `clean` finds contacts in takes without noise.
FeetSettings by_thresholds() {
  FeetSettings settings;
  settings.contact.finder = ContactFinder::thresholds;
  return settings;
}

std::size_t count_held(const FeetReport& report) {
  return static_cast<std::size_t>(std::count(report.held.begin(), report.held.end(), 1));
}

// How far knees pop before and after, by take: the largest rise above both the input and the
// recording, and the number of takes that rise above that by more than a tenth and half a degree.
struct Pops {
  std::string worst;
  std::size_t takes = 0, above = 0;
  double most_rise = -1, recorded = 0, before = 0, after = 0;

  void add(const std::string& take, double of_record, double was, double is) {
    const double allowed = std::max(of_record, was);
    ++takes;
    above += is > std::max(1.1 * allowed, allowed + 0.5) ? 1 : 0;
    if (is - allowed <= most_rise) return;
    most_rise = is - allowed;
    worst = take;
    recorded = of_record, before = was, after = is;
  }
  void print(const std::string& group, Table& table) const {
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", group, takes, above, worst,
               recorded, before, after);
    table.add({quoted(group), fmt::format("{}", takes), fmt::format("{}", above), worst,
               fmt::format("{:.5g}", recorded), fmt::format("{:.5g}", before),
               fmt::format("{:.5g}", after)});
  }
};

// The pops of a group of takes for one way of cleaning.
struct NamedPops {
  std::string group;
  Pops pops;
};

// RMS angle to the truth over hips, knees and ankles.
double legs_deg(const Take& truth, const Take& result) {
  const std::vector<double> joints = geodesic_rms_deg_per_joint(truth, result);
  double sum = 0, count = 0;
  for (const Leg& leg : find_legs(truth.skeleton)) {
    for (const std::int32_t joint : {leg.hip, leg.knee, leg.ankle}) {
      const double angle = joints[static_cast<std::size_t>(joint)];
      sum += angle * angle;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// Mean distance of knees, ankles and toes from the truth.
double legs_distance(const Take& truth, const Take& result) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    const Pose right = forward_kinematics(truth, f), pose = forward_kinematics(result, f);
    for (const Leg& leg : find_legs(truth.skeleton)) {
      for (const std::int32_t joint : {leg.knee, leg.ankle, leg.toe}) {
        if (joint < 0) continue;
        const auto j = static_cast<std::size_t>(joint);
        sum += norm(pose.positions[j] - right.positions[j]);
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : 0;
}

// Sums over takes.
struct FeetRow {
  double takes = 0, slide = 0, most_slide = 0, position = 0, knee_pop = 0, legs = 0, legs_cm = 0;

  void add(const Take& truth, const Take& result, const std::vector<FootContact>& contacts) {
    const double cm = 100 * guess_length_unit(truth.skeleton)->metres;
    const FeetFigures figures = feet_figures(result, contacts);
    ++takes;
    slide += cm * figures.slide;
    most_slide += cm * figures.most_slide;
    position += mpjpe(truth, result, 0, cm);
    knee_pop += figures.knee_pop_deg;
    legs += legs_deg(truth, result);
    legs_cm += cm * legs_distance(truth, result);
  }
  void print(const std::string& group, const std::string& method, const char* feet,
             Table& table) const {
    fmt::print("| {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", group,
               method, feet, slide / takes, most_slide / takes, legs / takes, legs_cm / takes,
               position / takes, knee_pop / takes);
    table.add({quoted(fmt::format("{} {} {}", group, method, feet)),
               fmt::format("{:.5g}", slide / takes), fmt::format("{:.5g}", most_slide / takes),
               fmt::format("{:.5g}", legs / takes), fmt::format("{:.5g}", legs_cm / takes),
               fmt::format("{:.5g}", position / takes), fmt::format("{:.5g}", knee_pop / takes)});
  }
};

void after_cleaning(const Arguments& arguments, const std::string& group,
                    const std::vector<std::string>& names, Table& table,
                    std::vector<NamedPops>& all_pops) {
  for (const char* method : {"gaussian", "auto"}) {
    FeetRow clean, plain, held;
    Pops pops;
    for (const std::string& name : names) {
      const Take truth = load_take(arguments, name + ".bvh", {}).clip;
      const std::vector<FootContact> contacts = true_contacts(truth);
      Take noisy = truth;
      Random random(2002);
      apply_damage(noisy, "gaussian", {{"std_deg", 1.0}}, random);
      const std::unique_ptr<Cleaner> cleaner = make_cleaner(method);
      CleanSettings settings;
      clean.add(truth, truth, contacts);
      const Take before = clean_take(noisy, *cleaner, settings).take;
      plain.add(truth, before, contacts);
      settings.feet.emplace();
      const Take after = clean_take(noisy, *cleaner, settings).take;
      held.add(truth, after, contacts);
      pops.add(name, feet_figures(truth, contacts).knee_pop_deg,
               feet_figures(before, contacts).knee_pop_deg,
               feet_figures(after, contacts).knee_pop_deg);
      if (arguments.quick) break;
    }
    if (std::string(method) == "gaussian") clean.print(group, "as recorded", "", table);
    plain.print(group, method, "off", table);
    held.print(group, method, "auto", table);
    all_pops.push_back({fmt::format("{}, noise, {}", group, method), pops});
  }
}

void as_recorded(const Arguments& arguments, std::vector<NamedPops>& all_pops) {
  fmt::print(
      "\n| takes as recorded | contacts | held by auto | frames changed | slide cm | after |\n"
      "|---|---|---|---|---|---|\n");
  Table table(arguments, "feet_recorded.csv",
              "takes,contacts,held,changed_percent,slide_cm,slide_held_cm");
  const auto row = [&](const std::string& group, const std::vector<std::string>& names) {
    double contacts = 0, held = 0, frames = 0, changed = 0, before = 0, after = 0;
    Pops pops, forced;
    for (const std::string& name : names) {
      Take clip = load_take(arguments, name + ".bvh", {}).clip;
      FeetSettings force = by_thresholds();
      force.mode = FeetMode::force;
      Take copy = clip;
      const FeetFigures by_force = clean_feet(copy, force).after;
      const FeetReport report = clean_feet(clip, by_thresholds());
      pops.add(name, report.before.knee_pop_deg, report.before.knee_pop_deg,
               report.after.knee_pop_deg);
      forced.add(name, report.before.knee_pop_deg, report.before.knee_pop_deg,
                 by_force.knee_pop_deg);
      const std::size_t joints = clip.joint_count();
      contacts += static_cast<double>(report.contacts.size());
      held += static_cast<double>(count_held(report));
      frames += static_cast<double>(clip.frame_count());
      for (std::size_t f = 0; f < clip.frame_count(); ++f) {
        const auto first = report.changed.begin() + static_cast<std::ptrdiff_t>(f * joints);
        changed += std::count(first, first + static_cast<std::ptrdiff_t>(joints), 1) > 0 ? 1 : 0;
      }
      before += 100 * report.metres_per_unit * report.before.slide;
      after += 100 * report.metres_per_unit * report.after.slide;
    }
    const auto takes = static_cast<double>(names.size());
    fmt::print("| {} | {} | {} | {:.0f} % | {:.3f} | {:.3f} |\n", group, contacts, held,
               100 * changed / frames, before / takes, after / takes);
    table.add({group, fmt::format("{}", contacts), fmt::format("{}", held),
               fmt::format("{:.4g}", 100 * changed / frames), fmt::format("{:.5g}", before / takes),
               fmt::format("{:.5g}", after / takes)});
    all_pops.push_back({group + " as recorded, auto", pops});
    all_pops.push_back({group + " as recorded, force", forced});
  };
  row("walks", walks());
  row("runs", runs());
  row("dances", dances());
  row("bones of another subject", {"38_03", "46_01", "105_39", "105_40"});
  table.close();
}

// Cleans every take of the folder cmu/bvh with `auto` and with `force`.
void survey(const Arguments& arguments, std::vector<NamedPops>& all_pops) {
  const std::filesystem::path folder = arguments.data / "cmu" / "bvh";
  if (arguments.quick || !std::filesystem::is_directory(folder)) return;
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().stem().string());
  Pops pops, forced;
  for (const std::string& name : names) {
    const Take clip = load_take(arguments, name + ".bvh", {}).clip;
    for (const FeetMode mode : {FeetMode::automatic, FeetMode::force}) {
      Take copy = clip;
      FeetSettings settings = by_thresholds();
      settings.mode = mode;
      const FeetReport report = clean_feet(copy, settings);
      (mode == FeetMode::force ? forced : pops)
          .add(name, report.before.knee_pop_deg, report.before.knee_pop_deg,
               report.after.knee_pop_deg);
    }
  }
  all_pops.push_back({"all takes, auto", pops});
  all_pops.push_back({"all takes, force", forced});
}

struct FeetPair {
  std::string name;
  Take raw, fixed;
};

// Real pairs, or without data walks whose feet slide after smoothing of noise, paired with the
// clean walks.
std::vector<FeetPair> pairs_of(const Arguments& arguments) {
  std::vector<FeetPair> pairs;
  const std::string stem = "style_transfer_demo_results_";
  if (!find_take(arguments.data, stem + "comp_3d_1_raw.bvh")) {
    for (const std::uint64_t seed : {1, 2}) {
      const Take walk = synthesize({.motion = "walk", .duration_s = 4, .seed = seed});
      Take raw = walk;
      Random random(seed);
      apply_damage(raw, "gaussian", {{"std_deg", 1.0}}, random);
      clean_in_place(*make_gaussian(), raw);
      pairs.push_back({fmt::format("walk {}", seed), std::move(raw), walk});
    }
    return pairs;
  }
  for (const char* name : {"comp_3d_1", "comp_3d_2", "comp_video_1", "comp_video_2", "demo_3d_1",
                           "demo_3d_2", "demo_video_1", "demo_video_2"})
    pairs.push_back({name, load_take(arguments, stem + name + "_raw.bvh", {}).clip,
                     load_take(arguments, stem + name + "_fixed.bvh", {}).clip});
  return pairs;
}

void pairs(const Arguments& arguments, std::vector<NamedPops>& all_pops) {
  fmt::print(
      "\n| pair | contacts | slide cm, raw | their fix | held here | knee pop deg | their fix "
      "| held here |\n|---|---|---|---|---|---|---|---|\n");
  Table table(arguments, "feet_pairs.csv", "pair,raw_cm,fix_cm,held_cm,raw_pop,fix_pop,held_pop");
  std::vector<double> sums(6, 0.0);
  Pops pops;
  std::vector<FeetPair> all = pairs_of(arguments);
  for (auto& [name, raw, fixed] : all) {
    FeetSettings settings;
    settings.contacts = true_contacts(fixed);
    const FeetFigures theirs = feet_figures(fixed, *settings.contacts);
    const FeetReport report = clean_feet(raw, settings);
    const double cm = 100 * report.metres_per_unit;
    fmt::print("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.1f} | {:.1f} | {:.1f} |\n", name,
               settings.contacts->size(), cm * report.before.slide, cm * theirs.slide,
               cm * report.after.slide, report.before.knee_pop_deg, theirs.knee_pop_deg,
               report.after.knee_pop_deg);
    const double figures[] = {cm * report.before.slide, cm * theirs.slide,
                              cm * report.after.slide,  report.before.knee_pop_deg,
                              theirs.knee_pop_deg,      report.after.knee_pop_deg};
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += figures[i] / static_cast<double>(all.size());
    pops.add(name, report.before.knee_pop_deg, report.before.knee_pop_deg,
             report.after.knee_pop_deg);
  }
  all_pops.push_back({"pairs", pops});
  std::vector<std::string> cells{fmt::format("mean of {}", all.size())};
  for (const double sum : sums) cells.push_back(fmt::format("{:.5g}", sum));
  table.add(cells);
  table.close();
}

void kovar_feet(const Arguments& arguments) {
  fmt::print(
      "Feet, noise of 1 degree on all axes. Slide: mean travel a frame at the contacts of the\n"
      "take as recorded; most: farthest within one; legs: RMS angle to the truth of hips, knees\n"
      "and ankles, and mean error of the positions of knees, ankles and toes; position: that of\n"
      "all joints; knee pop: largest second difference of a knee's angle.\n\n"
      "| takes | method | feet | slide cm | most cm | legs deg | legs cm | position cm "
      "| knee pop deg |\n|---|---|---|---|---|---|---|---|---|\n");
  std::vector<NamedPops> pops;
  Table table(arguments, "feet_noise.csv",
              "takes,slide_cm,most_cm,legs_deg,legs_cm,position_cm,knee_pop_deg");
  after_cleaning(arguments, "walks", walks(), table, pops);
  after_cleaning(arguments, "runs", runs(), table, pops);
  after_cleaning(arguments, "dances", dances(), table, pops);
  table.close();
  as_recorded(arguments, pops);
  survey(arguments, pops);
  pairs(arguments, pops);
  fmt::print(
      "\nKnee pop, degrees: takes that rise by more than a tenth and half a degree above what was\n"
      "recorded and what they had before their feet were held; and the take that rises most.\n\n"
      "| takes | number | above | most | recorded | before | after "
      "|\n|---|---|---|---|---|---|---|\n");
  Table pop_table(arguments, "feet_pops.csv", "takes,number,above,take,recorded,before,after");
  for (const NamedPops& own : pops) own.pops.print(own.group, pop_table);
  pop_table.close();
}

const Registration kovar_feet_entry("kovar_feet", kovar_feet);

}  // namespace
}  // namespace kinemend::papers
