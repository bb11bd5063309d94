// The entry of `learned` in the table of learned methods; kinemend-train trains its network.
#include "kinemend/experimental/train.hpp"
#include "learned/corrector/entries.hpp"

namespace kinemend {

LearnedMethod learned_learned() {
  return {"learned", 1, "network that cleans any take (by kinemend-train learned)", {}, nullptr};
}

}  // namespace kinemend
