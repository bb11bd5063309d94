// Reads and writes models as safetensors files with a checksum. docs/models.md describes the
// layout.
#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

using Json = nlohmann::ordered_json;

// Version 2 added the checksum. By definition.
constexpr int format_version = 2;
constexpr int first_with_checksum = 2;
constexpr std::string_view format_key = "kinemend.model";
constexpr std::string_view checksum_key = "kinemend.checksum";
// Tensors of the body, not of the method.
constexpr std::string_view layout_prefix = "layout.";

// Position of the checksum's digits in a file. A text of the metadata that contains the same
// characters has escaped quotes.
std::size_t checksum_place(std::string_view bytes) {
  const std::string key = fmt::format("\"{}\":\"", checksum_key);
  const std::size_t found = bytes.find(key);
  return found == bytes.npos ? found : found + key.size();
}

// Checksum of the file with zeros in its place.
std::string checksum_of(std::string bytes, std::size_t place) {
  bytes.replace(place, content_hash_digits, content_hash_digits, '0');
  return content_hash(bytes);
}

// Reads a model's metadata and tensors; every error names the file.
class ModelReader {
 public:
  ModelReader(TensorFile file, std::string_view bytes, std::string_view name,
              const KnownModels& known)
      : file_(std::move(file)), bytes_(bytes), name_(name), known_(known) {}

  Model read() {
    check_format();
    check_checksum();
    Model model;
    model.method = text("method");
    model.version = whole<int>("version", 1);
    check_version(model.method, model.version);
    model.rate_hz = number("rate_hz", std::numeric_limits<double>::min());
    model.takes = whole<std::size_t>("takes", 0);
    model.seconds = number("seconds", 0);
    model.card = {text("title"), text("data"), text("licence"), text("command"), text("figures")};
    read_layout(model.layout);
    read_numbers(model.numbers);
    model.tensors = std::move(file_.tensors);
    for (const auto& [name, tensor] : model.tensors) {
      if (name.starts_with(layout_prefix))
        refuse(fmt::format("tensor {}: a body of {} has none of this name", quote(name),
                           to_string(model.layout.kind)));
    }
    return model;
  }

 private:
  [[noreturn]] void refuse(std::string_view message) const {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: {}", name_, message));
  }
  [[noreturn]] void refuse(std::string_view key, std::string_view expected,
                           std::string_view found) const {
    refuse(fmt::format("metadata \"{}\": expected {}, found {}", key, expected,
                       found.empty() ? "nothing" : quote(found)));
  }

  void check_format() const {
    if (!file_.metadata.contains(format_key))
      refuse(fmt::format("expected a model, found a file of tensors without the metadata \"{}\"",
                         format_key));
    const int version = whole<int>(format_key, 1);
    if (version > format_version) {
      refuse(fmt::format("the model is of format {}, and this program reads up to {}", version,
                         format_version));
    }
  }

  // Only a checksum detects a changed number.
  void check_checksum() const {
    const bool is_stated = file_.metadata.contains(checksum_key);
    if (!is_stated && whole<int>(format_key, 1) < first_with_checksum) return;
    const std::string& stated = text(checksum_key);
    const std::size_t place = checksum_place(bytes_);
    const bool has_place = place != bytes_.npos && place + content_hash_digits <= bytes_.size() &&
                           stated.size() == content_hash_digits;
    const std::string found = has_place ? checksum_of(std::string(bytes_), place) : "";
    if (found != stated) {
      refuse(fmt::format("the file is damaged: its checksum is {}, that of what it holds {}",
                         quote(stated), found.empty() ? "another" : found));
    }
  }

  void check_version(const std::string& method, int version) const {
    std::vector<std::string_view> known;
    for (const ModelKind& entry : known_.kinds) {
      known.push_back(entry.name);
      if (entry.name != method) continue;
      if (version <= entry.version) return;
      refuse(fmt::format("the model is version {} of {}, and this program reads up to {}", version,
                         method, entry.version));
    }
    if (known_.are_all) refuse("method", fmt::format("one of {}", fmt::join(known, ", ")), method);
  }

  const std::string& text(std::string_view key) const {
    const auto found = file_.metadata.find(key);
    if (found == file_.metadata.end()) refuse(fmt::format("metadata \"{}\" is missing", key));
    return found->second;
  }

  template <class Number>
  Number whole(std::string_view key, Number minimum) const {
    const std::string& digits = text(key);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < minimum)
      refuse(key, fmt::format("a whole number from {}", minimum), digits);
    return value;
  }

  double number(std::string_view key, double minimum) const {
    const std::string& digits = text(key);
    double value = 0;
    const char* end = digits.data() + digits.size();
    const auto result = fast_float::from_chars(digits.data(), end, value);
    const bool is_number = result.ec == std::errc() && result.ptr == end && std::isfinite(value);
    if (!is_number || value < minimum)
      refuse(key, minimum > 0 ? "a number above 0" : "a number from 0", digits);
    return value;
  }

  Json object(std::string_view key) const {
    const std::string& source = text(key);
    Json json = parse_json<Json>(source, false);
    if (!json.is_object()) refuse(key, "a JSON object", source);
    return json;
  }

  // The member of a JSON object, as the given type.
  template <class Value>
  Value member(const Json& json, const char* name) const {
    try {
      return json.at(name).get<Value>();
    } catch (const Json::exception&) {
      refuse("layout", fmt::format("a valid \"{}\"", name), json.dump());
    }
  }

  void read_layout(BodyLayout& layout) {
    const Json json = object("layout");
    const auto kind = member<std::string>(json, "kind");
    if (kind != "joints" && kind != "markers") refuse("layout", "joints or markers", kind);
    layout.kind = kind == "joints" ? BodyKind::joints : BodyKind::markers;
    layout.names = member<std::vector<std::string>>(json, "names");
    layout.trend_s = member<double>(json, "trend_s");
    if (layout.kind == BodyKind::joints) {
      layout.parents = member<std::vector<std::int32_t>>(json, "parents");
      layout.with_place = member<bool>(json, "with_place");
      layout.references = quaternions("references", layout.names.size());
      layout.bones = vectors("bones", layout.names.size());
      layout.place = vectors("place", 1).front();
    } else {
      layout.means = vectors("means", layout.names.size());
      layout.shape = vectors("shape", layout.names.size());
      const std::vector<double> anchors = layout_tensor("anchors", {layout.names.size()});
      for (const double anchor : anchors) layout.anchors.push_back(anchor != 0 ? 1 : 0);
    }
    try {
      layout.validate();
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

  // Removes the tensor, so that those of the method remain.
  std::vector<double> layout_tensor(std::string_view name, const std::vector<std::size_t>& shape) {
    const auto node = file_.tensors.extract(fmt::format("{}{}", layout_prefix, name));
    if (node.empty()) refuse(fmt::format("tensor \"{}{}\" is missing", layout_prefix, name));
    if (node.mapped().shape != shape) {
      refuse(fmt::format("tensor \"{}{}\": expected shape {}, found {}", layout_prefix, name, shape,
                         node.mapped().shape));
    }
    return node.mapped().values;
  }
  std::vector<Vec3> vectors(std::string_view name, std::size_t count) {
    const std::vector<double> values = layout_tensor(name, {count, 3});
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < values.size(); i += 3)
      result.push_back({values[i], values[i + 1], values[i + 2]});
    return result;
  }
  std::vector<Quat> quaternions(std::string_view name, std::size_t count) {
    const std::vector<double> values = layout_tensor(name, {count, 4});
    std::vector<Quat> result;
    for (std::size_t i = 0; i < values.size(); i += 4)
      result.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
    return result;
  }

  void read_numbers(std::map<std::string, double, std::less<>>& numbers) const {
    const Json json = object("numbers");
    for (const auto& [name, value] : json.items()) {
      if (!value.is_number()) refuse("numbers", "numbers", value.dump());
      numbers[name] = value.get<double>();
    }
  }

  TensorFile file_;
  std::string_view bytes_, name_;
  KnownModels known_;
};

Tensor tensor_of(std::vector<std::size_t> shape, TensorType type = TensorType::f64) {
  return {type, std::move(shape), {}};
}

Tensor tensor_of(const std::vector<Vec3>& vectors) {
  Tensor tensor = tensor_of({vectors.size(), 3});
  for (const Vec3& v : vectors) tensor.values.insert(tensor.values.end(), {v.x, v.y, v.z});
  return tensor;
}

Tensor tensor_of(const std::vector<Quat>& quaternions) {
  Tensor tensor = tensor_of({quaternions.size(), 4});
  for (const Quat& q : quaternions) tensor.values.insert(tensor.values.end(), {q.w, q.x, q.y, q.z});
  return tensor;
}

Tensor tensor_of(const std::vector<std::uint8_t>& flags) {
  Tensor tensor = tensor_of({flags.size()}, TensorType::u8);
  tensor.values.assign(flags.begin(), flags.end());
  return tensor;
}

void put_layout(const BodyLayout& layout, TensorFile& file) {
  const auto put = [&](std::string_view name, Tensor tensor) {
    file.tensors[fmt::format("{}{}", layout_prefix, name)] = std::move(tensor);
  };
  Json json = {
      {"kind", to_string(layout.kind)}, {"names", layout.names}, {"trend_s", layout.trend_s}};
  if (layout.kind == BodyKind::joints) {
    json["parents"] = layout.parents;
    json["with_place"] = layout.with_place;
    put("references", tensor_of(layout.references));
    put("bones", tensor_of(layout.bones));
    put("place", tensor_of(std::vector<Vec3>{layout.place}));
  } else {
    put("means", tensor_of(layout.means));
    put("shape", tensor_of(layout.shape));
    put("anchors", tensor_of(layout.anchors));
  }
  file.metadata["layout"] = json.dump();
}

[[noreturn]] void refuse_to_write(std::string_view message) {
  throw Error(ErrorKind::usage, fmt::format("the model cannot be written: {}", message));
}

void check_writable(const Model& model) {
  model.layout.validate();
  if (!(model.rate_hz > 0) || !std::isfinite(model.rate_hz) || !(model.seconds >= 0) ||
      !std::isfinite(model.seconds) || model.version < 1) {
    refuse_to_write("its rate, its seconds or its version is out of range");
  }
  for (const auto& [name, value] : model.numbers) {
    if (!std::isfinite(value)) refuse_to_write(fmt::format("number \"{}\" is {}", name, value));
  }
  for (const auto& [name, tensor] : model.tensors) {
    if (name.starts_with(layout_prefix))
      refuse_to_write(fmt::format("tensor \"{}\": such names stand for the body", name));
  }
}

}  // namespace

Model parse_model_of(std::string_view bytes, std::string_view name, const KnownModels& known) {
  return ModelReader(parse_tensors(bytes, name), bytes, name, known).read();
}

std::string write_model(const Model& model) {
  check_writable(model);
  TensorFile file;
  file.tensors = model.tensors;
  file.metadata = {{std::string(format_key), fmt::format("{}", format_version)},
                   {std::string(checksum_key), std::string(content_hash_digits, '0')},
                   {"method", model.method},
                   {"version", fmt::format("{}", model.version)},
                   {"rate_hz", fmt::format("{}", model.rate_hz)},
                   {"takes", fmt::format("{}", model.takes)},
                   {"seconds", fmt::format("{}", model.seconds)},
                   {"title", model.card.title},
                   {"data", model.card.data},
                   {"licence", model.card.licence},
                   {"command", model.card.command},
                   {"figures", model.card.figures},
                   {"numbers", Json(model.numbers).dump()}};
  try {
    put_layout(model.layout, file);
  } catch (const Json::exception&) {
    refuse_to_write("a name is not UTF-8");
  }
  std::string bytes = write_tensors(file);
  const std::size_t place = checksum_place(bytes);
  return bytes.replace(place, content_hash_digits, checksum_of(bytes, place));
}

std::string model_checksum(std::string_view bytes) { return content_hash(bytes); }

}  // namespace kinemend
