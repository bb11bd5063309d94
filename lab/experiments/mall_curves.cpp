// Mall et al. 2017, figures 3 and 4: the error of each method over time on eight takes of the first
// hold-out, and the filter shapes of a network with free shapes.
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "mall_errors.hpp"
#include "mall_networks.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

constexpr double curve_step_s = 0.1;

// The results of the methods in figure 4 for a noise-free take; EBD if its network exists.
std::map<std::string, Take> cleaned_by_all(const Arguments& arguments, const Take& clip) {
  std::map<std::string, Take> results;
  results["gaussian 58 ms"] = cleaned(clip, "gaussian", {{"width_s", 0.058}});
  results["gaussian 125 ms"] = cleaned(clip, "gaussian", {{"width_s", 0.125}});
  results["example"] = cleaned(clip, "example");
  for (const char* name : {"ebf", "ebd"}) {
    if (const auto network = paper_network(arguments, name))
      results[name] = by_network(*network, clip);
  }
  return results;
}

// Two walks and all other takes; the paper shows eight takes.
std::vector<HeldOut> shown_takes(const Arguments& arguments) {
  std::vector<HeldOut> shown;
  std::size_t walks = 0;
  for (const HeldOut& take : takes_of_hold_outs(arguments, "1")) {
    if (take.action != "walk" || ++walks <= 2) shown.push_back(take);
  }
  return shown;
}

void errors_over_time(const Arguments& arguments) {
  Table curves(arguments, "mall_curves.csv", "take,action,method,time_s,rms_deg");
  Table frames(arguments, "mall_frames.csv", "take,action,method,rms_deg,least_in_percent");
  const std::vector<HeldOut> takes = shown_takes(arguments);
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const TakeErrors errors(take_of(arguments, takes[i]));
    const Take clip = damaged(errors.truth(), "gaussian-channels", {{"k", 0.5}}, 100 + i);
    std::map<std::string, std::vector<double>> of_methods;
    for (const auto& [method, result] : cleaned_by_all(arguments, clip))
      of_methods[method] = errors.per_frame(result, true);
    const std::size_t count = of_methods.begin()->second.size();
    std::map<std::string, double> least;
    for (std::size_t f = 0; f < count; ++f) {
      const auto best =
          std::min_element(of_methods.begin(), of_methods.end(),
                           [f](const auto& a, const auto& b) { return a.second[f] < b.second[f]; });
      least[best->first] += 100 / static_cast<double>(count);
    }
    const auto step = static_cast<std::size_t>(curve_step_s * clip.frame_rate_hz);
    for (const auto& [method, values] : of_methods) {
      double sum = 0;
      for (const double value : values) sum += value / static_cast<double>(count);
      frames.add({takes[i].name, takes[i].action, method, figure(sum), figure(least[method])});
      fmt::print("{:8} {:6} {:16} {:.3f} deg, least in {:.0f} % of the frames\n", takes[i].name,
                 takes[i].action, method, sum, least[method]);
      for (std::size_t first = 0; first + step <= count; first += step) {
        double part = 0;
        for (std::size_t f = first; f < first + step; ++f) part += values[f];
        curves.add({takes[i].name, takes[i].action, method,
                    figure(static_cast<double>(first) / clip.frame_rate_hz),
                    figure(part / static_cast<double>(step))});
      }
    }
  }
  curves.close();
  frames.close();
}

constexpr std::size_t kernel_size = 2 * predicted_filter_reach + 1;
using Kernel = std::span<const double>;

std::vector<double> gaussian_kernel(double width_frames) {
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t i = 0; i < kernel_size; ++i) {
    const double offset = static_cast<double>(i) - static_cast<double>(predicted_filter_reach);
    weights.push_back(std::exp(-offset * offset / (2 * width_frames * width_frames)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

struct NearestGaussian {
  double width_frames = 0;
  double distance = 1;  // half the sum of absolute differences: 0 is equal, 1 is disjoint
};

NearestGaussian nearest_gaussian(Kernel kernel) {
  NearestGaussian nearest;
  for (double width = 0.3; width < 20; width *= 1.03) {
    const std::vector<double> gaussian = gaussian_kernel(width);
    double distance = 0;
    for (std::size_t i = 0; i < kernel_size; ++i) distance += std::abs(kernel[i] - gaussian[i]) / 2;
    if (distance < nearest.distance) nearest = {width, distance};
  }
  return nearest;
}

// The weights of each frame (F x 31) from a network with the head shape.
std::vector<double> kernels_of(const PaperNetwork& paper, const Take& clip) {
  const FilterTake take =
      filter_take_of(encode_body(clip, paper.layout, match_body(paper.layout, clip)), paper.layout);
  const std::vector<float> outputs =
      run(paper.network, filter_features(take, paper.network.statistics, paper.network.inputs));
  std::vector<double> kernels(outputs.begin(), outputs.end());
  for (std::size_t first = 0; first < kernels.size(); first += kernel_size) {
    const auto begin = kernels.begin() + static_cast<std::ptrdiff_t>(first),
               end = begin + static_cast<std::ptrdiff_t>(kernel_size);
    const double highest = *std::max_element(begin, end);
    double sum = 0;
    std::for_each(begin, end, [&](double& value) { sum += value = std::exp(value - highest); });
    std::for_each(begin, end, [&](double& value) { value /= sum; });
  }
  return kernels;
}

void free_shapes(const Arguments& arguments) {
  const auto network = paper_network(arguments, "shapes");
  if (!network) {
    fmt::print("no shapes: {} has no shapes.kmodel\n", arguments.models.string());
    return;
  }
  Table shown(arguments, "mall_kernels.csv", "take,action,time_s,offset_ms,weight");
  Table shapes(arguments, "mall_shapes.csv",
               "action,frames,narrowest_ms,mean_ms,widest_ms,off_gaussian_percent,"
               "farthest_off_percent");
  std::map<std::string, bool> done;
  for (const HeldOut& take : takes_of_hold_outs(arguments, "1")) {
    if (std::exchange(done[take.action], true)) continue;
    const Take clip = damaged(take_of(arguments, take), "gaussian-channels", {{"k", 0.5}}, 100);
    const double frame_ms = 1000 / clip.frame_rate_hz;
    const std::vector<double> kernels = kernels_of(*network, clip);
    const auto step = static_cast<std::size_t>(curve_step_s * clip.frame_rate_hz);
    double narrowest = 1e9, widest = 0, width = 0, off = 0, farthest = 0;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Kernel kernel = Kernel(kernels).subspan(f * kernel_size, kernel_size);
      const NearestGaussian nearest = nearest_gaussian(kernel);
      narrowest = std::min(narrowest, frame_ms * nearest.width_frames);
      widest = std::max(widest, frame_ms * nearest.width_frames);
      width += frame_ms * nearest.width_frames / static_cast<double>(clip.frame_count());
      off += 100 * nearest.distance / static_cast<double>(clip.frame_count());
      farthest = std::max(farthest, 100 * nearest.distance);
      if (f % step != 0) continue;
      for (std::size_t i = 0; i < kernel_size; ++i)
        shown.add({take.name, take.action, figure(static_cast<double>(f) / clip.frame_rate_hz),
                   figure(frame_ms *
                          (static_cast<double>(i) - static_cast<double>(predicted_filter_reach))),
                   figure(kernel[i])});
    }
    shapes.add({take.action, fmt::format("{}", clip.frame_count()), figure(narrowest),
                figure(width), figure(widest), figure(off), figure(farthest)});
    fmt::print(
        "{:6} {:.1f} to {:.1f} ms, mean {:.1f}; {:.1f} % off the nearest Gaussian, {:.1f} % "
        "at most\n",
        take.action, narrowest, widest, width, off, farthest);
  }
  shown.close();
  shapes.close();
}

void mall_curves(const Arguments& arguments) {
  errors_over_time(arguments);
  free_shapes(arguments);
}

const Registration mall_curves_entry("mall_curves", mall_curves);

}  // namespace
}  // namespace kinemend::papers
