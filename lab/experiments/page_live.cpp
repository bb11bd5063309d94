// Figures of docs/live.md: the noise that each live method leaves, and its delay.
#include "kinemend/extend/sessions.hpp"
#include "kinemend/methods.hpp"
#include "live_takes.hpp"

namespace kinemend::papers {
namespace {

// Errors as shares of that of the input, averaged over takes.
void methods_that_run_live(const Arguments& arguments) {
  Table table(arguments, "page_live.csv", "method,delay_ms,white,spikes,inertial");
  const std::vector<Take> truths = live_takes(arguments);
  for (const LiveMethod& method : live_methods()) {
    const auto cleaner = make_cleaner(method.name, method.options);
    const auto error_share = [&](const auto& damage) {
      return figure(live_error_share(truths, *cleaner, damage));
    };
    table.add({method.name, figure(live_delay_ms(*cleaner, truths[0])),
               error_share([](const Take& c) { return noisy(c, 1.5, 0, 1); }),
               error_share([](const Take& c) { return noisy(c, 1.5, 0.004, 1); }),
               error_share([](const Take& c) {
                 return damaged(c, "system", {{"kind", std::string("inertial")}}, 1);
               })});
  }
  table.close();
}

const Registration page_live_entry("page_live", methods_that_run_live);

}  // namespace
}  // namespace kinemend::papers
