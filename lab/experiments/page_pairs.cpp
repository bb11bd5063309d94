// Figures of docs/measured/auto.md about real pairs: takes of video and depth cameras beside
// optical markers of the same motion, cleaned.
#include <algorithm>
#include <cmath>

#include "camera_pairs.hpp"
#include "kinemend/methods.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

void page_pairs(const Arguments& arguments) {
  const std::vector<MarkerPair> pairs = camera_pairs(arguments);
  PairErrors automatic, white, best;
  const auto add = [&](PairErrors& sum, const PairErrors& is, const PairErrors& was) {
    const auto count = static_cast<double>(pairs.size());
    sum.value += is.value / was.value / count;
    sum.velocity += is.velocity / was.velocity / count;
    sum.fast += is.fast / was.fast / count;
  };
  for (const auto& [reference, noisy] : pairs) {
    const auto errors_by = [&](const std::string& method, const OptionValues& options,
                               const CleanSettings& settings) {
      return errors_of(reference, noisy,
                       clean_take(noisy, *make_cleaner(method, options), settings).take);
    };
    const PairErrors was = errors_of(reference, noisy, noisy);
    add(automatic, errors_by("auto", {}, {}), was);
    CleanSettings as_white;
    as_white.noise.emplace();
    add(white, errors_by("auto", {}, as_white), was);
    PairErrors least{0, 1e300, 0};
    for (double cutoff_hz = 0.5; cutoff_hz < 12; cutoff_hz *= 1.25) {
      const PairErrors is = errors_by("butterworth", {{"cutoff_hz", cutoff_hz}}, {});
      if (is.velocity < least.velocity) least = is;
    }
    add(best, least, was);
  }
  Table table(arguments, "page_pairs.csv", "method,position,velocity,above_6_hz");
  for (const auto& [name, errors] :
       {std::pair{"auto", automatic}, {"noise taken for white", white}, {"best Butterworth", best}})
    table.add({name, figure(errors.value), figure(errors.velocity), figure(errors.fast)});
  table.close();
}

const Registration page_pairs_entry("page_pairs", page_pairs);

}  // namespace
}  // namespace kinemend::papers
