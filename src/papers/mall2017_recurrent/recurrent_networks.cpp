// Checks that a model fills gaps, has a given body, and fits the rate of a take.
#include "papers/mall2017_recurrent/recurrent_networks.hpp"

#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend {

FilterNetwork gap_network_of(const Model& model) {
  constexpr const char* needed =
      "this model of the method recurrent cleans and fills no gaps: one that does is made by "
      "kinemend-train paper --network ebd --head pose";
  FilterNetwork network = filter_network_of(model);
  if (!network.inputs.has_masks) throw Error(ErrorKind::usage, needed);
  return network;
}

bool are_same(const BodyLayout& one, const BodyLayout& other) {
  return one.kind == other.kind && one.names == other.names && one.parents == other.parents &&
         one.references == other.references && one.bones == other.bones &&
         one.with_place == other.with_place && one.place == other.place &&
         one.trend_s == other.trend_s;
}

bool has_rate_of(const FilterNetwork& network, double frame_rate_hz) {
  // Chosen by hand, not swept.
  constexpr double same_rate = 0.01;  // share of the rate
  return std::abs(frame_rate_hz / network.rate_hz - 1) <= same_rate;
}

}  // namespace kinemend
