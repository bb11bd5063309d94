// A substitute for figure 5 of Lou & Chai 2010, Example-based Human Motion Denoising: takes of a
// depth camera, cleaned by bases of marker takes of the same person. The paper's capture is not
// available.
#include <map>

#include "lou.hpp"
#include "made_pairs.hpp"
#include "system_pairs.hpp"

namespace kinemend::papers {
namespace {

struct PersonsPair {
  std::string episode;  ///< movement and number, as `m01_e03`
  Take noisy, reference;
};

// Pairs of Kinect takes by person, from names as `kinect-m01_s02_e03.noisy.trc`; without data,
// three made pairs of one person.
std::map<std::string, std::vector<PersonsPair>> pairs_by_person(const Arguments& arguments) {
  std::map<std::string, std::vector<PersonsPair>> persons;
  for (const SystemPair& pair : all_pairs_below(arguments.data / "real2")) {
    const std::string name = std::filesystem::path(pair.noisy).filename().string();
    const std::size_t person = name.find("_s"), episode = name.find("_e");
    if (pair.source != "kinect" || person == std::string::npos || episode == std::string::npos)
      continue;
    persons[name.substr(person + 1, 3)].push_back(
        {name.substr(7, person - 7) + name.substr(episode, 4), read_take(pair.noisy).take,
         read_take(pair.reference).take});
  }
  if (!persons.empty()) return persons;
  for (const char* motion : {"walk", "run", "jump"}) {
    MarkerPair made = made_pair(motion, 30, "depth");
    persons["made"].push_back({motion, std::move(made.noisy), std::move(made.reference)});
  }
  return persons;
}

// Bases of all other takes of the person.
void clean_person(const std::string& person, const std::vector<PersonsPair>& pairs,
                  std::size_t step, Table& table) {
  std::map<std::string, PairErrors> shares;
  double takes = 0;
  for (std::size_t tested = 0; tested < pairs.size(); tested += step) {
    const Take &noisy = pairs[tested].noisy, &reference = pairs[tested].reference;
    const PairInChannels both = pair_in_channels(noisy, reference, least_move_deg);
    if (!moves(both.sample)) continue;
    std::vector<Take> others;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (i != tested) others.push_back(pairs[i].reference);
    }
    const PairErrors untouched = errors_of(both.sample.take.values, both.sample);
    for (const LouMethod& method :
         lou_methods({learned("example", others), learned("kalman-learned", others), nullptr})) {
      if (method.cleaners.size() > 1) continue;  // settings that the truth would select
      const PairErrors errors = errors_of(
          channels_of(both.tracks, cleaned(*method.cleaners.front(), noisy)), both.sample);
      PairErrors& sum = shares[method.name];
      sum.value += errors.value / untouched.value;
      sum.velocity += errors.velocity / untouched.velocity;
      sum.fast += errors.fast / untouched.fast;
    }
    takes += 1;
  }
  for (const auto& [name, sum] : shares) {
    table.add({person, quoted(name), fmt::format("{:.0f}", takes), figure(sum.value / takes),
               figure(sum.velocity / takes), figure(sum.fast / takes)});
    fmt::print("{:5} {:26} {:4.0f}  {:.3f} {:.3f} {:.3f}\n", person, name, takes, sum.value / takes,
               sum.velocity / takes, sum.fast / takes);
  }
  std::fflush(stdout);
}

void lou_pairs(const Arguments& arguments) {
  Table table(arguments, "lou_pairs.csv", "person,method,takes,value,velocity,above_6_hz");
  fmt::print("Figure 5, a substitute: shares of the error of a depth camera's takes.\n\n");
  for (const auto& [person, pairs] : pairs_by_person(arguments))
    clean_person(person, pairs, pairs.size() > 5 ? 3 : 1, table);
  table.close();
}

const Registration lou_pairs_entry("lou_pairs", lou_pairs);

}  // namespace
}  // namespace kinemend::papers
