// Mall et al. 2017 with networks trained as in the paper by tools/train_study: EBF beside its
// ablations over all hold-outs (figures 5 and 8) with paired differences, EBD as a denoiser, EBF
// not trained on one action (section 4.1), models of one noise strength and of all (figure 6,
// left), and biases (figure 7). --models names the folder of the networks.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <span>

#include "mall_errors.hpp"
#include "mall_networks.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

// The quick form uses the networks of lab/experiments/models instead.
std::vector<StudyNetwork> study_networks(const Arguments& arguments) {
  return arguments.quick ? quick_networks(arguments) : networks_in(arguments.models);
}

// Filters a take with each channel's mean predicted width in all frames.
Take by_held_widths(const PaperNetwork& paper, const Take& clip) {
  const FilterNetwork& network = paper.network;
  const BodyMatch match = match_body(paper.layout, clip);
  BodyChannels channels = encode_body(clip, paper.layout, match);
  const FilterTake take = filter_take_of(channels, paper.layout);
  std::vector<float> outputs =
      run(network, filter_features(take, network.statistics, network.inputs));
  for (std::size_t c = 0; c < take.channels; ++c) {
    double sum = 0;
    for (std::size_t f = 0; f < take.frames; ++f)
      sum += static_cast<double>(outputs[f * take.channels + c]);
    for (std::size_t f = 0; f < take.frames; ++f)
      outputs[f * take.channels + c] = static_cast<float>(sum / static_cast<double>(take.frames));
  }
  std::vector<float> result(take.values.size());
  apply_predicted_filter(network.head,
                         {take.frames, take.channels, take.values, network.statistics.deviation,
                          network.statistics.mean},
                         outputs, result);
  put_filtered(result, channels.poses);
  std::vector<std::uint8_t> chosen(paper.layout.track_count() + 1, 1);
  chosen.front() = chosen.back() = 0;
  Take filtered_clip = clip;
  decode_body(channels, paper.layout, match, filtered_clip, chosen);
  return filtered_clip;
}

// Root mean square of the biases that a network with biases subtracts, degrees.
double bias_of(const PaperNetwork& paper, const Take& clip) {
  const FilterNetwork& network = paper.network;
  const BodyMatch match = match_body(paper.layout, clip);
  const FilterTake take = filter_take_of(encode_body(clip, paper.layout, match), paper.layout);
  const std::vector<float> outputs =
      run(network, filter_features(take, network.statistics, network.inputs));
  double square = 0;
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      const float bias = network.statistics.deviation[c] * outputs[(2 * f + 1) * take.channels + c];
      square += static_cast<double>(bias * bias);
    }
  }
  return std::sqrt(square / static_cast<double>(take.frames * take.channels));
}

// Statistics of a network with Gaussian filters, on some noisy takes.
struct NetworkFacts {
  double over_time = 0;         // deviation of a channel's log widths
  double between_channels = 0;  // deviation of the channels' means
  double saturated = 0;         // share of the encoder's values beyond 0.95
  double code_dimensions = 0;   // number of dimensions that share the variance of the code
};

// The code of a network: the output of its encoder for a take, frames x size.
std::vector<float> code_of(FilterNetwork network, std::span<const float> features) {
  network.recurrent.clear();
  network.decoder.clear();
  return run(network, features);
}

// (Sum of variances)^2 over the sum of squared covariances: n if n directions vary equally.
double dimensions_of(const std::vector<float>& codes, std::size_t size) {
  const std::size_t rows = codes.size() / size;
  std::vector<double> means(size);
  for (std::size_t i = 0; i < codes.size(); ++i)
    means[i % size] += static_cast<double>(codes[i]) / static_cast<double>(rows);
  double trace = 0, squares = 0;
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < size; ++b) {
      double covariance = 0;
      for (std::size_t r = 0; r < rows; ++r)
        covariance += (static_cast<double>(codes[r * size + a]) - means[a]) *
                      (static_cast<double>(codes[r * size + b]) - means[b]);
      trace += a == b ? covariance : 0;
      squares += covariance * covariance;
    }
  }
  return squares > 0 ? trace * trace / squares : 0;
}

NetworkFacts facts_of(const PaperNetwork& paper, const std::vector<Take>& clips) {
  const FilterNetwork& network = paper.network;
  NetworkFacts facts;
  std::vector<float> codes;
  for (const Take& clip : clips) {
    const FilterTake take = filter_take_of(
        encode_body(clip, paper.layout, match_body(paper.layout, clip)), paper.layout);
    const std::vector<float> features = filter_features(take, network.statistics, network.inputs);
    const std::vector<float> outputs = run(network, features);
    const auto frames = static_cast<double>(take.frames);
    const auto channels = static_cast<double>(take.channels);
    double within = 0, sum = 0, square = 0;
    for (std::size_t c = 0; c < take.channels; ++c) {
      double mean = 0, own = 0;
      for (std::size_t f = 0; f < take.frames; ++f) {
        const auto width = static_cast<double>(outputs[f * take.channels + c]);
        mean += width / frames;
        own += width * width / frames;
      }
      within += std::max(0.0, own - mean * mean) / channels;
      sum += mean / channels;
      square += mean * mean / channels;
    }
    const auto share = 1 / static_cast<double>(clips.size());
    facts.over_time += share * std::sqrt(within);
    facts.between_channels += share * std::sqrt(std::max(0.0, square - sum * sum));
    if (network.encoder.empty()) continue;
    const std::vector<float> code = code_of(network, features);
    codes.insert(codes.end(), code.begin(), code.end());
    double saturated = 0;
    for (const float value : code) saturated += std::abs(value) > 0.95F ? 1 : 0;
    facts.saturated += share * saturated / static_cast<double>(code.size());
  }
  if (!codes.empty())
    facts.code_dimensions = dimensions_of(codes, network.encoder.back().outputs());
  return facts;
}

void network_facts(const Arguments& arguments, const std::vector<StudyNetwork>& networks) {
  Table table(arguments, "ablation_mall_networks.csv",
              "network,left_out,seed,over_time,between_channels,saturated_percent,code_dimensions");
  std::vector<Take> clips;
  for (const HeldOut& take : takes_of_hold_outs(arguments, "1"))
    clips.push_back(damaged(take_of(arguments, take), "gaussian-channels", {{"k", 0.5}}, 100));
  for (const StudyNetwork& own : networks) {
    if (own.left_out != "1" || own.paper.network.head != FilterHead::gaussian) continue;
    const NetworkFacts facts = facts_of(own.paper, clips);
    table.add({own.network, own.left_out, own.seed, figure(facts.over_time),
               figure(facts.between_channels), figure(100 * facts.saturated),
               figure(facts.code_dimensions)});
    fmt::print(
        "{:10} seed {}: log widths over time {:.3f}, between channels {:.3f}; code: {:.1f} "
        "% saturated, {:.1f} dimensions\n",
        own.network, own.seed, facts.over_time, facts.between_channels, 100 * facts.saturated,
        facts.code_dimensions);
  }
  table.close();
}

// Errors of one method by take: the mean over draws, degrees.
using ByTake = std::map<std::size_t, double>;
// Methods are called "bf" (seed 1), "bf 2" (seed 2), "gaussian 58 ms".
using StudyErrors = std::map<std::string, ByTake>;

struct Tried {
  StudyErrors plain, all;  // without and with the joints that turn over
};

std::string words_of(const StudyNetwork& own) {
  return own.seed == "1" ? own.network : own.network + " " + own.seed;
}

// Networks for noise of k = 0.5 with Gaussian filters or a pose; "bound" ones start with the
// paper's weights.
const std::set<std::string> compared_networks{"ebf",      "bf",      "nn",     "ebd",
                                              "ebfbound", "bfbound", "nnbound"};

Tried try_half_noise(const Arguments& arguments, const std::vector<HeldOut>& takes,
                     const std::vector<StudyNetwork>& networks) {
  const std::uint64_t draws = arguments.quick ? 1 : 5;
  Tried tried;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const HeldOut& take = takes[i];
    const TakeErrors errors(take_of(arguments, take));
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
      const Take clip = damaged(errors.truth(), "gaussian-channels", {{"k", 0.5}}, 100 * draw + i);
      const auto add = [&](const std::string& method, const Take& result) {
        const auto share = 1 / static_cast<double>(draws);
        tried.plain[method][i] += share * errors.mean(result, true);
        tried.all[method][i] += share * errors.mean(result, false);
      };
      add("noisy", clip);
      add("gaussian 58 ms", cleaned(clip, "gaussian", {{"width_s", 0.058}}));
      add("gaussian 125 ms", cleaned(clip, "gaussian", {{"width_s", 0.125}}));
      for (const StudyNetwork& own : networks) {
        const bool is_of_action = own.left_out == take.action;
        if (!is_of_action && own.left_out != std::to_string(take.holdout)) continue;
        if (compared_networks.count(own.network) == 0) continue;
        add(is_of_action ? words_of(own) + " without the action" : words_of(own),
            by_network(own.paper, clip));
        if (own.network == "ebf" && own.seed == "1" && !is_of_action)
          add("ebf, widths held", by_held_widths(own.paper, clip));
      }
    }
  }
  return tried;
}

double mean_over(const ByTake& errors, const std::function<bool(std::size_t)>& counts) {
  double sum = 0, count = 0;
  for (const auto& [take, error] : errors) {
    if (!counts(take)) continue;
    sum += error;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

struct StudyGroup {
  std::string words;
  std::function<bool(const HeldOut&)> holds;
};

std::vector<StudyGroup> study_groups() {
  std::vector<StudyGroup> groups{{"all trained", [](const HeldOut&) { return true; }}};
  for (const char* action : {"walk", "jog", "run", "jump", "kick"})
    groups.push_back({action, [action](const HeldOut& take) { return take.action == action; }});
  for (const int holdout : {1, 2, 3, 4, 5})
    groups.push_back({fmt::format("hold-out {}", holdout),
                      [holdout](const HeldOut& take) { return take.holdout == holdout; }});
  return groups;
}

// Writes rows of the methods that have errors for all takes of a group.
void write_means(Table& table, const std::string& joints, const StudyErrors& errors,
                 const std::vector<HeldOut>& takes) {
  for (const StudyGroup& group : study_groups()) {
    const auto counts = [&](std::size_t take) { return group.holds(takes[take]); };
    std::size_t wanted = 0;
    for (std::size_t i = 0; i < takes.size(); ++i) wanted += counts(i) ? 1 : 0;
    if (wanted == 0) continue;
    const double gaussian = mean_over(errors.at("gaussian 58 ms"), counts);
    for (const auto& [method, of_takes] : errors) {
      const auto found = static_cast<std::size_t>(
          std::count_if(of_takes.begin(), of_takes.end(),
                        [&](const auto& entry) { return counts(entry.first); }));
      if (found != wanted) continue;
      const double mean = mean_over(of_takes, counts);
      table.add({joints, group.words, quoted(method), fmt::format("{}", found), figure(mean),
                 figure(mean / gaussian)});
      fmt::print("{:6} {:14} {:24} {:.3f} deg, {:.3f} of the 58 ms Gaussian\n", joints, group.words,
                 method, mean, mean / gaussian);
    }
  }
}

// Writes the mean of differences with its standard error.
void write_pair(Table& table, const std::vector<std::string>& names, const std::string& over,
                const std::vector<double>& differences) {
  if (differences.size() < 2) return;
  const PairedDifference pair = paired_difference(differences);
  std::vector<std::string> cells = names;
  for (const std::string& cell : {over, fmt::format("{}", pair.count), figure(pair.mean),
                                  figure(pair.standard_error), fmt::format("{}", pair.positive)})
    cells.push_back(cell);
  table.add(cells);
  fmt::print(
      "{:6} {:28} less {:12} over {:9}: {:+.4f} +- {:.4f} deg, the latter better in {} of {}\n",
      names[0], names[1], names[2], over, pair.mean, pair.standard_error, pair.positive,
      pair.count);
}

struct StudyPair {
  std::string method, base;
};

// Writes the paired differences of two methods' errors on the same takes with the same noise.
void write_pairs(Table& table, const std::string& joints, const StudyErrors& errors,
                 const std::vector<HeldOut>& takes) {
  for (const StudyPair& pair : std::vector<StudyPair>{{"bf", "ebf"},
                                                      {"nn", "ebf"},
                                                      {"bfbound", "ebfbound"},
                                                      {"nnbound", "ebfbound"},
                                                      {"ebf", "ebfbound"},
                                                      {"bf", "ebfbound"},
                                                      {"nn", "ebfbound"},
                                                      {"ebd", "ebf"},
                                                      {"ebf, widths held", "ebf"},
                                                      {"ebfbound without the action", "ebfbound"},
                                                      {"gaussian 58 ms", "ebf"}}) {
    const auto own = errors.find(pair.method), base = errors.find(pair.base);
    if (own == errors.end() || base == errors.end()) continue;
    std::vector<double> by_take;
    std::map<int, std::vector<double>> by_holdout;
    for (const auto& [take, error] : own->second) {
      if (base->second.count(take) == 0) continue;
      by_take.push_back(error - base->second.at(take));
      by_holdout[takes[take].holdout].push_back(by_take.back());
    }
    std::vector<double> means;
    for (const auto& [holdout, differences] : by_holdout) {
      double sum = 0;
      for (const double difference : differences) sum += difference;
      means.push_back(sum / static_cast<double>(differences.size()));
    }
    const std::vector<std::string> names{joints, quoted(pair.method), quoted(pair.base)};
    write_pair(table, names, "takes", by_take);
    write_pair(table, names, "hold-outs", means);
    std::vector<double> by_seed;
    for (const char* seed : {"", " 2", " 3"}) {
      const auto first = errors.find(pair.method + seed), second = errors.find(pair.base + seed);
      if (first == errors.end() || second == errors.end()) continue;
      const auto is_first = [&](std::size_t take) { return takes[take].holdout == 1; };
      by_seed.push_back(mean_over(first->second, is_first) - mean_over(second->second, is_first));
    }
    write_pair(table, names, "seeds", by_seed);
  }
}

// Hold-outs for which all three networks exist.
std::string trained_hold_outs(const std::vector<StudyNetwork>& networks) {
  std::string found;
  for (const char* holdout : {"1", "2", "3", "4", "5"}) {
    const auto is_there = [&](const char* name) {
      return std::any_of(networks.begin(), networks.end(), [&](const StudyNetwork& own) {
        return own.network == name && own.left_out == holdout && own.seed == "1";
      });
    };
    if (is_there("ebf") && is_there("bf") && is_there("nn")) found += holdout;
  }
  return found;
}

void ablations(const Arguments& arguments, const std::vector<StudyNetwork>& networks) {
  const std::vector<HeldOut> takes = takes_of_hold_outs(arguments, trained_hold_outs(networks));
  if (takes.empty()) return;
  const Tried tried = try_half_noise(arguments, takes, networks);
  Table means(arguments, "ablation_mall.csv", "joints,group,method,takes,rms_deg,of_gaussian_58");
  Table pairs(arguments, "ablation_mall_pairs.csv",
              "joints,method,base,over,count,difference_deg,standard_error_deg,base_is_better_in");
  for (const bool plain : {true, false}) {
    const std::string joints = plain ? "plain" : "all";
    const StudyErrors& errors = plain ? tried.plain : tried.all;
    write_means(means, joints, errors, takes);
    write_pairs(pairs, joints, errors, takes);
  }
  means.close();
  pairs.close();
}

struct StudyNoise {
  std::string words;
  std::vector<std::pair<std::string, OptionValues>> damages;
};

// The noises on which tools/train_study trains.
std::vector<StudyNoise> study_noises() {
  const auto noise = [](double k) {
    return std::pair<std::string, OptionValues>{"gaussian-channels", {{"k", k}}};
  };
  const std::string x = "x";
  return {
      {"k = 0.1", {noise(0.1)}},
      {"k = 0.5", {noise(0.5)}},
      {"k = 0.9", {noise(0.9)}},
      {"uniform", {{"uniform", {}}}},
      {"k = 0.5, constant bias", {noise(0.5), {"bias", {{"bias_deg", 5.0}, {"axis", x}}}}},
      {"k = 0.5, sinusoidal bias",
       {noise(0.5), {"sinusoid", {{"amplitude_deg", 5.0}, {"frequency_hz", 0.5}, {"axis", x}}}}}};
}

// Measures networks for other noise and with other heads, on hold-out 1.
void other_noises(const Arguments& arguments, const std::vector<StudyNetwork>& networks) {
  Table table(arguments, "ablation_mall_noise.csv",
              "noise,method,takes,rms_deg,of_gaussian_58,bias_deg");
  const std::vector<HeldOut> takes = takes_of_hold_outs(arguments, "1");
  const std::uint64_t draws = arguments.quick ? 1 : 5;
  for (const StudyNoise& noise : study_noises()) {
    std::map<std::string, std::pair<double, double>> sums;  // error and bias
    double count = 0;
    for (std::size_t i = 0; i < takes.size(); ++i) {
      const TakeErrors errors(take_of(arguments, takes[i]));
      for (std::uint64_t draw = 0; draw < draws; ++draw, ++count) {
        Take clip = errors.truth();
        for (std::size_t n = 0; n < noise.damages.size(); ++n)
          clip = damaged(clip, noise.damages[n].first, noise.damages[n].second,
                         1000 * n + 100 * draw + i);
        const auto add = [&](const std::string& method, const Take& result) {
          sums[method].first += errors.mean(result, true);
        };
        add("noisy", clip);
        add("gaussian 58 ms", cleaned(clip, "gaussian", {{"width_s", 0.058}}));
        add("gaussian 25 ms", cleaned(clip, "gaussian", {{"width_s", 0.025}}));
        for (const StudyNetwork& own : networks) {
          if (own.left_out != "1" || own.seed != "1") continue;
          add(own.network, by_network(own.paper, clip));
          if (own.paper.network.head == FilterHead::biased)
            sums[own.network].second += bias_of(own.paper, clip);
        }
      }
    }
    const double gaussian = sums.at("gaussian 58 ms").first;
    for (const auto& [method, own] : sums) {
      table.add({quoted(noise.words), method, fmt::format("{}", takes.size()),
                 figure(own.first / count), figure(own.first / gaussian),
                 figure(own.second / count)});
      fmt::print("{:26} {:16} {:.3f} deg, {:.3f} of the 58 ms Gaussian, bias {:.3f} deg\n",
                 noise.words, method, own.first / count, own.first / gaussian, own.second / count);
    }
  }
  table.close();
}

void mall_study(const Arguments& arguments) {
  const std::vector<StudyNetwork> networks = study_networks(arguments);
  if (networks.empty()) return say_no_networks(arguments);
  ablations(arguments, networks);
  network_facts(arguments, networks);
  other_noises(arguments, networks);
}

const Registration mall_study_entry("mall_study", mall_study);

}  // namespace
}  // namespace kinemend::papers
