// The methods that the experiments on `learned` compare.
#pragma once

#include <string>
#include <vector>

#include "page.hpp"

namespace kinemend::papers {

struct Compared {
  std::string label, method;
  OptionValues options{};
};

inline Take cleaned(const Take& clip, const Compared& by) {
  return cleaned(clip, by.method, by.options);
}

inline const std::vector<Compared> auto_and_learned{
    {"auto", "auto"}, {"learned", "learned"}, {"learned live", "learned", {{"live", true}}}};

}  // namespace kinemend::papers
