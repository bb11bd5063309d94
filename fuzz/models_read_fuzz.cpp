// Reads any bytes as a model: a valid body and a method that cleans a take with finite numbers, or
// one-line errors.
#include <cmath>
#include <memory>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "laws.hpp"
#include "small_takes.hpp"

namespace {

using namespace kinemend;

std::unique_ptr<Cleaner> cleaner_of(const std::shared_ptr<const Model>& model) {
  if (model->method == "wiener") return make_wiener({}, model);
  if (model->method == "example") return make_example({}, model);
  if (model->method == "sparse") return make_sparse({}, model);
  if (model->method == "kalman-learned") return make_kalman_learned({}, model);
  if (model->method == "learned") return make_learned({}, model);
  if (model->method == "recurrent") return make_recurrent({}, model);
  return nullptr;
}

bool is_finite(const Take& clip) {
  for (const Quat& q : clip.rotations) {
    if (!std::isfinite(q.w + q.x + q.y + q.z)) return false;
  }
  for (const Vec3& v : clip.positions) {
    if (!std::isfinite(v.x + v.y + v.z)) return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Take joints = small_clip();
  std::shared_ptr<const Model> model;
  try {
    model = std::make_shared<const Model>(parse_model(text_of(data, size), "fuzz"));
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input}, "fuzz: ");
    return 0;
  }
  model->layout.validate();
  try {
    const auto cleaner = cleaner_of(model);
    if (!cleaner) return 0;
    Take clip = joints;
    clean_in_place(*cleaner, clip);
    check(is_finite(clip));
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input, ErrorKind::usage}, "");
  }
  return 0;
}
