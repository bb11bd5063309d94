// Computes the loss of a batch in parts, one thread each, and adds their gradients in a fixed
// order.
#include "motion_descent.hpp"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "descent.hpp"
#include "methods/learned/motion_network.hpp"

namespace kinemend::train {

namespace {

constexpr std::size_t samples_of_part = 4;

std::int64_t whole(std::size_t value) { return static_cast<std::int64_t>(value); }

torch::Tensor tensor_of(const std::vector<float>& values, std::vector<std::int64_t> shape) {
  return torch::from_blob(const_cast<float*>(values.data()), shape);
}

struct Inputs {
  torch::Tensor features, take_features, levels, changes, scales, truth, truth_changes, alive,
      known, looks_ahead;

  // At most `count` samples from `first` on.
  Inputs samples(std::size_t first, std::size_t count) const {
    const std::int64_t from = whole(first), n = std::min(whole(count), alive.size(0) - from);
    const auto part = [&](const torch::Tensor& x) { return x.narrow(0, from, n); };
    return {part(features), part(take_features), part(levels), part(changes), part(scales),
            part(truth),    part(truth_changes), part(alive),  part(known),   part(looks_ahead)};
  }
};

Inputs inputs_of(const MotionBatch& batch) {
  const std::int64_t b = whole(batch.samples), c = whole(batch.channels), n = whole(batch.steps);
  return {tensor_of(batch.features, {b, c, n, whole(motion_features)}),
          tensor_of(batch.take_features, {b, c, n, whole(motion_take_features)}),
          tensor_of(batch.levels, {b, c, n, whole(motion_levels)}),
          tensor_of(batch.changes, {b, c, n, whole(motion_levels)}),
          tensor_of(batch.scales, {b, c, n, whole(motion_scales)}),
          tensor_of(batch.truth, {b, c, n}),
          tensor_of(batch.truth_changes, {b, c, n}),
          tensor_of(batch.alive, {b, c}),
          tensor_of(batch.known, {b, c}),
          tensor_of(batch.looks_ahead, {b, 1, 1})};
}

// Central differences of a sequence of steps, per 1/120 s.
torch::Tensor slope_of(const torch::Tensor& x) {
  const std::int64_t n = x.size(2);
  const torch::Tensor before = torch::cat({x.narrow(2, 0, 1), x.narrow(2, 0, n - 1)}, 2);
  const torch::Tensor behind = torch::cat({x.narrow(2, 1, n - 1), x.narrow(2, n - 1, 1)}, 2);
  return (behind - before) / 8;
}

// Differences between successive steps.
torch::Tensor step_changes(const torch::Tensor& x) {
  const std::int64_t n = x.size(2);
  return x.narrow(2, 1, n - 1) - x.narrow(2, 0, n - 1);
}

}  // namespace

struct MotionDescent::Body {
  MotionShape shape;
  Descent descent;
  torch::Tensor mean, deviation, speed;

  torch::Tensor outputs(const LayerCall& call, const Inputs& in) const {
    const std::int64_t b = in.features.size(0), c = in.features.size(1), n = in.features.size(2);
    const std::int64_t encoded = whole(shape.encoded);
    const torch::Tensor alive = in.alive.unsqueeze(2).unsqueeze(3);
    const torch::Tensor known = in.known.unsqueeze(2).unsqueeze(3) * alive;
    const torch::Tensor ahead = in.looks_ahead.unsqueeze(3);
    torch::Tensor h = torch::relu(call.convolution(in.features, "encoder", 1, ahead) +
                                  call.dense(in.take_features, "of_take"));
    h = (h + torch::relu(call.convolution(h, "second_encoder", shape.second_dilation, ahead))) *
        alive;
    const torch::Tensor count = in.alive.sum(1).clamp_min(1).view({b, 1, 1});
    const torch::Tensor pooled = torch::cat({h.sum(1) / count, (h * h).sum(1) / count}, 2);
    const torch::Tensor per_track =
        in.alive.view({b, c / 3, 3}).sum(2).clamp_min(1).view({b, c / 3, 1, 1, 1});
    const torch::Tensor of_track = (h.view({b, c / 3, 3, n, encoded}).sum(2, true) / per_track)
                                       .expand({b, c / 3, 3, n, encoded})
                                       .reshape({b, c, n, encoded});
    const torch::Tensor pose =
        ((in.levels.select(3, 3) - mean) / deviation).clamp(-most_pose, most_pose) *
        known.squeeze(3);
    const torch::Tensor pace =
        (in.changes.select(3, 4) / speed).clamp(-most_pace, most_pace) * known.squeeze(3);
    const torch::Tensor body =
        torch::cat({call.drop((h * known).transpose(1, 2).reshape({b, n, c * encoded})),
                    pose.transpose(1, 2), pace.transpose(1, 2)},
                   2);
    torch::Tensor g = torch::relu(call.dense(body, "body") + call.dense(pooled, "pool"));
    if (!shape.has_trunk) g = torch::zeros_like(g);
    for (std::size_t i = 0; i < shape.dilations.size(); ++i) {
      const std::string block = fmt::format("block{}", i);
      const torch::Tensor inner = torch::relu(
          call.convolution(g, block + ".convolution", shape.dilations[i], in.looks_ahead));
      g = g + call.dense(call.drop(inner), block + ".dense");
    }
    g = torch::relu(g);
    const torch::Tensor slots =
        call.dense(g, "to_slots").view({b, n, c, whole(shape.slot_units)}).transpose(1, 2) * known;
    const torch::Tensor hidden =
        torch::relu(call.dense(torch::cat({h, of_track, slots}, 3), "head") +
                    call.dense(g, "to_all").unsqueeze(1));
    const torch::Tensor out = call.dense(hidden, "output");
    const torch::Tensor corrections = call.dense(g, "slot_corrections")
                                          .view({b, n, c, whole(motion_body_corrections)})
                                          .transpose(1, 2) *
                                      known;
    const std::int64_t at = whole(motion_smoothers + first_body_correction);
    return torch::cat(
        {out.narrow(3, 0, at), out.narrow(3, at, whole(motion_body_corrections)) + corrections,
         out.narrow(3, whole(motion_outputs) - 1, 1)},
        3);
  }

  // Values and changes that the outputs give for a batch.
  std::pair<torch::Tensor, torch::Tensor> results(const torch::Tensor& outputs,
                                                  const Inputs& in) const {
    const std::int64_t levels = whole(bank_levels), inner = levels - 2;
    const torch::Tensor mix = outputs.narrow(3, 0, whole(motion_smoothers)).softmax(3);
    const auto all = [&](const torch::Tensor& x) {
      return torch::cat({x.narrow(3, 0, levels), 2 * x.narrow(3, 1, inner) - x.narrow(3, 2, inner),
                         x.narrow(3, levels, 1)},
                        3);
    };
    const torch::Tensor smooth = all(in.levels);
    const torch::Tensor correction =
        (outputs.narrow(3, whole(motion_smoothers), whole(motion_scales)) * in.scales).sum(3) * 0.5;
    const torch::Tensor values = (mix * smooth).sum(3) + correction;
    const torch::Tensor changes = (mix * all(in.changes)).sum(3) +
                                  (slope_of(mix) * (smooth - in.levels.narrow(3, 0, 1))).sum(3) +
                                  slope_of(correction.unsqueeze(3)).squeeze(3);
    return {values, changes};
  }

  // Root mean squares over the known channels of each step: B x steps.
  static torch::Tensor size_of(const torch::Tensor& x, const Inputs& in) {
    const torch::Tensor square =
        (x * x * in.alive.unsqueeze(2)).sum(1) / in.alive.sum(1, true).clamp_min(1);
    return torch::sqrt(square + 1e-4);
  }
};

MotionDescent::MotionDescent(const MotionShape& shape, const std::vector<float>& mean,
                             const std::vector<float>& deviation, const std::vector<float>& speed,
                             const DescentSettings& settings, std::uint64_t seed)
    : body_(std::make_unique<Body>()) {
  Body& body = *body_;
  body.shape = shape;
  body.descent.settings = settings;
  const std::int64_t d = whole(shape.slots);
  body.mean = tensor_of(mean, {1, d, 1}).clone();
  body.deviation = tensor_of(deviation, {1, d, 1}).clone();
  body.speed = tensor_of(speed, {1, d, 1}).clone();
  WeightMaker maker(body.descent.weights, seed);
  const std::size_t encoded = shape.encoded, hidden = shape.hidden;
  maker.add_convolution("encoder", motion_features, encoded);
  maker.add_convolution("second_encoder", encoded, encoded);
  maker.add_dense("of_take", motion_take_features, encoded);
  maker.add_dense("body", shape.slots * (encoded + 2), hidden);
  maker.add_dense("pool", 2 * encoded, hidden);
  for (std::size_t i = 0; i < shape.dilations.size(); ++i) {
    const std::string block = fmt::format("block{}", i);
    maker.add_convolution(block + ".convolution", hidden, hidden);
    maker.add_dense(block + ".dense", hidden, hidden, 0.3);
  }
  maker.add_dense("to_slots", hidden, shape.slots * shape.slot_units);
  maker.add_dense("slot_corrections", hidden, shape.slots * motion_body_corrections, 0.1);
  maker.add_dense("to_all", hidden, shape.head);
  maker.add_dense("head", 2 * encoded + shape.slot_units, shape.head);
  maker.add_dense("output", shape.head, motion_outputs, 0.1);
  // Initially, most of the measurement is kept.
  std::vector<double> outset(motion_outputs, 0);
  outset.front() = 2;
  maker.set("output.bias", outset);
  body.descent.start();
}
MotionDescent::~MotionDescent() = default;

double MotionDescent::step(const MotionBatch& batch, const MotionLoss& loss, double rate,
                           std::uint64_t seed) {
  Body& body = *body_;
  const Inputs all = inputs_of(batch);
  const double counted = all.alive.sum().item<double>() * static_cast<double>(batch.steps);
  // A separate thread differentiates each part's graph. The number of parts and the order of
  // addition do not depend on the number of cores.
  const std::size_t parts = (batch.samples + samples_of_part - 1) / samples_of_part;
  std::vector<std::vector<torch::Tensor>> gradients(parts);
  std::vector<double> shares(parts);
  for_each_parallel(parts, batch.features.size(), [&](std::size_t part) {
    const Inputs in = all.samples(part * samples_of_part, samples_of_part);
    at::Generator drawn_by = at::detail::createCPUGenerator(seed * parts + part);
    const torch::Tensor outputs =
        body.outputs({body.descent.weights, body.descent.settings.dropout, drawn_by}, in);
    const auto [values, changes] = body.results(outputs, in);
    const auto size = [&](const torch::Tensor& x) { return Body::size_of(x, in).mean(1); };
    const torch::Tensor damage = size(in.levels.select(3, 0) - in.truth);
    const torch::Tensor change_damage = size(in.changes.select(3, 0) - in.truth_changes);
    const torch::Tensor error = values - in.truth, change_error = changes - in.truth_changes;
    const torch::Tensor bend_damage =
        size(step_changes(in.changes.select(3, 0) - in.truth_changes));
    const torch::Tensor share =
        (size(error) / (damage + loss.floor_deg) +
         loss.velocity * size(change_error) / (change_damage + loss.floor_change_deg) +
         loss.acceleration * size(step_changes(change_error)) / (bend_damage + loss.floor_bend_deg))
            .sum() /
        whole(batch.samples);
    const torch::Tensor log_variance = outputs.select(3, whole(motion_outputs) - 1).clamp(-12, 8);
    const torch::Tensor likelihood =
        (0.5 * (log_variance + (error.detach().pow(2) + 1e-5) * torch::exp(-log_variance)))
            .clamp_max(20) *
        in.alive.unsqueeze(2);
    gradients[part] =
        body.descent.gradient_of(share + loss.likelihood * likelihood.sum() / counted);
    shares[part] = share.item<double>();
  });
  for (std::size_t part = 1; part < parts; ++part) {
    for (std::size_t i = 0; i < gradients[part].size(); ++i) {
      if (gradients[part][i].defined()) gradients.front()[i] += gradients[part][i];
    }
  }
  body.descent.set_gradient(std::move(gradients.front()));
  body.descent.step(rate);
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

std::vector<float> MotionDescent::outputs(const MotionBatch& batch) const {
  const torch::NoGradGuard guard;
  return floats_of(body_->outputs({body_->descent.means, 0}, inputs_of(batch)));
}

double MotionDescent::share_left(const MotionBatch& batch, const MotionLoss& loss) const {
  const torch::NoGradGuard guard;
  const Inputs in = inputs_of(batch);
  const auto [values, changes] = body_->results(body_->outputs({body_->descent.means, 0}, in), in);
  const auto size = [&](const torch::Tensor& x) { return Body::size_of(x, in).mean(1); };
  return (size(values - in.truth) / (size(in.levels.select(3, 0) - in.truth) + loss.floor_deg))
      .mean()
      .item<double>();
}

Weights MotionDescent::averages() const { return body_->descent.averages(); }
void MotionDescent::begin_with(const Weights& tensors) {
  Weights fitting = tensors;
  for (const auto& [name, own] : body_->descent.weights) {
    const auto found = fitting.find(name);
    if (found == fitting.end() && name.starts_with("block")) {
      Tensor fresh = tensor_of(own);
      if (name.find(".dense.") != std::string::npos)
        std::fill(fresh.values.begin(), fresh.values.end(), 0.0);
      fitting.emplace(name, std::move(fresh));
      continue;
    }
    if (found == fitting.end() || own.dim() != 2 || found->second.shape.size() != 2) continue;
    const auto inputs = static_cast<std::size_t>(own.size(1)), had = found->second.shape[1];
    if (had >= inputs) continue;
    Tensor widened{found->second.stored, {found->second.shape[0], inputs}, {}};
    for (std::size_t row = 0; row < widened.shape[0]; ++row) {
      const auto from = found->second.values.begin() + static_cast<std::ptrdiff_t>(row * had);
      widened.values.insert(widened.values.end(), from, from + static_cast<std::ptrdiff_t>(had));
      widened.values.insert(widened.values.end(), inputs - had, 0.0);
    }
    found->second = std::move(widened);
  }
  body_->descent.begin_with(fitting);
}
TensorFile MotionDescent::state() const { return body_->descent.state(); }
void MotionDescent::set_state(const TensorFile& state) { body_->descent.set_state(state); }

}  // namespace kinemend::train
