#include "kinemend/experimental/train.hpp"
#include "learned/papers/entries.hpp"

namespace kinemend {

LearnedMethod recurrent_learned() {
  return {"recurrent", 1, "network that predicts filters (by kinemend-train paper)", {}, nullptr};
}

}  // namespace kinemend
