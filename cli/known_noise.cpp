// Finds the noise of the first take in a report of `clean` or `check`.
#include "known_noise.hpp"

#include <fmt/format.h>

#include "json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"

namespace kinemend::cli {

namespace {

[[noreturn]] void fail(const std::string& path, std::string_view reason) {
  throw Error(ErrorKind::usage, fmt::format("--noise {}: {}", path, reason));
}

// The noise entry for the take's own kind of tracks.
const Json& noise_of_tracks(const Json& take, const std::string& path) {
  const char* quantity = take.at("kind") == "markers" ? "position" : "rotation";
  for (const Json& noise : take.at("noise")) {
    if (noise.at("quantity") == quantity) return noise;
  }
  fail(path, "the report found no noise in its take");
}

KnownNoise noise_of_report(const Json& report, const std::string& path) {
  if (!report.is_object() || report.value("schema", "") != report_schema)
    fail(path, "expected white, auto, or a JSON report of clean or check");
  const Json& takes = report.at("takes");
  if (takes.empty() || !takes.front().contains("noise"))
    fail(path, "the report has no noise in it; use a report of clean or check");
  const Json& take = takes.front();
  KnownNoise known;
  known.correlation = noise_of_tracks(take, path).at("correlation").get<double>();
  for (const Json& track : take.at("tracks")) {
    const double strength = track.value("noise", 0.0);
    if (strength > 0) known.strengths[track.at("name").get<std::string>()] = strength;
  }
  return known;
}

}  // namespace

std::optional<KnownNoise> known_noise(const std::string& choice) {
  if (choice == "auto") return std::nullopt;
  if (choice == "white") return KnownNoise{};
  const std::string text = read_file(choice);
  try {
    return noise_of_report(parse_json<Json>(text), choice);
  } catch (const Json::exception&) {
    fail(choice, "expected white, auto, or a JSON report of clean or check");
  }
}

}  // namespace kinemend::cli
