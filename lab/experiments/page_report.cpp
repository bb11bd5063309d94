// Figures of docs/report-html.md: the size of a page for takes of 31 joints at 120 Hz.
#include "kinemend/clean.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/report.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

template <class Value>
void repeat(std::vector<Value>& values, std::size_t times) {
  const std::vector<Value> once = values;
  for (std::size_t i = 1; i < times; ++i) values.insert(values.end(), once.begin(), once.end());
}

// The take repeated several times.
Take repeated(Take clip, std::size_t times) {
  repeat(clip.rotations, times);
  repeat(clip.positions, times);
  repeat(clip.observed, times);
  repeat(clip.observed_positions, times);
  clip.validate();
  return clip;
}

// Size of the data alone: the page's program is the same for all takes and changes independently.
double megabytes(const Report& report, const Take& before, const Take* after) {
  const std::size_t program = served_page("", "", {}).size();
  return static_cast<double>(report_page(report, before, after, {}).size() - program) / 1e6;
}

// Jitter of 1.5 degrees and spikes, cleaned by `auto`.
void sizes_of_pages(const Arguments& arguments) {
  if (!has_report_page()) return;
  struct Length {
    const char* name;
    double synth_s;
    std::size_t times;
  };
  std::vector<Length> lengths = {{"a minute", 60, 1}};
  if (!arguments.quick) {
    lengths.push_back({"ten minutes", 600, 1});
    lengths.push_back({"an hour", 600, 6});
  }
  Table table(arguments, "page_report.csv", "take,frames,clean_mb,check_mb");
  for (const Length& length : lengths) {
    const Take take =
        noisy(repeated(synthesize({.duration_s = length.synth_s}), length.times), 1.5, 0.004, 1);
    const auto cleaner = make_cleaner("auto", {});
    CleanResult cleaned = clean_take(take, *cleaner);
    const Report report{take_facts(take), std::move(cleaned.report)};
    table.add({length.name, fmt::format("{}", take.frame_count()),
               figure(megabytes(report, take, &cleaned.take)),
               figure(megabytes(report, take, nullptr))});
  }
  table.close();
}

const Registration page_report_entry("page_report", sizes_of_pages);

}  // namespace
}  // namespace kinemend::papers
