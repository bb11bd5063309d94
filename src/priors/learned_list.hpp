#pragma once

/// The learned methods, one per line. `NAME` has two functions: `LearnedMethod
/// NAME_learned()` of this room, which fits the model and names its file, and
/// `Method NAME_method()` of the room `clean`, which makes the cleaner. Training, the reader of
/// model files and the table of methods use this list. Networks, on the second, are trained by a
/// program of its own (`kinemend-train`).
#define KINEMEND_LEARNED_METHODS(METHOD) \
  METHOD(example)                        \
  METHOD(wiener)                         \
  METHOD(sparse)                         \
  METHOD(kalman_learned)
#define KINEMEND_NETWORK_METHODS(METHOD) METHOD(recurrent) METHOD(learned)

namespace kinemend {

struct LearnedMethod;
#define KINEMEND_DECLARE(name) LearnedMethod name##_learned();
KINEMEND_LEARNED_METHODS(KINEMEND_DECLARE)
KINEMEND_NETWORK_METHODS(KINEMEND_DECLARE)
#undef KINEMEND_DECLARE

}  // namespace kinemend
