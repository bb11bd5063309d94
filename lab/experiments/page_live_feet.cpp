// Figures of docs/measured/live.md: how far feet slide in a stream, before and after holding them.
#include <array>

#include "feet/live_feet.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/methods.hpp"
#include "live_takes.hpp"

namespace kinemend::papers {
namespace {

Take with_feet_held(Take clip) {
  feet::LiveFeet feet(clip);
  const TakeView view = view_of(clip);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    Frame frame = frame_of(view, f);
    feet.hold(frame.rotations, frame.positions);
    std::copy(frame.rotations.begin(), frame.rotations.end(), &clip.rotation(f, 0));
  }
  return clip;
}

struct FeetSums {
  double slide = 0, knee_pop = 0, error = 0, position = 0;
};

// Adds figures of a result; the contacts come from the truth.
void add_feet(const Take& truth, const std::vector<FootContact>& contacts, const Take& made,
              FeetSums& sums) {
  const double height = body_height(truth.skeleton);
  const FeetFigures figures = feet_figures(made, contacts);
  sums.slide += 1000 * figures.slide / height;
  sums.knee_pop += figures.knee_pop_deg;
  sums.error += geodesic_rms_deg(truth, made);
  sums.position += 1000 * mpjpe(truth, made) / height;
}

void live_feet(const Arguments& arguments) {
  Table table(arguments, "page_live_feet.csv",
              "noise,method,feet,slide,knee_pop_deg,rms_deg,mpjpe");
  const std::vector<Take> truths = live_takes(arguments);
  const auto cleaner = make_cleaner("median", {});
  const auto learned = make_cleaner("learned", {{"live", true}});
  for (const char* const noise : {"none", "white", "inertial"}) {
    for (const Cleaner* method : std::array<const Cleaner*, 2>{cleaner.get(), learned.get()}) {
      FeetSums off, on;
      for (const Take& truth : truths) {
        const auto contacts = true_contacts(truth);
        const Take came = noise == std::string("none") ? truth
                          : noise == std::string("white")
                              ? noisy(truth, 1.5, 0, 1)
                              : damaged(truth, "system", {{"kind", std::string("inertial")}}, 1);
        const Take clean = streamed(came, *method);
        add_feet(truth, contacts, clean, off);
        add_feet(truth, contacts, with_feet_held(clean), on);
      }
      for (const auto& [held, s] : {std::pair{"no", off}, std::pair{"yes", on}}) {
        const double n = static_cast<double>(truths.size());
        table.add({noise, std::string(method->name()), held, figure(s.slide / n),
                   figure(s.knee_pop / n), figure(s.error / n), figure(s.position / n)});
      }
    }
  }
  table.close();
}

const Registration page_live_feet_entry("page_live_feet", live_feet);

}  // namespace
}  // namespace kinemend::papers
