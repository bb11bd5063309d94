// The entry of `recurrent` in the table of learned methods; kinemend-train trains its networks.
#include "kinemend/experimental/train.hpp"
#include "learned/papers/entries.hpp"

namespace kinemend {

LearnedMethod recurrent_learned() {
  return {"recurrent", 1, "network that predicts filters (by kinemend-train paper)", {}, nullptr};
}

}  // namespace kinemend
