#pragma once

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "kinemend/io.hpp"

/// Makes small FBX files in every form, and walks over binary records. Neither shares code with the
/// library.
namespace kinemend::test {

struct FbxWord {
  char letter;
};

using FbxValue =
    std::variant<std::int32_t, std::int64_t, double, std::string, FbxWord,
                 std::vector<std::int64_t>, std::vector<float>, std::vector<std::int32_t>>;

struct FbxNode {
  std::string name;
  std::vector<FbxValue> values;
  std::vector<FbxNode> children;
};

struct FbxForm {
  const char* title;
  std::uint32_t version = 7400;
  bool is_text = false;
  bool is_big_endian = false;
  bool is_packed = false;
};

inline const std::vector<FbxForm> fbx_forms{
    {"7.4, raw", 7400},
    {"7.4, packed", 7400, false, false, true},
    {"7.5, packed, 64-bit", 7500, false, false, true},
    {"7.7, raw, big-endian", 7700, false, true, false},
    {"7.4, packed, big-endian", 7400, false, true, true},
    {"7.5, text", 7500, true},
};

class FbxTestWriter {
 public:
  explicit FbxTestWriter(FbxForm form) : form_(form) {}

  std::string binary(const std::vector<FbxNode>& nodes) {
    out_ = std::string("Kaydara FBX Binary  \0\x1A", 22);
    out_ += form_.is_big_endian ? '\1' : '\0';
    word<std::uint32_t>(form_.version);
    for (const FbxNode& node : nodes) write(node);
    out_.append(head(), '\0');
    out_.append("\xFA\xBC\xA9\x05\xD0\xC8\xD4\x66\xB1\x76\xFB\x83\x1C\xF7\x26\x7E", 16);
    out_.append(16 - out_.size() % 16, '\0');
    out_.append(4, '\0');
    word<std::uint32_t>(form_.version);
    out_.append(120, '\0');
    out_.append("\xF8\x5A\x8C\x6A\xDE\xF5\xD9\x7E\xEC\xE9\x0C\xE3\x75\x8F\x29\x0B", 16);
    return out_;
  }

  std::string text(const std::vector<FbxNode>& nodes) {
    std::ostringstream out;
    out << "; FBX " << form_.version / 1000 << "." << form_.version % 1000 / 100
        << ".0 project file\n; ---\n\n";
    out.precision(9);
    for (const FbxNode& node : nodes) write_text(node, 0, out);
    return out.str();
  }

  std::string file(const std::vector<FbxNode>& nodes) {
    return form_.is_text ? text(nodes) : binary(nodes);
  }

 private:
  std::size_t head() const { return form_.version >= 7500 ? 25 : 13; }

  template <class Word>
  std::string bytes_of(Word value) const {
    std::string bytes;
    for (std::size_t i = 0; i < sizeof(Word); ++i)
      bytes += static_cast<char>(value >> (8 * (form_.is_big_endian ? sizeof(Word) - 1 - i : i)));
    return bytes;
  }
  template <class Word>
  void word(Word value) {
    out_ += bytes_of(value);
  }
  void put_head(std::size_t at, std::size_t field, std::uint64_t value) {
    const std::string bytes =
        form_.version >= 7500 ? bytes_of(value) : bytes_of(static_cast<std::uint32_t>(value));
    out_.replace(at + field * bytes.size(), bytes.size(), bytes);
  }

  void write(const FbxNode& node) {
    const std::size_t at = out_.size();
    out_.append(head() - 1, '\0');
    out_ += static_cast<char>(node.name.size());
    out_ += node.name;
    const std::size_t begin = out_.size();
    for (const FbxValue& value : node.values) write(value);
    put_head(at, 1, node.values.size());
    put_head(at, 2, out_.size() - begin);
    for (const FbxNode& child : node.children) write(child);
    if (!node.children.empty()) out_.append(head(), '\0');
    put_head(at, 0, out_.size());
  }

  void write(const FbxValue& value) {
    if (const auto* i = std::get_if<std::int32_t>(&value)) {
      out_ += 'I';
      word(static_cast<std::uint32_t>(*i));
    } else if (const auto* l = std::get_if<std::int64_t>(&value)) {
      out_ += 'L';
      word(static_cast<std::uint64_t>(*l));
    } else if (const auto* d = std::get_if<double>(&value)) {
      out_ += 'D';
      word(std::bit_cast<std::uint64_t>(*d));
    } else if (const auto* w = std::get_if<FbxWord>(&value)) {
      out_ += 'C';
      out_ += w->letter;
    } else if (const auto* s = std::get_if<std::string>(&value)) {
      out_ += 'S';
      word(static_cast<std::uint32_t>(s->size()));
      out_ += *s;
    } else {
      write_array(value);
    }
  }

  void write_array(const FbxValue& value) {
    std::string raw;
    std::size_t count = 0;
    char type = 0;
    if (const auto* l = std::get_if<std::vector<std::int64_t>>(&value)) {
      type = 'l';
      for (const auto x : *l) raw += bytes_of(static_cast<std::uint64_t>(x));
      count = l->size();
    } else if (const auto* f = std::get_if<std::vector<float>>(&value)) {
      type = 'f';
      for (const auto x : *f) raw += bytes_of(std::bit_cast<std::uint32_t>(x));
      count = f->size();
    } else if (const auto* i = std::get_if<std::vector<std::int32_t>>(&value)) {
      type = 'i';
      for (const auto x : *i) raw += bytes_of(static_cast<std::uint32_t>(x));
      count = i->size();
    }
    if (form_.is_packed) {
      std::string packed(compressBound(raw.size()), '\0');
      uLongf size = packed.size();
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(raw.data()), raw.size(), 1);
      raw = packed.substr(0, size);
    }
    out_ += type;
    word(static_cast<std::uint32_t>(count));
    word(std::uint32_t{form_.is_packed ? 1u : 0u});
    word(static_cast<std::uint32_t>(raw.size()));
    out_ += raw;
  }

  template <class List>
  static void write_list(const List& list, std::ostringstream& out, const std::string& tabs) {
    out << " *" << list.size() << " {\n" << tabs << "\ta: ";
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0) out << ",";
      out << list[i];
    }
    out << "\n" << tabs << "} ";
  }

  void write_text(const FbxNode& node, std::size_t depth, std::ostringstream& out) {
    const std::string tabs(depth, '\t');
    out << tabs << node.name << ":";
    bool first = true;
    for (const FbxValue& value : node.values) {
      if (!first) out << ",";
      first = false;
      write_text(value, out, tabs, node.name == "KeyAttrDataFloat");
    }
    if (!node.children.empty()) {
      out << " {\n";
      for (const FbxNode& child : node.children) write_text(child, depth + 1, out);
      out << tabs << "}";
    }
    out << "\n";
  }

  void write_text(const FbxValue& value, std::ostringstream& out, const std::string& tabs,
                  bool as_bits) {
    if (const auto* i = std::get_if<std::int32_t>(&value)) out << " " << *i;
    if (const auto* l = std::get_if<std::int64_t>(&value)) out << " " << *l;
    if (const auto* d = std::get_if<double>(&value)) out << " " << *d;
    if (const auto* w = std::get_if<FbxWord>(&value)) out << " " << w->letter;
    if (const auto* s = std::get_if<std::string>(&value)) {
      const std::size_t end = s->find(std::string("\0\1", 2));
      out << " \"" << (end == s->npos ? *s : s->substr(end + 2) + "::" + s->substr(0, end)) << "\"";
    }
    if (const auto* l = std::get_if<std::vector<std::int64_t>>(&value)) write_list(*l, out, tabs);
    if (const auto* i = std::get_if<std::vector<std::int32_t>>(&value)) write_list(*i, out, tabs);
    if (const auto* f = std::get_if<std::vector<float>>(&value)) {
      std::vector<std::int32_t> bits;
      for (const float x : *f) bits.push_back(std::bit_cast<std::int32_t>(x));
      if (as_bits) {
        write_list(bits, out, tabs);
      } else {
        write_list(*f, out, tabs);
      }
    }
  }

  FbxForm form_;
  std::string out_;
};

/// A record of a binary file: its path in the tree, and the bytes of its properties.
struct WalkedRecord {
  std::string path;
  std::string properties;
};

/// Walks over a binary file; asserts nothing, so that an invalid file gives fewer records.
inline std::vector<WalkedRecord> walk_binary_fbx(const std::string& bytes) {
  std::vector<WalkedRecord> records;
  const bool big = bytes[22] == 1;
  const auto number = [&](std::size_t at, std::size_t width) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i]))
               << (8 * (big ? width - 1 - i : i));
    return static_cast<std::size_t>(value);
  };
  const std::size_t width = number(23, 4) >= 7500 ? 8 : 4, head = 3 * width + 1;
  struct Open {
    std::size_t end;
    std::string path;
  };
  std::vector<Open> open{{bytes.size(), ""}};
  std::size_t at = 27;
  while (at + head <= bytes.size()) {
    while (open.size() > 1 && at >= open.back().end) open.pop_back();
    const std::size_t end = number(at, width);
    if (end == 0) {
      at += head;
      if (open.size() == 1) break;
      if (at != open.back().end) return {};
      continue;
    }
    const auto name_size = static_cast<unsigned char>(bytes[at + head - 1]);
    const std::size_t list = at + head + name_size, size = number(at + 2 * width, width);
    const std::string path = open.back().path + "/" + bytes.substr(at + head, name_size);
    records.push_back({path, bytes.substr(list, size)});
    open.push_back({end, path});
    at = list + size;
  }
  return records;
}

constexpr std::int64_t fbx_test_second = 46186158000;

struct FbxTestCurve {
  std::vector<float> values;
  std::int64_t first = 0, step = fbx_test_second / 30;
  std::vector<std::int32_t> flags{24836};
  std::vector<float> data{0, 0, std::bit_cast<float>(218434821), 0};
  std::vector<std::int64_t> times{};  ///< instead of first and step
};

/// A model with curves of translation and rotation (x, y, z); an empty curve is left out.
struct FbxTestModel {
  std::string name;
  std::string kind = "LimbNode";
  std::int32_t parent = -1;
  std::vector<FbxNode> properties{};
  std::vector<FbxTestCurve> translation{}, rotation{}, scaling{};
};

inline FbxNode fbx_vector(const std::string& name, double x, double y, double z) {
  return {"P", {name, std::string("Vector3D"), std::string("Vector"), std::string(), x, y, z}, {}};
}
inline FbxNode fbx_number_property(const std::string& name, std::int32_t value) {
  return {"P", {name, std::string("enum"), std::string(), std::string(), value}, {}};
}

inline std::string fbx_object(const std::string& name, const std::string& type) {
  return name + std::string("\0\1", 2) + type;
}

/// A complete file of version 7 with these models, one take with one layer, and a mesh that does
/// not move.
class FbxTestScene {
 public:
  explicit FbxTestScene(const std::vector<FbxTestModel>& models, std::size_t layers = 1) {
    FbxNode objects{"Objects", {}, {}};
    objects.children.push_back(
        {"Geometry",
         {std::int64_t{7}, fbx_object("skin", "Geometry"), std::string("Mesh")},
         {{"Vertices", {std::vector<float>(30, 1.5f)}, {}}}});
    for (std::size_t m = 0; m < models.size(); ++m) {
      FbxNode model{"Model",
                    {id_of(m), fbx_object(models[m].name, "Model"), models[m].kind},
                    {{"Version", {std::int32_t{232}}, {}}, {"Properties70", {}, {}}}};
      model.children[1].children = models[m].properties;
      objects.children.push_back(model);
      link(id_of(m), models[m].parent < 0 ? 0 : id_of(static_cast<std::size_t>(models[m].parent)));
    }
    objects.children.push_back(
        {"AnimationStack", {std::int64_t{50}, fbx_object("walk", "AnimStack"), std::string()}, {}});
    for (std::size_t l = 0; l < layers; ++l) {
      const auto layer = static_cast<std::int64_t>(60 + l);
      objects.children.push_back(
          {"AnimationLayer", {layer, fbx_object("layer", "AnimLayer"), std::string()}, {}});
      link(layer, 50);
      for (std::size_t m = 0; m < models.size(); ++m) {
        add_curves(objects, models[m].translation, "Lcl Translation", id_of(m), layer);
        add_curves(objects, models[m].rotation, "Lcl Rotation", id_of(m), layer);
        add_curves(objects, models[m].scaling, "Lcl Scaling", id_of(m), layer);
      }
    }
    nodes.push_back({"FBXHeaderExtension", {}, {{"FBXHeaderVersion", {std::int32_t{1003}}, {}}}});
    nodes.push_back({"GlobalSettings",
                     {},
                     {{"Properties70",
                       {},
                       {fbx_number_property("TimeMode", 6), fbx_number_property("UpAxis", 1)}}}});
    nodes.push_back(objects);
    nodes.push_back(connections_);
    nodes.push_back({"Takes", {}, {{"Current", {std::string("walk")}, {}}}});
  }

  std::vector<FbxNode> nodes;

 private:
  static std::int64_t id_of(std::size_t model) { return static_cast<std::int64_t>(100 + model); }

  void link(std::int64_t from, std::int64_t to, const std::string& property = {}) {
    FbxNode node{"C", {std::string(property.empty() ? "OO" : "OP"), from, to}, {}};
    if (!property.empty()) node.values.push_back(property);
    connections_.children.push_back(node);
  }

  void add_curves(FbxNode& objects, const std::vector<FbxTestCurve>& curves,
                  const std::string& property, std::int64_t model, std::int64_t layer) {
    if (curves.empty()) return;
    const std::int64_t node = ++last_;
    objects.children.push_back(
        {"AnimationCurveNode", {node, fbx_object("N", "AnimCurveNode"), std::string()}, {}});
    link(node, layer);
    link(node, model, property);
    const std::string axes[3] = {"d|X", "d|Y", "d|Z"};
    for (std::size_t a = 0; a < curves.size(); ++a) {
      if (curves[a].values.empty()) continue;
      const std::int64_t id = ++last_;
      objects.children.push_back(record_of(curves[a], id));
      link(id, node, axes[a]);
    }
  }

  static FbxNode record_of(const FbxTestCurve& curve, std::int64_t id) {
    std::vector<std::int64_t> times = curve.times;
    for (std::size_t k = times.size(); k < curve.values.size(); ++k)
      times.push_back(curve.first + static_cast<std::int64_t>(k) * curve.step);
    std::vector<std::int32_t> uses(curve.flags.size(), 1);
    uses.back() = static_cast<std::int32_t>(curve.values.size() - (uses.size() - 1));
    return {"AnimationCurve",
            {id, fbx_object("", "AnimCurve"), std::string()},
            {{"KeyVer", {std::int32_t{4008}}, {}},
             {"KeyTime", {times}, {}},
             {"KeyValueFloat", {curve.values}, {}},
             {"KeyAttrFlags", {curve.flags}, {}},
             {"KeyAttrDataFloat", {curve.data}, {}},
             {"KeyAttrRefCount", {uses}, {}}}};
  }

  FbxNode connections_{"Connections", {}, {}};
  std::int64_t last_ = 1000;
};

/// Hips that move and rotate, a rotating spine with a rest rotation, a head that does not rotate,
/// and a mesh.
inline std::vector<FbxTestModel> fbx_walker() {
  std::vector<FbxTestModel> models(4);
  models[0].name = "Hips";
  models[0].translation = {{{0, 1, 2, 3, 4, 5}}, {{90, 91, 92, 91, 90, 89}}, {{0, 0, 0, 0, 0, 0}}};
  models[0].rotation = {{{0, 5, 10, 5, 0, -5}}, {{1, 2, 3, 4, 5, 6}}, {{-3, -2, -1, 0, 1, 2}}};
  models[1].name = "Spine";
  models[1].parent = 0;
  models[1].properties = {fbx_vector("Lcl Translation", 0, 20, 1),
                          fbx_vector("PreRotation", 10, -20, 30),
                          fbx_number_property("RotationActive", 1)};
  models[1].rotation = {{{10, 20, 30, 40, 50, 60}}, {{0, -5, 5, 0, 5, 0}}, {{7, 8, 9, 10, 11, 12}}};
  models[2].name = "Head";
  models[2].parent = 1;
  models[2].properties = {fbx_vector("Lcl Translation", 0, 30, 0)};
  models[3].name = "Body";
  models[3].kind = "Mesh";
  return models;
}

inline std::string fbx_bytes(const std::vector<FbxTestModel>& models, FbxForm form = fbx_forms[0],
                             std::size_t layers = 1) {
  return FbxTestWriter(form).file(FbxTestScene(models, layers).nodes);
}

inline TakeResult read_fbx_take(const std::string& bytes, ReadOptions options = {}) {
  return read_take(bytes, "take.fbx", options);
}
inline Take read_fbx_clip(const std::string& bytes) { return read_fbx_take(bytes).take; }

}  // namespace kinemend::test
