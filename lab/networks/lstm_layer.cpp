// Runs the gates frame by frame and computes their derivatives in one backward loop.
#include "lstm_layer.hpp"

#include <algorithm>

#include "nn/kernels.hpp"

namespace kinemend::train {

namespace {

using torch::autograd::AutogradContext;
using torch::autograd::tensor_list;

// State of B sequences in one frame: gates B x 4 H after activation; the others B x H.
struct Moment {
  std::int64_t rows, units;
  float *gates, *cell, *squashed, *hidden;
};

void run_gates(const Moment& m, const float* cell_before) {
  const auto units = static_cast<std::size_t>(m.units);
  for (std::int64_t r = 0; r < m.rows; ++r) {
    float* gates = m.gates + r * 4 * m.units;
    nn::sigmoid_of(gates, 2 * units);
    nn::tanh_of(gates + 2 * units, units);
    nn::sigmoid_of(gates + 3 * units, units);
    const float *in = gates, *forget = gates + units, *fresh = gates + 2 * units,
                *out = gates + 3 * units;
    float *cell = m.cell + r * m.units, *squashed = m.squashed + r * m.units,
          *hidden = m.hidden + r * m.units;
    for (std::size_t u = 0; u < units; ++u) {
      const float before =
          cell_before == nullptr ? 0 : cell_before[static_cast<std::size_t>(r * m.units) + u];
      squashed[u] = cell[u] = forget[u] * before + in[u] * fresh[u];
    }
    nn::tanh_of(squashed, units);
    for (std::size_t u = 0; u < units; ++u) hidden[u] = out[u] * squashed[u];
  }
}

// Converts d loss / d hidden and d loss / d cell (which becomes that of the previous frame) to the
// gradient of the gates' inputs.
void gates_adjoint(const Moment& m, const float* cell_before, const float* d_hidden, float* d_cell,
                   float* d_gates) {
  const auto units = static_cast<std::size_t>(m.units);
  for (std::int64_t r = 0; r < m.rows; ++r) {
    const float* gates = m.gates + r * 4 * m.units;
    float* d = d_gates + r * 4 * m.units;
    const float *in = gates, *forget = gates + units, *fresh = gates + 2 * units,
                *out = gates + 3 * units;
    for (std::size_t u = 0; u < units; ++u) {
      const std::size_t at = static_cast<std::size_t>(r * m.units) + u;
      const float squashed = m.squashed[at];
      const float dc = d_cell[at] + d_hidden[at] * out[u] * (1 - squashed * squashed);
      const float before = cell_before == nullptr ? 0 : cell_before[at];
      d[u] = dc * fresh[u] * in[u] * (1 - in[u]);
      d[units + u] = dc * before * forget[u] * (1 - forget[u]);
      d[2 * units + u] = dc * in[u] * (1 - fresh[u] * fresh[u]);
      d[3 * units + u] = d_hidden[at] * squashed * out[u] * (1 - out[u]);
      d_cell[at] = dc * forget[u];
    }
  }
}

class LstmFunction : public torch::autograd::Function<LstmFunction> {
 public:
  static torch::Tensor forward(AutogradContext* context, const torch::Tensor& given,
                               const torch::Tensor& input_weight, const torch::Tensor& state_weight,
                               const torch::Tensor& bias, bool is_backward) {
    const torch::Tensor x = given.contiguous();
    const std::int64_t steps = x.size(0), rows = x.size(1), units = state_weight.size(1);
    torch::Tensor gates = torch::addmm(bias, x.view({steps * rows, -1}), input_weight.t());
    gates = gates.view({steps, rows, 4 * units});
    torch::Tensor cell = torch::empty({steps, rows, units}), squashed = torch::empty_like(cell),
                  hidden = torch::empty_like(cell);
    const torch::Tensor transposed = state_weight.t().contiguous();
    for (std::int64_t i = 0; i < steps; ++i) {
      const std::int64_t t = is_backward ? steps - 1 - i : i, before = is_backward ? t + 1 : t - 1;
      torch::Tensor own = gates[t];
      if (i > 0) own.addmm_(hidden[before], transposed);
      run_gates(moment(gates, cell, squashed, hidden, t),
                i > 0 ? cell.data_ptr<float>() + before * rows * units : nullptr);
    }
    context->save_for_backward({x, input_weight, state_weight, gates, cell, squashed, hidden});
    context->saved_data["is_backward"] = is_backward;
    return hidden;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& derivatives) {
    const auto saved = context->get_saved_variables();
    const torch::Tensor &x = saved[0], &input_weight = saved[1], &state_weight = saved[2],
                        &gates = saved[3], &cell = saved[4], &squashed = saved[5],
                        &hidden = saved[6];
    const bool is_backward = context->saved_data["is_backward"].toBool();
    const std::int64_t steps = x.size(0), rows = x.size(1), units = state_weight.size(1);
    const torch::Tensor derivative = derivatives[0].contiguous();
    torch::Tensor d_gates = torch::empty_like(gates), d_cell = torch::zeros({rows, units});
    for (std::int64_t i = steps - 1; i >= 0; --i) {
      const std::int64_t t = is_backward ? steps - 1 - i : i;
      const std::int64_t before = is_backward ? t + 1 : t - 1, after = is_backward ? t - 1 : t + 1;
      torch::Tensor d_hidden = derivative[t];
      if (i + 1 < steps) d_hidden = torch::addmm(d_hidden, d_gates[after], state_weight);
      gates_adjoint(moment(gates, cell, squashed, hidden, t),
                    i > 0 ? cell.data_ptr<float>() + before * rows * units : nullptr,
                    d_hidden.data_ptr<float>(), d_cell.data_ptr<float>(),
                    d_gates.data_ptr<float>() + t * rows * 4 * units);
    }
    const torch::Tensor flat = d_gates.view({steps * rows, 4 * units});
    // The first frame of each direction starts with a zero state.
    const torch::Tensor later =
        is_backward ? d_gates.narrow(0, 0, steps - 1) : d_gates.narrow(0, 1, steps - 1);
    const torch::Tensor earlier =
        is_backward ? hidden.narrow(0, 1, steps - 1) : hidden.narrow(0, 0, steps - 1);
    const torch::Tensor d_state =
        torch::mm(later.reshape({-1, 4 * units}).t(), earlier.reshape({-1, units}));
    return {torch::mm(flat, input_weight).view(x.sizes()),
            torch::mm(flat.t(), x.view({steps * rows, -1})), d_state, flat.sum(0), torch::Tensor()};
  }

 private:
  static Moment moment(const torch::Tensor& gates, const torch::Tensor& cell,
                       const torch::Tensor& squashed, const torch::Tensor& hidden, std::int64_t t) {
    const std::int64_t rows = cell.size(1), units = cell.size(2), at = t * rows * units;
    return {rows,
            units,
            gates.data_ptr<float>() + 4 * at,
            cell.data_ptr<float>() + at,
            squashed.data_ptr<float>() + at,
            hidden.data_ptr<float>() + at};
  }
};

}  // namespace

torch::Tensor lstm_layer(const torch::Tensor& x, const torch::Tensor& input_weight,
                         const torch::Tensor& state_weight, const torch::Tensor& bias,
                         bool is_backward) {
  return LstmFunction::apply(x, input_weight, state_weight, bias, is_backward);
}

}  // namespace kinemend::train
