// Makes a motion by its name.
#include "lab/synthesis/motions.hpp"

namespace kinemend::synth {

Motion make_motion(std::string_view name, const Body& body, double duration_s,
                   const Random& random) {
  if (name == "run") return run(body, duration_s, random);
  if (name == "jump") return jump(body, random);
  if (name == "turn") return turn(body, duration_s, random);
  if (name == "wave") return wave(body, random);
  if (name == "stroll") return stroll(body, duration_s, random);
  if (name == "clap") return clap(body, random);
  if (name == "punch") return punch(body, random);
  if (name == "landing") return landing(body, random);
  if (name == "still") return still(body, random);
  return walk(body, duration_s, random);
}

}  // namespace kinemend::synth
