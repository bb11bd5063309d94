// Effect of each part that `sparse` adds to the method of Xiao et al. 2015: its error without that
// part, on a second of the paper's own sequences, with the default loss and lambda.
#include <utility>

#include "kinemend/extend/method_options.hpp"
#include "papers/xiao2015_sparse/sparse.hpp"
#include "xiao.hpp"

namespace kinemend::papers {
namespace {

struct XiaoVariant {
  std::string name;
  SparseOptions options{};
  SparseTuning tuning{};
  bool is_local = false;  // uses a model in the paper's coordinates
};

const std::vector<XiaoNoise> ablation_noises{
    {"40 dB", 40, 0}, {"20 dB", 20, 0}, {"10 %", 0, 0.10}, {"mixed", 20, 0.10}};
const std::vector<XiaoNoise> quick_noises{{"20 dB", 20, 0}, {"10 %", 0, 0.10}};

std::vector<XiaoVariant> xiao_variants() {
  std::vector<XiaoVariant> variants{{"as it is"}};
  const auto add = [&](const std::string& name, const auto& change) {
    change(variants.emplace_back(XiaoVariant{name}));
  };
  add("no rest", [](XiaoVariant& v) { v.tuning.smooths_rest = false; });
  add("weights by marker", [](XiaoVariant& v) { v.tuning.levels_markers = false; });
  add("no fall-back", [](XiaoVariant& v) { v.tuning.leaves_biased = false; });
  add("no hold", [](XiaoVariant& v) { v.tuning.holds = false; });
  add("no cap", [](XiaoVariant& v) { v.tuning.caps_noise = false; });
  add("hold at outliers too", [](XiaoVariant& v) { v.tuning.marks_impulses = false; });
  add("no mean with auto", [](XiaoVariant& v) { v.tuning.averages = false; });
  add("one pass", [](XiaoVariant& v) { v.tuning.guides_again = false; });
  add("local coordinates", [](XiaoVariant& v) { v.is_local = true; });
  add("15 windows over a frame", [](XiaoVariant& v) { v.options.hops = 15; });
  add("none of them", [](XiaoVariant& v) {
    v.tuning = {.guides_again = false,
                .caps_noise = false,
                .smooths_rest = false,
                .leaves_biased = false,
                .holds = false,
                .averages = false};
    v.is_local = true;
    v.options.hops = 15;
  });
  return variants;
}

void xiao_ablation(const Arguments& arguments) {
  Table table(arguments, "xiao_ablation.csv", "motion,variant,noise,own_mean_cm");
  for (const XiaoGroup& group : xiao_groups(arguments)) {
    OptionValues local = xiao_training(arguments);
    local["local"] = true;
    const auto model = xiao_model("sparse", group.training, xiao_training(arguments));
    const auto local_model = xiao_model("sparse", group.training, local);
    for (const XiaoVariant& v : xiao_variants()) {
      const auto cleaner = make_tuned_sparse(v.options, v.is_local ? local_model : model, v.tuning);
      for (const XiaoNoise& noise : arguments.quick ? quick_noises : ablation_noises) {
        const Take truth = slice(group.tests.front(), 0, 120);
        const double error = xiao_error(*cleaner, truth, xiao_noise(truth, noise, 1)).mean;
        table.add({group.name, v.name, noise.name, fmt::format("{:.3f}", 100 * error)});
        fmt::print("{:<11}{:<19}{:<7}{:9.5f} m\n", group.name, v.name, noise.name, error);
        std::fflush(stdout);
      }
    }
  }
  table.close();
}

const Registration xiao_ablation_entry("xiao_ablation", xiao_ablation);

}  // namespace
}  // namespace kinemend::papers
