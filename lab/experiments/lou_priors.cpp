// Section 4.3 of Lou & Chai 2010, Example-based Human Motion Denoising: the same method with bases
// of other motions.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>
#include <set>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

struct Prior {
  std::string name;
  std::vector<Take> training;
};

// The available takes of the library described as this motion, except the tested ones, at 30 Hz:
// this needs a quarter of the memory and gives as many frames as the paper states.
struct Library {
  std::vector<Take> clips;
  std::size_t subjects = 0;
};

Library takes_described(const Arguments& arguments, const std::vector<std::string>& words,
                        const std::set<std::string>& tried) {
  Library library;
  std::set<int> subjects;
  std::ifstream index(arguments.data / "cmu" / "index.csv");
  for (std::string line; std::getline(index, line);) {
    int subject = 0, trial = 0;
    if (std::sscanf(line.c_str(), "%d,%d,", &subject, &trial) != 2) continue;
    std::transform(line.begin(), line.end(), line.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool is_meant = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return line.find(word) != std::string::npos;
    });
    const std::string name = fmt::format("{:02}_{:02}", subject, trial);
    if (!is_meant || tried.contains(name)) continue;
    for (const char* folder : {"bvh", "bvh-rotations"}) {
      const auto path = arguments.data / "cmu" / folder / (name + ".bvh");
      if (!std::filesystem::exists(path)) continue;
      const Take clip = read_joints(path).take;
      library.clips.push_back(
          at_lou_rate(slice(clip, leading_calibration_frames(clip), clip.frame_count())));
      subjects.insert(subject);
      break;
    }
  }
  library.subjects = subjects.size();
  return library;
}

std::vector<Take> joined(std::vector<Take> a, const std::vector<Take>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void priors(const Arguments& arguments) {
  const LouGroup walks = walking_groups(arguments)[0];
  std::vector<std::string> others = {"02_01", "05_01", "06_01", "07_01", "07_03", "07_04",
                                     "07_08", "16_15", "16_21", "16_31", "16_47", "35_01",
                                     "35_03", "35_05", "35_12", "35_15", "35_28", "49_01"};
  std::vector<std::string> runs = {"02_03", "09_01", "09_02", "09_04", "09_06", "09_08", "16_35",
                                   "16_45", "16_55", "35_17", "35_19", "35_21", "35_24"};
  if (arguments.quick) others.resize(3), runs.resize(3);
  const std::vector<Take> of_others = lou_takes(arguments, others, "walk", 201);
  const std::vector<Take> running = lou_takes(arguments, runs, "run", 301);
  const LouGroup run_tests = lou_group(arguments, "runs", {}, {"09_07", "16_56", "35_23"}, "run");
  std::vector<Prior> list = {{"small: walks of the subject", walks.training},
                             {"large: walks of 8 subjects", joined(walks.training, of_others)},
                             {"large, subject left out", of_others},
                             {"mixed: walks and runs", joined(of_others, running)},
                             {"running only", running}};
  if (!arguments.quick && !arguments.data.empty()) {
    const std::set<std::string> tried{"08_03", "08_09", "09_07", "16_56", "35_23"};
    const Library all_walks = takes_described(arguments, {"walk"}, tried),
                  all_runs = takes_described(arguments, {"run", "jog"}, tried);
    fmt::print("The whole library: {} walks of {} subjects, {} runs of {} subjects.\n\n",
               all_walks.clips.size(), all_walks.subjects, all_runs.clips.size(),
               all_runs.subjects);
    list.push_back({"the paper's size: all walks", all_walks.clips});
    list.push_back(
        {"the paper's size: all walks and runs", joined(all_walks.clips, all_runs.clips)});
  }
  Table table(arguments, "lou_priors.csv",
              "prior,frames,bases,test,rms_deg,papers_rms_deg,filling_rms_deg");
  fmt::print("Section 4.3: sigma = 3 degrees, bases of different motions. Degrees.\n\n");
  const TextTable text({"frames", "bases", "walk", "run", "paper", "run", "fill", "run"});
  const auto tried_with = [&](const Cleaner& cleaner, const std::vector<Take>& tests) {
    return denoising_error(cleaner, tests, arguments.quick ? 1 : 3);
  };
  struct Cells {
    std::string frames, bases;
  };
  const auto add = [&](const std::string& name, const Cells& cells, const std::string& test,
                       const std::vector<std::optional<double>>& values) {
    std::vector<std::string> line{quoted(name), cells.frames, cells.bases, test};
    for (const auto& value : values) line.push_back(value ? fmt::format("{:.5g}", *value) : "");
    table.add(line);
  };
  for (const Prior& prior : list) {
    const auto model = learned("example", prior.training);
    const auto cleaner = make_example({}, model), papers = papers_example(model);
    const auto bases = model->tensor("bases", 3).shape[2];
    const double frames = model->seconds * lou_rate_hz;
    std::vector<double> shown{frames, static_cast<double>(bases)};
    std::vector<std::vector<std::optional<double>>> of_tests;
    for (const auto* tests : {&walks.tests, &run_tests.tests})
      of_tests.push_back({tried_with(*cleaner, *tests), tried_with(*papers, *tests),
                          mean_filling_error(*cleaner, *tests)});
    for (std::size_t column = 0; column < 3; ++column)
      shown.insert(shown.end(), {*of_tests[0][column], *of_tests[1][column]});
    text.add(prior.name, shown);
    const Cells cells{fmt::format("{:.0f}", frames), fmt::format("{}", bases)};
    add(prior.name, cells, "walk", of_tests[0]);
    add(prior.name, cells, "run", of_tests[1]);
  }
  const auto automatic = make_auto();
  for (const auto& [test, tests] :
       {std::pair{"walk", &walks.tests}, std::pair{"run", &run_tests.tests}}) {
    const double denoised = tried_with(*automatic, *tests),
                 filled = mean_filling_error(*automatic, *tests);
    fmt::print("(auto, no prior) {} {:.2f}, filled {:.2f}\n", test, denoised, filled);
    add("(auto, no prior)", {}, test, {denoised, std::nullopt, filled});
  }
  table.close();
}

const Registration lou_priors_entry("lou_priors", priors);

}  // namespace
}  // namespace kinemend::papers
