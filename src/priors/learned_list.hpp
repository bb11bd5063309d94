#pragma once

/// The learned methods, one a line. Line `NAME` stands for two functions: `LearnedMethod
/// NAME_learned()` of this room, which is how the model is fitted and what its file is called, and
/// `Method NAME_method()` of the room `clean`, which makes the cleaner. Training, the reader of
/// model files and the table of methods all go by this list.
#define KINEMEND_LEARNED_METHODS(METHOD) \
  METHOD(example)                        \
  METHOD(wiener)                         \
  METHOD(kalman_learned)

namespace kinemend {

struct LearnedMethod;
#define KINEMEND_DECLARE(name) LearnedMethod name##_learned();
KINEMEND_LEARNED_METHODS(KINEMEND_DECLARE)
#undef KINEMEND_DECLARE

}  // namespace kinemend
