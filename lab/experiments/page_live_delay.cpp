// Figures of docs/measured/live.md: error against delay, for live methods at several settings.
#include "kinemend/methods.hpp"
#include "live_takes.hpp"

namespace kinemend::papers {
namespace {

struct LiveSetting {
  std::string method;
  std::string name;  ///< "passes 2"; empty: default settings
  OptionValues options;
};

// Adds a method at several values of one option, with the options that it needs to run live.
void add_settings(std::vector<LiveSetting>& all, const std::string& method,
                  const std::string& option, const std::vector<OptionValue>& values,
                  const OptionValues& needed = {}) {
  for (const OptionValue& value : values) {
    OptionValues options = needed;
    options[option] = value;
    const double* const number = std::get_if<double>(&value);
    all.push_back(
        {method,
         fmt::format(
             "{} {}", option,
             number != nullptr ? *number : static_cast<double>(std::get<std::int64_t>(value))),
         options});
  }
}

// A grid around the defaults; no default was chosen by these results.
std::vector<LiveSetting> live_settings() {
  using Whole = std::int64_t;
  std::vector<LiveSetting> all;
  add_settings(all, "one-euro", "min_cutoff_hz", {0.5, 1.5, 3.0, 6.0});
  add_settings(all, "kalman", "agility", {0.3, 1.0, 3.0}, {{"smoother", false}});
  add_settings(all, "median", "window_s", {0.03, 0.06, 0.09, 0.15});
  add_settings(all, "gaussian", "width_s", {0.005, 0.01, 0.02, 0.03});
  add_settings(all, "weighted-mean", "passes", {Whole{1}, Whole{2}, Whole{4}, Whole{8}});
  add_settings(all, "bilateral", "passes", {Whole{1}, Whole{2}, Whole{3}, Whole{5}});
  all.push_back({"nonlocal", "", {{"causal", true}}});
  all.push_back({"learned", "", {{"live", true}}});
  return all;
}

void error_against_delay(const Arguments& arguments) {
  Table table(arguments, "page_live_delay.csv", "method,setting,delay_ms,white,spikes");
  const std::vector<Take> truths = live_takes(arguments);
  for (const LiveSetting& setting : live_settings()) {
    const auto cleaner = make_cleaner(setting.method, setting.options);
    const auto error_share = [&](double share_of_spikes) {
      return figure(live_error_share(truths, *cleaner, [&](const Take& clip) {
        return noisy(clip, 1.5, share_of_spikes, 1);
      }));
    };
    table.add({setting.method, setting.name, figure(live_delay_ms(*cleaner, truths[0])),
               error_share(0), error_share(0.004)});
  }
  table.close();
}

const Registration page_live_delay_entry("page_live_delay", error_against_delay);

}  // namespace
}  // namespace kinemend::papers
