// Computes the cross entropy of a batch in parts, one thread each, and draws the next batch during
// each step.
#include "contact_training.hpp"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "descent.hpp"
#include "network_model.hpp"

namespace kinemend::train {

// One foot's steps are one row of the batch; rows shorter than the longest have weight 0 behind.
struct ContactBatch {
  std::size_t rows = 0, steps = 0;
  std::vector<float> features, truth, weight;
};

namespace {

ContactBatch batch_of_samples(const std::vector<ContactSample>& samples, std::size_t steps) {
  ContactBatch batch;
  batch.steps = steps;
  for (const ContactSample& sample : samples) {
    const std::size_t count = std::min(sample.steps.count, steps);
    for (std::size_t l = 0; l < sample.steps.feet; ++l, ++batch.rows) {
      const auto put = [&](const std::vector<float>& from, std::size_t width,
                           std::vector<float>& to) {
        const auto first =
            from.begin() + static_cast<std::ptrdiff_t>(l * sample.steps.count * width);
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count * width));
        to.insert(to.end(), (steps - count) * width, 0.0F);
      };
      put(sample.steps.features, feet::contact_features, batch.features);
      put(sample.truth, 2, batch.truth);
      put(sample.weight, 2, batch.weight);
    }
  }
  return batch;
}

std::int64_t signed_size(std::size_t value) { return static_cast<std::int64_t>(value); }

torch::Tensor rows_of_batch(const std::vector<float>& values, const ContactBatch& batch,
                            std::size_t width) {
  return torch::from_blob(const_cast<float*>(values.data()),
                          {signed_size(batch.rows), signed_size(batch.steps), signed_size(width)});
}

}  // namespace

struct ContactTrainer::Body {
  std::span<const ContactSource> sources;
  ContactTraining settings;
  Descent descent;
  std::future<ContactBatch> next;
  std::size_t next_number = 0, batch = 0;

  ContactBatch drawn(std::size_t number) const {
    std::vector<ContactSample> samples;
    const Random random = Random(settings.seed).fork(number);
    for (std::size_t i = 0; i < settings.batch; ++i)
      samples.push_back(
          random_contact_sample(sources, settings.steps, settings.lookahead, random.fork(i)));
    return batch_of_samples(samples, settings.steps);
  }

  // A causal convolution is a symmetrical one of the sequence delayed by the dilation.
  torch::Tensor convolution(const LayerCall& call, const torch::Tensor& x, const std::string& name,
                            std::size_t dilation) const {
    if (settings.lookahead == feet::Lookahead::whole) return call.convolution(x, name, dilation);
    const std::int64_t by = signed_size(dilation);
    const torch::Tensor pad = torch::zeros({x.size(0), by, x.size(2)});
    const torch::Tensor longer = torch::cat({pad, x}, 1);
    return call.convolution(longer, name, dilation).narrow(1, 0, x.size(1));
  }

  torch::Tensor outputs(const LayerCall& call, const torch::Tensor& features) const {
    torch::Tensor h = torch::relu(convolution(call, features, "encoder", 1));
    for (std::size_t i = 0; i < settings.dilations.size(); ++i) {
      const std::string block = fmt::format("block{}", i);
      const torch::Tensor inner =
          torch::relu(convolution(call, h, block + ".convolution", settings.dilations[i]));
      h = h + call.dense(call.drop(inner), block + ".dense");
    }
    return call.dense(torch::relu(h), "output");
  }

  static torch::Tensor entropy(const torch::Tensor& outputs, const torch::Tensor& truth,
                               const torch::Tensor& weight) {
    return ((torch::softplus(outputs) - outputs * truth) * weight).sum();
  }
};

ContactTrainer::ContactTrainer(std::span<const ContactSource> sources,
                               const ContactTraining& settings)
    : body_(std::make_unique<Body>()) {
  Body& body = *body_;
  body.sources = sources;
  body.settings = settings;
  body.descent.settings = settings.descent;
  WeightMaker maker(body.descent.weights, settings.seed);
  maker.add_convolution("encoder", feet::contact_features, settings.width);
  for (std::size_t i = 0; i < settings.dilations.size(); ++i) {
    const std::string block = fmt::format("block{}", i);
    maker.add_convolution(block + ".convolution", settings.width, settings.width);
    maker.add_dense(block + ".dense", settings.width, settings.width, 0.3);
  }
  maker.add_dense("output", settings.width, 2, 0.1);
  body.descent.start();
}
ContactTrainer::~ContactTrainer() = default;
ContactTrainer::ContactTrainer(ContactTrainer&&) noexcept = default;

std::size_t ContactTrainer::batch() const noexcept { return body_->batch; }

double ContactTrainer::step() {
  constexpr double warm_up = 100, least = 0.01;
  constexpr std::size_t rows_of_part = 12;
  Body& body = *body_;
  const ContactBatch batch = body.next.valid() && body.next_number == body.batch
                                 ? body.next.get()
                                 : body.drawn(body.batch);
  body.next_number = body.batch + 1;
  if (body.next_number < body.settings.batches)
    body.next = std::async(std::launch::async,
                           [&body, number = body.next_number] { return body.drawn(number); });
  const torch::Tensor features = rows_of_batch(batch.features, batch, feet::contact_features);
  const torch::Tensor truth = rows_of_batch(batch.truth, batch, 2),
                      weight = rows_of_batch(batch.weight, batch, 2);
  const double counted = std::max(1.0, weight.sum().item<double>());
  const std::size_t parts = (batch.rows + rows_of_part - 1) / rows_of_part;
  std::vector<std::vector<torch::Tensor>> gradients(parts);
  std::vector<double> losses(parts);
  for_each_parallel(parts, batch.features.size(), [&](std::size_t part) {
    const std::int64_t from = signed_size(part * rows_of_part);
    const std::int64_t n = std::min(signed_size(rows_of_part), signed_size(batch.rows) - from);
    at::Generator drawn_by = at::detail::createCPUGenerator(body.batch * parts + part);
    const torch::Tensor outputs =
        body.outputs({body.descent.weights, body.descent.settings.dropout, drawn_by},
                     features.narrow(0, from, n));
    const torch::Tensor loss =
        Body::entropy(outputs, truth.narrow(0, from, n), weight.narrow(0, from, n)) / counted;
    gradients[part] = body.descent.gradient_of(loss);
    losses[part] = loss.item<double>();
  });
  double loss = losses.front();
  for (std::size_t part = 1; part < parts; ++part) {
    loss += losses[part];
    for (std::size_t i = 0; i < gradients[part].size(); ++i)
      gradients.front()[i] += gradients[part][i];
  }
  body.descent.set_gradient(std::move(gradients.front()));
  body.descent.step(
      cosine_rate(body.batch, body.settings.batches, warm_up, body.settings.rate, least));
  ++body.batch;
  return loss;
}

ContactScore ContactTrainer::score(std::span<const ContactSource> sources, std::size_t samples,
                                   std::uint64_t seed) const {
  const torch::NoGradGuard guard;
  const Body& body = *body_;
  double loss = 0, counted = 0, both = 0, stands = 0, found = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const ContactBatch batch =
        batch_of_samples({random_contact_sample(sources, body.settings.steps,
                                                body.settings.lookahead, Random(seed).fork(i))},
                         body.settings.steps);
    const torch::Tensor truth = rows_of_batch(batch.truth, batch, 2),
                        weight = rows_of_batch(batch.weight, batch, 2);
    const torch::Tensor outputs = body.outputs(
        {body.descent.means, 0}, rows_of_batch(batch.features, batch, feet::contact_features));
    const torch::Tensor says = (outputs > 0).to(torch::kFloat32) * weight;
    loss += Body::entropy(outputs, truth, weight).item<double>();
    counted += weight.sum().item<double>();
    both += (says * truth).sum().item<double>();
    stands += (truth * weight).sum().item<double>();
    found += says.sum().item<double>();
  }
  return {loss / std::max(counted, 1.0), both / std::max(stands, 1.0), both / std::max(found, 1.0)};
}

void ContactTrainer::put(Model& model) const {
  const Body& body = *body_;
  const std::string part = body.settings.lookahead == feet::Lookahead::whole ? "whole." : "live.";
  Weights weights;
  for (auto& [name, tensor] : body.descent.averages()) weights[part + name] = tensor;
  // The layout only names what the network sees; it works on any body with feet.
  model.layout.names = {"Hips", "Heel", "Toe", "OtherHeel", "OtherToe"};
  model.layout.parents = {-1, 0, 0, 0, 0};
  model.layout.references.assign(model.layout.names.size(), Quat{});
  model.layout.bones.assign(model.layout.names.size(), Vec3{});
  put_weights(weights, model);
  put_dilations(body.settings.dilations, model);
}

TensorFile ContactTrainer::state() const { return body_->descent.state(); }

void ContactTrainer::resume(const TensorFile& state, std::size_t batch) {
  body_->descent.set_state(state);
  body_->batch = batch;
}

}  // namespace kinemend::train
