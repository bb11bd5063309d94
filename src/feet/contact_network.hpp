// Estimates how likely each heel and toe stands, with a small network on the motion of both feet
// and the body's middle. Slow errors move standing feet, so that thresholds on height and speed
// miss them; the motion of the whole body shows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "feet/body_points.hpp"
#include "feet/contact_features.hpp"
#include "kinemend/extend/model.hpp"
#include "nn/layers.hpp"

namespace kinemend::feet {

/// Convolutions in time with residual blocks; the same weights for every foot.
struct ContactNetwork {
  struct Block {
    nn::Convolution convolution;
    nn::Dense dense;
  };
  nn::Convolution encoder;
  std::vector<Block> blocks;
  nn::Dense output;  ///< logarithms of the odds of heel and toe
};

/// Errors: `ErrorKind::unreadable_input` naming the missing or inconsistent tensor or number.
ContactNetwork contact_network_of(const Model& model, Lookahead lookahead);

/// The network of the shipped model, which is read once; null if no model ships.
std::shared_ptr<const ContactNetwork> shipped_contact_network(Lookahead lookahead);

/// Returns L x n x 2 logarithms of the odds that heel and toe stand.
std::vector<float> run(const ContactNetwork& network, const ContactSteps& steps);

/// The network of streams, step by step, with the result of `run` on the same steps at once.
class LiveContactNetwork {
 public:
  /// `network`: without lookahead; it must outlive this.
  LiveContactNetwork(const ContactNetwork& network, std::size_t feet);

  /// `rows`: L x `contact_features`. Returns L x 2 logarithms of odds, valid until the next call.
  std::span<const float> run(std::span<const float> rows);

 private:
  struct Layer {
    const nn::Convolution* convolution = nullptr;
    std::vector<float> past;  // L x (2 dilation + 1) rows of inputs, a ring
  };
  void run(Layer& layer, std::size_t foot, std::span<const float> input, std::span<float> output);

  const ContactNetwork& network_;
  std::size_t feet_ = 0, steps_ = 0;
  std::vector<Layer> layers_;  // the encoder, then one for each block
  std::vector<float> hidden_, inner_, added_, odds_;
};

/// Returns the logarithm of the odds that each point of `soles` stands, F x 2 L.
std::vector<float> standing_odds(const ContactNetwork& network, const BodyPoints& soles, Up up,
                                 Lookahead lookahead, std::span<const std::uint8_t> touching = {});

}  // namespace kinemend::feet
