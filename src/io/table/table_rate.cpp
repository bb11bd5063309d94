// Compares the stated rate with the times of the rows, and reports assumptions.
#include "io/table/read_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/stated_rate.hpp"

namespace kinemend {

double table_rate(const SourceText& text, Diagnostics& diagnostics, const RowRate& times,
                  const TableRate& said) {
  // Relative difference of the stated rate and the times' rate. Chosen by hand, not swept.
  constexpr double tolerance = 0.01;
  const double stated = usable_rate(text, diagnostics, said.stated_hz, said.stated_place);
  if (stated > 0) {
    const double off_s = std::fabs(1 / stated - times.step_s);
    if (times.rate_hz > 0 && off_s > tolerance / stated + times.tolerance_s) {
      note_repair(text, diagnostics, "time_mismatch", said.mismatch_place,
                  fmt::format("{0} states {1} Hz, the times {2:.6g} Hz: {0} is used",
                              said.stated_by, stated, times.rate_hz));
    }
    return stated;
  }
  const double of_times = usable_rate(text, diagnostics, times.rate_hz, said.rows_place);
  const bool by_times = of_times > 0, by_options = said.asked_hz > 0;
  const double rate = by_times ? of_times : by_options ? said.asked_hz : said.unknown_hz;
  if (said.must_be_stated || !(by_times || by_options)) {
    note_repair(text, diagnostics, "frame_rate_assumed", said.stated_place,
                fmt::format("{}: {:.6g} Hz {}", said.missing, rate,
                            by_times     ? "from the times"
                            : by_options ? "as requested"
                                         : "assumed"));
  }
  return rate;
}

}  // namespace kinemend
