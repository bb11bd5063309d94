// Variants of `sparse` and of Algorithm 1 as in Xiao et al. 2015: table 2 (poselets against whole
// poses, error and time), figure 9 (training on one action or on all) and figure 10 (M, K and
// lambda).
#include <ctime>

#include "kinemend/extend/method_options.hpp"
#include "xiao_methods.hpp"

namespace kinemend::papers {
namespace {

SparseOptions plain_options(double lambda = 0.1) {
  SparseOptions options;
  options.loss = "l2";
  options.lambda = lambda;
  return options;
}

// Processor time of all threads so far.
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Writes lines of the table: the mean error over the tests of an action. Seconds are printed but
// not stored, because machines differ.
class Lines {
 public:
  Lines(const Arguments& arguments, const std::string& file)
      : table_(arguments, file, "motion,what,value,mean_cm") {}

  // Measures a filter of noisy takes, which is given the truth too, and returns its processor time.
  double add(const XiaoGroup& group, const std::string& what, const std::string& value,
             const std::function<Take(Take, const Take&)>& filter, const XiaoNoise& noise) {
    double error = 0, time_s = 0;
    for (std::size_t t = 0; t < group.tests.size(); ++t) {
      const Take& truth = group.tests[t];
      const XiaoDamaged damaged = xiao_noise(truth, noise, t + 1);
      const double start_s = processor_s();
      const Take filtered = filter(damaged.clip, truth);
      time_s += processor_s() - start_s;
      error += xiao_error(truth, damaged, filtered).mean / static_cast<double>(group.tests.size());
    }
    table_.add({group.name, what, value, fmt::format("{:.3f}", 100 * error)});
    fmt::print("{:<11}{:<16}{:<12}{:9.5f} m {:7.2f} s\n", group.name, what, value, error, time_s);
    std::fflush(stdout);
    return time_s;
  }
  double add(const XiaoGroup& group, const std::string& what, const std::string& value,
             const Cleaner& cleaner, const XiaoNoise& noise) {
    const auto filter = [&](Take noisy, const Take&) {
      clean_in_place(cleaner, noisy);
      return noisy;
    };
    return add(group, what, value, filter, noise);
  }
  void close() { table_.close(); }

 private:
  Table table_;
};

const XiaoNoise noise_20_db{"20 dB", 20, 0}, noise_30_db{"30 dB", 30, 0};

std::shared_ptr<const Model> learned(const Arguments& arguments, const std::vector<Take>& clips,
                                     const OptionValues& extra = {}) {
  OptionValues options = xiao_training(arguments);
  for (const auto& [name, setting] : extra) options[name] = setting;
  return xiao_model("sparse", clips, options);
}

// Table 2. Times of whole poses are multiples of those of poselets.
void representations(const Arguments& arguments, const XiaoGroup& group, Lines& lines,
                     Table& times) {
  struct Seconds {
    double learning, cleaning;
  };
  const auto add = [&](const std::string& what, const std::string& value,
                       const OptionValues& extra) {
    const double start_s = processor_s();
    const auto model = learned(arguments, group.training, extra);
    const double learning_s = processor_s() - start_s;
    const auto cleaner = make_sparse(plain_options(), model);
    return Seconds{learning_s, lines.add(group, what, value, *cleaner, noise_20_db)};
  };
  const Seconds poselets = add("representation", "poselets", {});
  const Seconds whole = add("representation", "whole", {{"whole", true}});
  add("coordinates", "local", {{"local", true}});
  times.add({group.name, fmt::format("{:.2f}", whole.learning / poselets.learning),
             fmt::format("{:.2f}", whole.cleaning / poselets.cleaning)});
}

std::vector<Take> training_of_all(const std::vector<XiaoGroup>& groups) {
  std::vector<Take> all;
  for (const XiaoGroup& group : groups)
    all.insert(all.end(), group.training.begin(), group.training.end());
  return all;
}

// Figure 9, at its 30 dB. `all` has as many windows and atoms as one action; `all grown` has as
// many for each action.
void actions(const Arguments& arguments, const std::vector<XiaoGroup>& groups, Lines& lines) {
  const std::vector<Take> all = training_of_all(groups);
  const auto count = static_cast<std::int64_t>(groups.size());
  const auto same = learned(arguments, all);
  const auto grown = learned(arguments, all, {{"windows", 10'000 * count}, {"atoms", 500 * count}});
  const auto example = xiao_model("example", all);
  for (const XiaoGroup& group : groups) {
    lines.add(group, "sparse from", "one",
              *make_sparse(plain_options(), learned(arguments, group.training)), noise_30_db);
    lines.add(group, "sparse from", "all", *make_sparse(plain_options(), same), noise_30_db);
    lines.add(group, "sparse from", "all grown", *make_sparse(plain_options(), grown), noise_30_db);
    lines.add(group, "example from", "one",
              *make_example({}, xiao_model("example", group.training)), noise_30_db);
    lines.add(group, "example from", "all", *make_example({}, example), noise_30_db);
  }
}

// Figure 10.
void sizes(const Arguments& arguments, const XiaoGroup& group, Lines& lines) {
  const auto add = [&](const std::string& what, std::int64_t value, const OptionValues& extra) {
    lines.add(group, what, std::to_string(value),
              *make_sparse(plain_options(), learned(arguments, group.training, extra)),
              noise_20_db);
  };
  for (const std::int64_t frames :
       arguments.quick ? std::vector<std::int64_t>{9, 21} : std::vector<std::int64_t>{5, 9, 15, 21})
    add("M", frames, {{"window_frames", frames}});
  for (const std::int64_t atoms : arguments.quick ? std::vector<std::int64_t>{30}
                                                  : std::vector<std::int64_t>{125, 250, 500, 1000})
    add("K", atoms, {{"atoms", atoms}});
  const auto model = learned(arguments, group.training);
  for (const double lambda : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0})
    lines.add(group, "lambda", fmt::format("{}", lambda),
              *make_sparse(plain_options(lambda), model), noise_20_db);
}

void xiao_variants(const Arguments& arguments) {
  const std::vector<XiaoGroup> groups = xiao_groups(arguments);
  Lines represented(arguments, "xiao_representation.csv");
  Table times(arguments, "xiao_time.csv", "motion,learning,cleaning");
  for (const XiaoGroup& group : groups) representations(arguments, group, represented, times);
  represented.close();
  times.close();
  Lines sized(arguments, "xiao_sizes.csv");
  for (const XiaoGroup& group : groups) sizes(arguments, group, sized);
  sized.close();
  if (groups.size() == 1) return;
  Lines learned_from(arguments, "xiao_actions.csv");
  actions(arguments, groups, learned_from);
  learned_from.close();
}

// Algorithm 1 with the coordinates of the true poses.
double add_algorithm(Lines& lines, const XiaoGroup& group, const std::string& what,
                     const std::string& value, const XiaoPaper& paper, double lambda,
                     const XiaoNoise& noise) {
  const XiaoPaperSettings settings{.lambda_squares = lambda};
  const auto filter = [&](const Take& noisy, const Take& truth) {
    return paper.filtered(noisy, truth, settings);
  };
  return lines.add(group, what, value, filter, noise);
}

// Table 2 and figure 10 of Algorithm 1, over the paper's grid and beyond its ends. `papers` are
// those of the action's training.
void algorithm_alone(const Arguments& arguments, const XiaoGroup& group, XiaoPapers& papers,
                     Lines& lines, Table& times) {
  struct Seconds {
    double learning, cleaning;
  };
  const XiaoPaperSizes usual = xiao_paper_sizes(arguments);
  const auto represent = [&](const std::string& value, const auto& paper_of) {
    const double start_s = processor_s();
    const XiaoPaper& paper = paper_of();
    const double learning_s = processor_s() - start_s;
    return Seconds{learning_s,
                   add_algorithm(lines, group, "representation", value, paper, 1, noise_20_db)};
  };
  const auto usual_paper = [&]() -> const XiaoPaper& {
    return papers.of(usual.window_frames, usual.atoms);
  };
  const Seconds poselets = represent("poselets", usual_paper);
  XiaoPaperSizes undivided = usual;
  undivided.whole = true;
  const Seconds whole = represent("whole", [&] { return XiaoPaper(group.training, undivided); });
  times.add({group.name, fmt::format("{:.2f}", whole.learning / poselets.learning),
             fmt::format("{:.2f}", whole.cleaning / poselets.cleaning)});
  for (const double lambda : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0})
    add_algorithm(lines, group, "lambda", fmt::format("{}", lambda), usual_paper(), lambda,
                  noise_20_db);
  for (const std::size_t frames : arguments.quick
                                      ? std::vector<std::size_t>{9, 15}
                                      : std::vector<std::size_t>{9, 15, 21, 27, 33, 39, 51})
    add_algorithm(lines, group, "M", std::to_string(frames), papers.of(frames, usual.atoms), 1,
                  noise_20_db);
  for (const std::size_t atoms : arguments.quick
                                     ? std::vector<std::size_t>{30, 60}
                                     : std::vector<std::size_t>{250, 500, 750, 1000, 1250})
    add_algorithm(lines, group, "K", std::to_string(atoms), papers.of(usual.window_frames, atoms),
                  1, noise_20_db);
}

void xiao_algorithm(const Arguments& arguments) {
  const std::vector<XiaoGroup> groups = xiao_groups(arguments);
  const XiaoPaperSizes usual = xiao_paper_sizes(arguments);
  Lines lines(arguments, "xiao_algorithm.csv");
  Table times(arguments, "xiao_algorithm_time.csv", "motion,learning,cleaning");
  std::vector<XiaoPapers> papers;
  for (const XiaoGroup& group : groups) {
    papers.emplace_back(group.training, usual);
    algorithm_alone(arguments, group, papers.back(), lines, times);
  }
  times.close();
  const std::vector<Take> all = training_of_all(groups);
  XiaoPaperSizes grown = usual;
  grown.atoms *= groups.size(), grown.windows *= groups.size();
  const XiaoPaper from_all(all, usual), from_all_grown(all, grown);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const XiaoPaper& from_one = papers[g].of(usual.window_frames, usual.atoms);
    add_algorithm(lines, groups[g], "from", "one", from_one, 1, noise_30_db);
    add_algorithm(lines, groups[g], "from", "all", from_all, 1, noise_30_db);
    add_algorithm(lines, groups[g], "from", "all grown", from_all_grown, 1, noise_30_db);
  }
  lines.close();
}

const Registration xiao_variants_entry("xiao_variants", xiao_variants),
    xiao_algorithm_entry("xiao_algorithm", xiao_algorithm);

}  // namespace
}  // namespace kinemend::papers
