// Figures of docs/live.md: what each method that runs live leaves of noise, and its delay.
#include <algorithm>
#include <array>

#include "kinemend/experimental/live.hpp"
#include "kinemend/stream.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

Take streamed(const Take& clip, const Cleaner& cleaner) {
  const auto stream = make_stream(cleaner, clip);
  const TakeView view = view_of(clip);
  Take result = clip;
  Frame out;
  std::size_t next = 0;
  const auto take = [&] {
    std::copy(out.rotations.begin(), out.rotations.end(), &result.rotation(next++, 0));
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (stream->push(frame_of(view, f), out)) take();
  }
  while (stream->flush(out)) take();
  return result;
}

// Errors as shares of that of the take that came in, means over takes.
void methods_that_run_live(const Arguments& arguments) {
  Table table(arguments, "page_live.csv", "method,delay_ms,white,spikes,inertial");
  std::vector<Take> truths;
  for (const auto& [name, motion] :
       std::array<std::pair<const char*, const char*>, 6>{{{"35_01", "walk"},
                                                           {"02_05", "punch"},
                                                           {"09_03", "run"},
                                                           {"05_01", "walk"},
                                                           {"16_21", "walk"},
                                                           {"08_02", "run"}}}) {
    if (arguments.quick && truths.size() == 3) break;
    truths.push_back(load_take(arguments, std::string(name) + ".bvh", {.motion = motion}).clip);
  }
  const auto error_share = [&](const Cleaner& cleaner, const auto& damage) {
    double sum = 0;
    for (const Take& truth : truths) {
      const Take noisy = damage(truth);
      sum += geodesic_rms_deg(truth, streamed(noisy, cleaner)) / geodesic_rms_deg(truth, noisy);
    }
    return figure(sum / static_cast<double>(truths.size()));
  };
  std::vector<LiveMethod> candidates = live_methods();
  for (const LiveMethod& method : candidates) {
    const auto cleaner = make_cleaner(method.name, method.options);
    const double delay_ms =
        1000.0 / 120 * static_cast<double>(make_stream(*cleaner, truths[0])->latency_frames());
    table.add({method.name, figure(delay_ms),
               error_share(*cleaner, [](const Take& c) { return noisy(c, 1.5, 0, 1); }),
               error_share(*cleaner, [](const Take& c) { return noisy(c, 1.5, 0.004, 1); }),
               error_share(*cleaner, [](const Take& c) {
                 return damaged(c, "system", {{"kind", std::string("inertial")}}, 1);
               })});
  }
  table.close();
}

const Registration registration("page_live", methods_that_run_live);

}  // namespace
}  // namespace kinemend::papers
