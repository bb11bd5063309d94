// The methods that the experiments on `learned` compare.
#pragma once

#include <string>
#include <vector>

#include "kinemend/methods.hpp"
#include "page.hpp"

namespace kinemend::papers {

/// A method with the stated source of the takes.
struct Compared {
  std::string label, method;
  OptionValues options{};
  Source source = Source::unknown;
};

inline Take cleaned(const Take& clip, const Compared& by) {
  CleanSettings settings;
  settings.source = by.source;
  return clean_take(clip, *make_cleaner(by.method, by.options), settings).take;
}

inline const Compared learned_of_video{"learned (video)", "learned", {}, Source::video};

inline const std::vector<Compared> auto_and_learned{
    {"auto", "auto"}, {"learned", "learned"}, {"learned live", "learned", {{"live", true}}}};

}  // namespace kinemend::papers
