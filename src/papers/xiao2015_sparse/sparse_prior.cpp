// Stores the prior of `sparse` in a model file and reads it.
#include "papers/xiao2015_sparse/sparse_prior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

using TensorShape = std::vector<std::size_t>;

[[noreturn]] void fail(const std::string& tensor) {
  throw Error(ErrorKind::unreadable_input,
              fmt::format("the model's {} does not fit its body", tensor));
}

std::string tensor_name(std::size_t poselet, const char* what) {
  return fmt::format("poselet{}.{}", poselet, what);
}

Tensor integers(const std::vector<std::int32_t>& values) {
  return {TensorType::i32, {values.size()}, {values.begin(), values.end()}};
}

// Whole numbers of at least `least` and below `end`.
std::vector<std::int32_t> integers_of(const Model& model, const std::string& name, double least,
                                      std::size_t end) {
  std::vector<std::int32_t> result;
  for (const double value : model.tensor(name, 1).values) {
    if (value < least || value >= static_cast<double>(end) || value != std::floor(value))
      fail(name);
    result.push_back(static_cast<std::int32_t>(value));
  }
  return result;
}

SparsePoints points_of_model(const Model& model) {
  const std::size_t tracks = model.layout.track_count();
  SparsePoints points;
  points.kind = model.layout.kind;
  points.parents = integers_of(model, "point_parents", -1, tracks);
  const std::size_t count = points.parents.size();
  for (std::size_t p = 0; p < count; ++p) {
    const bool is_root = points.kind == BodyKind::markers || p == 0;
    const auto before = static_cast<std::int32_t>(std::min(p, tracks));
    if (is_root ? points.parents[p] != -1 : points.parents[p] < 0 || points.parents[p] >= before)
      fail("point_parents");
  }
  if (count < tracks || count == 0 || (points.kind == BodyKind::markers && count != tracks))
    fail("point_parents");
  const std::vector<double>& offsets = model.tensor("offsets", TensorShape{count, 3}).values;
  for (std::size_t p = 0; p < count; ++p)
    points.offsets.push_back({offsets[3 * p], offsets[3 * p + 1], offsets[3 * p + 2]});
  return points;
}

SparsePoselet poselet_of_model(const Model& model, std::size_t number, std::size_t points,
                               std::size_t window) {
  SparsePoselet poselet;
  poselet.name = tensor_name(number, "points");
  poselet.points = integers_of(model, tensor_name(number, "points"), 0, points);
  const std::size_t channels = poselet.channels();
  const std::vector<double>& mean =
      model.tensor(tensor_name(number, "mean"), TensorShape{channels}).values;
  poselet.mean.assign(mean.begin(), mean.end());
  const std::string name = tensor_name(number, "atoms");
  const Tensor& atoms = model.tensor(name, 3);
  if (channels == 0 || atoms.shape[0] == 0 || atoms.shape[1] != window ||
      atoms.shape[2] != channels)
    fail(name);
  poselet.dictionary.rows = window * channels;
  poselet.dictionary.atoms = atoms.shape[0];
  poselet.dictionary.values.assign(atoms.values.begin(), atoms.values.end());
  return poselet;
}

}  // namespace

void store_sparse_prior(const SparsePrior& prior, Model& model) {
  model.rate_hz = prior.rate_hz;
  model.numbers["window_frames"] = static_cast<double>(prior.window_frames);
  model.numbers["poselets"] = static_cast<double>(prior.poselets.size());
  model.tensors["point_parents"] = integers(prior.points.parents);
  Tensor offsets{TensorType::f32, {prior.points.count(), 3}, {}};
  for (const Vec3 offset : prior.points.offsets)
    offsets.values.insert(offsets.values.end(), {offset.x, offset.y, offset.z});
  model.tensors["offsets"] = offsets;
  const LocalPoints& local = prior.local;
  model.tensors["local_points"] =
      integers({local.root, local.left_hip, local.right_hip, local.neck});
  for (std::size_t i = 0; i < prior.poselets.size(); ++i) {
    const SparsePoselet& poselet = prior.poselets[i];
    model.tensors[tensor_name(i, "points")] = integers(poselet.points);
    model.tensors[tensor_name(i, "mean")] = {
        TensorType::f32, {poselet.channels()}, {poselet.mean.begin(), poselet.mean.end()}};
    const sparse::Dictionary& atoms = poselet.dictionary;
    model.tensors[tensor_name(i, "atoms")] = {
        TensorType::f16,
        {atoms.atoms, prior.window_frames, poselet.channels()},
        {atoms.values.begin(), atoms.values.end()}};
  }
}

SparsePrior sparse_prior_of(const Model& model) {
  SparsePrior prior;
  prior.rate_hz = model.rate_hz;
  prior.points = points_of_model(model);
  const double window = model.number("window_frames"), poselets = model.number("poselets");
  if (!(window >= 1) || window > 1e4 || !(poselets >= 1) || poselets > 100) fail("window_frames");
  prior.window_frames = static_cast<std::size_t>(window);
  const std::vector<std::int32_t> local =
      integers_of(model, "local_points", -1, prior.points.count());
  if (local.size() != 4) fail("local_points");
  prior.local = {local[0], local[1], local[2], local[3]};
  for (std::size_t i = 0; i < static_cast<std::size_t>(poselets); ++i)
    prior.poselets.push_back(poselet_of_model(model, i, prior.points.count(), prior.window_frames));
  return prior;
}

}  // namespace kinemend
