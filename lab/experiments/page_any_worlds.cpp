// Figures of docs/methods/learned.md: the changes to clean takes of other worlds, that is, studios,
// rigs, rates and styles outside the training of the shipped models.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "clean_worlds.hpp"
#include "compared.hpp"
#include "kinemend/methods.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Harm {
  double rms = 0;        ///< over all tracks: degrees, or millimetres for markers
  double peak_loss = 0;  ///< of the track that loses most, of those faster than 100 degrees/s or
                         ///< 500 mm/s
};

Harm harm_of(const Take& take, const Compared& by) {
  CleanSettings settings;
  settings.source = by.source;
  const auto cleaner = make_cleaner(by.method, by.options);
  const CleanReport report = clean_take(take, *cleaner, settings).report;
  const double metres = metres_per_unit(take.unit);
  const double unit = take.has_joints() ? 1 : 1000 * (metres > 0 ? metres : 0.001);
  const double fast = take.has_joints() ? 100 : 500;
  Harm harm;
  for (const TrackSummary& track : report.tracks) {
    const double change = unit * track.rms_change;
    harm.rms += change * change / static_cast<double>(report.tracks.size());
    if (unit * track.peak_speed_before > fast)
      harm.peak_loss =
          std::max(harm.peak_loss, 1 - track.peak_speed_after / track.peak_speed_before);
  }
  harm.rms = std::sqrt(harm.rms);
  return harm;
}

void page_any_worlds(const Arguments& arguments) {
  const Worlds worlds = clean_worlds(arguments);
  std::vector<Compared> methods = auto_and_learned;
  methods.push_back(learned_of_video);
  Table table(arguments, "any_worlds.csv",
              "world,unit,method,takes,changed,median,ninety_five,most,peak_loss");
  std::map<std::pair<std::string, std::string>, std::vector<Harm>> left_out;
  const auto write = [&](const std::string& world, const std::string& unit,
                         const std::string& method, const std::vector<Harm>& harms) {
    std::vector<double> changes;
    double changed = 0, loss = 0;
    for (const Harm& harm : harms) {
      changes.push_back(harm.rms);
      changed += harm.rms > 0 ? 1 : 0;
      loss = std::max(loss, harm.peak_loss);
    }
    const double most = *std::max_element(changes.begin(), changes.end());
    const std::vector<std::string> figures{
        figure(changed / static_cast<double>(harms.size())), figure(upper_median_of(changes)),
        figure(quantile_of(changes, 0.95)), figure(most), figure(loss)};
    table.add({world, unit, quoted(method), fmt::format("{}", harms.size()), figures[0], figures[1],
               figures[2], figures[3], figures[4]});
    fmt::print("{:24} {:3} {:22} {:4}  changed {}, median {}, 95 % {}, most {}, peak loss {}\n",
               world, unit, method, harms.size(), figures[0], figures[1], figures[2], figures[3],
               figures[4]);
  };
  for (const auto& [name, takes] : worlds) {
    for (const Compared& by : methods) {
      std::vector<Harm> harms;
      for (const Take& take : takes) harms.push_back(harm_of(take, by));
      write(name.first, name.second, by.label, harms);
      if (is_learned_from(name.first)) continue;
      std::vector<Harm>& together = left_out[{name.second, by.label}];
      together.insert(together.end(), harms.begin(), harms.end());
    }
  }
  for (const auto& [name, harms] : left_out) write("left out", name.first, name.second, harms);
  table.close();
}

const Registration page_any_worlds_entry("page_any_worlds", page_any_worlds);

}  // namespace
}  // namespace kinemend::papers
