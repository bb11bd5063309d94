// Figures of docs/measured/regret.md: the default beside every method of the program, on every kind
// of noise and source, with each method's changes to clean takes.
#include <algorithm>
#include <map>
#include <memory>

#include "compared.hpp"
#include "kinemend/methods.hpp"
#include "page.hpp"
#include "regret_rows.hpp"

namespace kinemend::papers {
namespace {

const std::string untouched = "untouched", best_cut = "best cut", default_method = "learned";

// These methods need minutes for a take of minutes.
bool is_slow(const std::string& method) { return method == "sparse" || method == "example"; }

// A cleaner that loads its model only once.
struct NamedCleaner {
  std::string label, method;
  Source source = Source::unknown;
  std::shared_ptr<const Cleaner> cleaner;
};

std::vector<NamedCleaner> cleaners_compared() {
  std::vector<Compared> all;
  for (const Method& method : methods()) all.push_back({method.name, method.name});
  all.push_back({"learned live", "learned", {{"live", true}}});
  all.push_back(learned_of_video);
  std::vector<NamedCleaner> cleaners;
  for (const Compared& by : all) {
    try {
      cleaners.push_back({by.label, by.method, by.source, make_cleaner(by.method, by.options)});
    } catch (const Error& error) {
      // A method whose model every user trains has no defaults.
      if (error.kind() != ErrorKind::usage) throw;
    }
  }
  return cleaners;
}

// Excludes the oracle's cut, which no user has, and the default with options that a user would have
// to choose.
bool counts_for_regret(const std::string& method) {
  return method != untouched && method != best_cut && !method.starts_with("learned ");
}

// Figures of each take on which the method ran, by take number.
using RegretErrors = std::map<std::size_t, std::vector<double>>;

Take cleaned_case(const RegretRow& row, const RegretCase& given, const Cleaner& cleaner,
                  Source source = Source::unknown) {
  CleanSettings settings;
  settings.source = source;
  if (row.has_gaps) settings.fill.emplace();
  return clean_take(given.take, cleaner, settings).take;
}

std::vector<double> best_cut_errors(const RegretRow& row, const RegretCase& given) {
  std::vector<double> best = given.errors(given.take);
  for (const double cutoff_hz : row.cutoffs_hz) {
    if (cutoff_hz >= given.take.frame_rate_hz / 2.2) break;
    const std::vector<double> errors = given.errors(
        cleaned_case(row, given, *make_cleaner("butterworth", {{"cutoff_hz", cutoff_hz}})));
    if (errors[row.cut_by] < best[row.cut_by]) best = errors;
  }
  return best;
}

std::map<std::string, RegretErrors> measured(const RegretRow& row) {
  static const std::vector<NamedCleaner> all = cleaners_compared();
  std::map<std::string, RegretErrors> errors;
  for (std::size_t i = 0; i < row.cases.size(); ++i) {
    const RegretCase given = row.cases[i]();
    errors[untouched][i] = given.errors(given.take);
    // Cutting cannot improve a clean take.
    if (!row.is_clean) errors[best_cut][i] = best_cut_errors(row, given);
    for (const NamedCleaner& by : all) {
      if (is_slow(by.method) && (!row.has_slow || i > 0)) continue;
      try {
        errors[by.label][i] = given.errors(cleaned_case(row, given, *by.cleaner, by.source));
      } catch (const Error& error) {
        // A method for joints refuses markers, and a learned method refuses unknown bodies.
        if (error.kind() != ErrorKind::usage) throw;
      }
    }
  }
  return errors;
}

struct Mean {
  double error = 0, share = 0, worst = 0;
};

// Means over the takes on which `other` ran.
Mean mean_of(const RegretErrors& errors, const RegretErrors& before, const RegretErrors& other,
             std::size_t figure) {
  Mean mean;
  const auto count = static_cast<double>(other.size());
  for (const auto& [number, unused] : other) {
    const double error = errors.at(number)[figure];
    mean.error += error / count;
    mean.share += error / before.at(number)[figure] / count;
    mean.worst = std::max(mean.worst, error);
  }
  return mean;
}

// Methods that ran on all takes of the default, or on the first take if they are slow.
bool is_comparable(const std::string& method, const RegretErrors& errors,
                   const RegretErrors& of_default) {
  return counts_for_regret(method) && (is_slow(method) || errors.size() == of_default.size());
}

struct Regret {
  std::string best;  ///< name of the best method
  double regret = 0;
};

Regret regret_of(const std::map<std::string, RegretErrors>& all, std::size_t figure) {
  const RegretErrors& before = all.at(untouched);
  const RegretErrors& of_default = all.at(default_method);
  Regret result{default_method, 1};
  for (const auto& [method, errors] : all) {
    if (!is_comparable(method, errors, of_default)) continue;
    const double regret = mean_of(of_default, before, errors, figure).share /
                          mean_of(errors, before, errors, figure).share;
    if (regret > result.regret) result = {method, regret};
  }
  return result;
}

class RegretTables {
 public:
  explicit RegretTables(const Arguments& arguments)
      : methods_(arguments, "regret_methods.csv", "row,method,takes,error,share,worst"),
        rows_(arguments, "regret.csv", "row,unit,takes,best,best_share,regret") {}

  void add(const RegretRow& row) {
    const std::map<std::string, RegretErrors> all = measured(row);
    for (std::size_t figure = 0; figure < row.figures.size(); ++figure) {
      const std::string name =
          row.figures[figure].empty() ? row.name : row.name + ", " + row.figures[figure];
      for (const auto& [method, errors] : all) add_method(row, name, method, errors, all, figure);
      if (!row.is_clean) add_regret(row, name, all, figure);
    }
  }

  void close() {
    double mean = 0, most = 0;
    for (const double regret : regrets_) {
      mean += regret / static_cast<double>(regrets_.size());
      most = std::max(most, regret);
    }
    const std::string count = fmt::format("{}", regrets_.size());
    rows_.add({"mean", "", count, "", "", figure(mean)});
    rows_.add({"worst", "", count, "", "", figure(most)});
    fmt::print("regret over {} rows: mean {:.3f}, worst {:.3f}\n", count, mean, most);
    methods_.close();
    rows_.close();
  }

 private:
  void add_method(const RegretRow& row, const std::string& name, const std::string& method,
                  const RegretErrors& errors, const std::map<std::string, RegretErrors>& all,
                  std::size_t number) {
    if (row.is_clean && method == untouched) return;
    const Mean mean = mean_of(errors, all.at(untouched), errors, number);
    methods_.add({quoted(name), quoted(method), fmt::format("{}", errors.size()),
                  figure(mean.error), row.is_clean ? "" : figure(mean.share), figure(mean.worst)});
    fmt::print("{:36} {:24} {:3} takes  {:9.4f} {:3}  {}\n", name, method, errors.size(),
               mean.error, row.unit,
               row.is_clean ? fmt::format("worst {:.4f}", mean.worst)
                            : fmt::format("share {:.3f}", mean.share));
  }

  void add_regret(const RegretRow& row, const std::string& name,
                  const std::map<std::string, RegretErrors>& all, std::size_t number) {
    const Regret regret = regret_of(all, number);
    const RegretErrors& best = all.at(regret.best);
    rows_.add({quoted(name), row.unit, fmt::format("{}", row.cases.size()), regret.best,
               figure(mean_of(best, all.at(untouched), best, number).share),
               figure(regret.regret)});
    fmt::print("{:36} regret {:.3f} ({})\n", name, regret.regret, regret.best);
    regrets_.push_back(regret.regret);
  }

  Table methods_, rows_;
  std::vector<double> regrets_;
};

void page_regret(const Arguments& arguments) {
  RegretTables tables(arguments);
  for (const RegretRow& row : regret_rows(arguments)) tables.add(row);
  tables.close();
}

const Registration page_regret_entry("page_regret", page_regret);

}  // namespace
}  // namespace kinemend::papers
