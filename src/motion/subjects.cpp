// Groups markers by the subject in their names.
#include "kinemend/experimental/subjects.hpp"

#include <algorithm>

namespace kinemend {

namespace {

std::string subject_name(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string::npos ? std::string() : name.substr(0, colon);
}

}  // namespace

std::vector<Subject> subjects_of(const Take& clip) {
  std::vector<Subject> subjects;
  Subject nobody, all;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!clip.holds_positions(m)) continue;
    all.markers.push_back(m);
    const std::string name = subject_name(clip.names[m]);
    if (name.empty()) {
      nobody.markers.push_back(m);
      continue;
    }
    auto found = std::find_if(subjects.begin(), subjects.end(),
                              [&](const Subject& subject) { return subject.name == name; });
    if (found == subjects.end()) found = subjects.insert(found, {name, {}});
    found->markers.push_back(m);
  }
  if (all.markers.empty()) return {};
  if (subjects.size() < 2) return {all};
  if (!nobody.markers.empty()) subjects.push_back(std::move(nobody));
  return subjects;
}

}  // namespace kinemend
