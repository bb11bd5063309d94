// The methods in the comparison of Xiao et al. 2015, each with its candidate settings.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "xiao.hpp"
#include "xiao_paper.hpp"

namespace kinemend::papers {

/// M of `sparse`, at 60 Hz.
inline constexpr std::array<std::int64_t, 2> xiao_sparse_windows{9, 15};

/// Trained models: `sparse` and `example` with windows of several lengths.
struct XiaoModels {
  std::vector<std::shared_ptr<const Model>> sparse;
  std::vector<std::shared_ptr<const Model>> example;
  std::shared_ptr<XiaoPapers> papers;
  std::size_t paper_hop = 1;  ///< frames from window to window of Algorithm 1; 1: all windows
};

/// Only "paper true frames" uses the ground truth, and only its frames.
using XiaoFilter = std::function<Take(const Take& noisy, const Take& truth)>;

struct XiaoSetting {
  std::string name;
  std::function<XiaoFilter(const XiaoModels&)> make;
};

struct XiaoMethod {
  std::string name;
  /// The setting with the least mean error on clips with that noise.
  std::function<XiaoSetting(const XiaoModels&, const std::vector<Take>&, const XiaoNoise&)> tuned;
  bool is_slow = false;  ///< runs on the paper's own sequences only
};

/// Lengths of the windows of `example`.
inline std::vector<double> xiao_windows_s(const Arguments& arguments) {
  return arguments.quick ? std::vector<double>{0.5} : std::vector<double>{1.0 / 3, 2.0 / 3, 1};
}

/// The paper's five methods including our `sparse`, then `auto`, and Algorithm 1 itself in the
/// coordinates of three poses.
std::vector<XiaoMethod> xiao_methods(const Arguments& arguments);

/// The sizes of Algorithm 1 where nothing else is chosen, and from which a choice begins.
XiaoPaperSizes xiao_paper_sizes(const Arguments& arguments);

/// `is_tuning`: models to choose settings with, whose dictionaries of Algorithm 1 have fewer
/// iterations.
XiaoModels xiao_models(const Arguments& arguments, const std::vector<Take>& clips, bool is_tuning);

/// The training clips in two parts: a second of two clips for choosing settings, and the others.
struct XiaoFold {
  std::vector<Take> training, tuning;
};
XiaoFold xiao_fold(const XiaoGroup& group);

}  // namespace kinemend::papers
