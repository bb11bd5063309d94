// The comparison of Xiao et al. 2015, Sparse motion bases selection for human motion denoising:
// figures 6 to 8 and table 1 (noise, outliers, both). Each method has the settings that are best on
// two training clips, with models trained without these two.
#include <map>
#include <set>

#include "kinemend/extend/figures.hpp"
#include "xiao_methods.hpp"

namespace kinemend::papers {
namespace {

constexpr double far_m = 0.08;    // figure 8 marks such markers
constexpr double bound_m = 0.05;  // "usually less" below 20 % of outliers
constexpr std::size_t key_poses = 5;

std::string centimetres(double metres) { return fmt::format("{:.3f}", 100 * metres); }

// Eq. 6 for one frame, metres; nullopt if no marker is noisy.
std::optional<double> frame_error(const Take& truth, const XiaoDamaged& damaged,
                                  const Take& filtered, std::size_t frame) {
  const std::size_t markers = truth.marker_count(), first = frame * markers;
  const std::span<const std::uint8_t> noisy(damaged.noisy.data() + first, markers);
  if (std::ranges::find(noisy, 1) == noisy.end()) return std::nullopt;
  return rmse_per_marker({truth.positions.data() + first, markers},
                         {filtered.positions.data() + first, markers}, markers, noisy)
      .mean;
}

std::size_t far_markers(const Take& truth, const Take& filtered, std::size_t frame) {
  std::size_t count = 0;
  for (std::size_t m = 0; m < truth.marker_count(); ++m)
    count += norm(filtered.position(frame, m) - truth.position(frame, m)) > far_m ? 1 : 0;
  return count;
}

// Errors of the paper's own sequence, and the mean over all tests.
struct Errors {
  MeanAndDeviation own, all;
  double own_under_bound = 0;  // share of frames
};

// Counts the columns of all actions in which a method has the least mean or deviation.
class LeastErrors {
 public:
  void add(const std::string& column, const std::string& method, MeanAndDeviation error) {
    columns_[column].push_back({method, error});
    if (std::ranges::find(methods_, method) == methods_.end()) methods_.push_back(method);
  }
  void write(const Arguments& arguments) const {
    Table table(arguments, "xiao_least.csv",
                "method,columns,mean_of_five,deviation_of_five,mean_of_all,deviation_of_all");
    for (const std::string& method : methods_) {
      const auto counted = [&](bool of_five, bool is_mean) {
        const bool is_own = of_five && !five_.contains(method);
        return is_own ? std::string() : std::to_string(wins(method, of_five, is_mean));
      };
      table.add({method, std::to_string(columns_.size()), counted(true, true), counted(true, false),
                 counted(false, true), counted(false, false)});
    }
    table.close();
  }

 private:
  struct Entry {
    std::string method;
    MeanAndDeviation error;
  };

  std::size_t wins(const std::string& method, bool of_five, bool is_mean) const {
    const auto value = [&](const Entry& entry) {
      return is_mean ? entry.error.mean : entry.error.deviation;
    };
    std::size_t count = 0;
    for (const auto& [column, entries] : columns_) {
      const Entry* best = nullptr;
      for (const Entry& entry : entries) {
        if (of_five && !five_.contains(entry.method)) continue;
        if (best == nullptr || value(entry) < value(*best)) best = &entry;
      }
      count += best != nullptr && best->method == method ? 1 : 0;
    }
    return count;
  }

  const std::set<std::string> five_{"gaussian", "wavelet", "kalman", "example", "sparse"};
  std::map<std::string, std::vector<Entry>> columns_;
  std::vector<std::string> methods_;
};

class Comparison {
 public:
  explicit Comparison(const Arguments& arguments)
      : arguments_(arguments),
        curves_(arguments, "xiao_curves.csv", "motion,noise,method,frame,rmse_cm"),
        far_(arguments, "xiao_far.csv",
             "motion,method,markers,far_per_pose,pose_1,pose_2,pose_3,pose_4,pose_5") {}

  void compare(const XiaoGroup& group) {
    Table table(arguments_, "xiao_" + group.name + ".csv",
                "noise,method,setting,own_mean_cm,own_deviation_cm,own_under_5_cm,mean_cm,"
                "deviation_cm");
    const XiaoFold fold = xiao_fold(group);
    const XiaoModels tuning = xiao_models(arguments_, fold.training, true);
    const XiaoModels models = xiao_models(arguments_, group.training, false);
    for (const XiaoNoise& noise : xiao_noises()) {
      const auto add = [&](const std::string& name, const std::string& setting,
                           const XiaoFilter& filter, bool is_slow) {
        const Errors errors = errors_of(group, noise, name, filter, is_slow ? 1 : 1000);
        std::vector<std::string> line{noise.name,
                                      name,
                                      setting,
                                      centimetres(errors.own.mean),
                                      centimetres(errors.own.deviation),
                                      fmt::format("{:.3f}", errors.own_under_bound)};
        for (const double metres : {errors.all.mean, errors.all.deviation})
          line.push_back(is_slow ? std::string() : centimetres(metres));
        table.add(line);
        fmt::print("{:<11}{:<7}{:<19}{:9.5f}{:9.5f}{:9.5f}{:9.5f}  {}\n", group.name, noise.name,
                   name, errors.own.mean, errors.own.deviation, errors.all.mean,
                   errors.all.deviation, setting);
        std::fflush(stdout);
        if (name != "(noisy)" && name != "paper true frames")
          least_.add(group.name + noise.name, name, errors.own);
      };
      add(
          "(noisy)", "", [](const Take& noisy, const Take&) { return noisy; }, false);
      for (const XiaoMethod& method : xiao_methods(arguments_)) {
        const XiaoSetting setting = method.tuned(tuning, fold.tuning, noise);
        add(method.name, setting.name, setting.make(models), method.is_slow);
      }
    }
    table.close();
  }

  void close() {
    curves_.close();
    far_.close();
    least_.write(arguments_);
  }

 private:
  Errors errors_of(const XiaoGroup& group, const XiaoNoise& noise, const std::string& name,
                   const XiaoFilter& filter, std::size_t most_clips) {
    Errors errors{};
    const std::size_t clips = std::min(most_clips, group.tests.size());
    for (std::size_t t = 0; t < clips; ++t) {
      const Take& truth = group.tests[t];
      const XiaoDamaged damaged = xiao_noise(truth, noise, t + 1);
      const Take filtered = filter(damaged.clip, truth);
      const MeanAndDeviation error = xiao_error(truth, damaged, filtered);
      errors.all.mean += error.mean / static_cast<double>(clips);
      errors.all.deviation += error.deviation / static_cast<double>(clips);
      if (t > 0) continue;
      errors.own = error;
      errors.own_under_bound = add_curve(group.name, noise.name, name, truth, damaged, filtered);
      if (noise.name == "mixed") add_far(group.name, name, truth, filtered);
    }
    return errors;
  }

  // Returns the share of frames below the paper's bound.
  double add_curve(const std::string& motion, const std::string& noise, const std::string& name,
                   const Take& truth, const XiaoDamaged& damaged, const Take& filtered) {
    double frames = 0, under = 0;
    for (std::size_t f = 0; f < truth.frame_count(); ++f) {
      const std::optional<double> error = frame_error(truth, damaged, filtered, f);
      if (!error) continue;
      frames += 1, under += *error < bound_m ? 1 : 0;
      curves_.add({motion, noise, name, std::to_string(f), centimetres(*error)});
    }
    return under / frames;
  }

  void add_far(const std::string& motion, const std::string& name, const Take& truth,
               const Take& filtered) {
    const std::size_t frames = truth.frame_count();
    double sum = 0;
    for (std::size_t f = 0; f < frames; ++f)
      sum += static_cast<double>(far_markers(truth, filtered, f));
    std::vector<std::string> line{motion, name, std::to_string(truth.marker_count()),
                                  fmt::format("{:.2f}", sum / static_cast<double>(frames))};
    for (std::size_t k = 0; k < key_poses; ++k)
      line.push_back(
          std::to_string(far_markers(truth, filtered, (2 * k + 1) * frames / (2 * key_poses))));
    far_.add(line);
  }

  const Arguments& arguments_;
  Table curves_, far_;
  LeastErrors least_;
};

void xiao_sparse(const Arguments& arguments) {
  Comparison comparison(arguments);
  for (const XiaoGroup& group : xiao_groups(arguments)) comparison.compare(group);
  comparison.close();
}

const Registration xiao_sparse_entry("xiao_sparse", xiao_sparse);

}  // namespace
}  // namespace kinemend::papers
