// Trains the network that finds standing feet (`feet/contact_network.hpp`). LibTorch is hidden
// behind this header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "lab/samples/contact_samples.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

/// Settings of a training.
struct ContactTraining {
  std::uint64_t seed = 1;
  feet::Lookahead lookahead = feet::Lookahead::whole;
  std::size_t batches = 6000;
  std::size_t batch = 24;   ///< samples of a step
  std::size_t steps = 300;  ///< of a sample, sixty a second
  std::size_t width = 48;
  std::vector<std::size_t> dilations{1, 2, 4, 8, 16, 32};
  double rate = 3e-3;  ///< peak learning rate
  DescentSettings descent;
};

/// Shares of standing time.
struct ContactScore {
  double loss = 0;   ///< mean cross entropy, nats
  double found = 0;  ///< of the standing time
  double right = 0;  ///< of the time found
};

class ContactTrainer {
 public:
  /// `sources` must outlive this.
  ContactTrainer(std::span<const ContactSource> sources, const ContactTraining& settings);
  ~ContactTrainer();

  std::size_t batch() const noexcept;
  /// Makes one step and returns its loss.
  double step();
  /// Measured on samples drawn from other sources.
  ContactScore score(std::span<const ContactSource> sources, std::size_t samples,
                     std::uint64_t seed) const;
  /// Adds the weights to a model, which also holds the network of the other kind of lookahead.
  void put(Model& model) const;
  /// The complete state; `resume` goes on from it.
  TensorFile state() const;
  void resume(const TensorFile& state, std::size_t batch);

  ContactTrainer(ContactTrainer&&) noexcept;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

/// `kinemend-train contacts ...`. Returns the exit code.
int contact_program(int count, char** values);

}  // namespace kinemend::train
