// Learned models: the parameters of a method, fitted to human motion, in a file (`walk.kmodel`,
// safetensors).
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/tensor.hpp"

namespace kinemend {

/// The description of a model, for people.
struct ModelCard {
  std::string title;    ///< "Walks of subject 35"
  std::string data;     ///< the training data
  std::string licence;  ///< words on the data and the model
  std::string command;  ///< the command that made it
  std::string figures;  ///< measured quality, as text
};

/// Plain data: immutable in use and shared between threads.
struct Model {
  std::string method;     ///< "example", "wiener", "kalman-learned"
  int version = 1;        ///< version of the method's tensors
  double rate_hz = 30;    ///< frame rate of the training motion
  std::size_t takes = 0;  ///< number of takes it was trained on
  double seconds = 0;     ///< duration of the training motion
  ModelCard card;
  BodyLayout layout;
  std::map<std::string, double, std::less<>> numbers;  ///< settings and scalars of the method
  std::map<std::string, Tensor, std::less<>> tensors;  ///< arrays of the method

  /// Returns an entry. Errors: `ErrorKind::unreadable_input` naming the entry that is missing or
  /// has another shape.
  double number(std::string_view name) const;
  const Tensor& tensor(std::string_view name, const std::vector<std::size_t>& shape) const;
  const Tensor& tensor(std::string_view name, std::initializer_list<std::size_t> shape) const;
  /// Accepts any shape with this number of dimensions.
  const Tensor& tensor(std::string_view name, std::size_t dimensions) const;
};

/// Reads a model. Errors: `ErrorKind::unreadable_input` as for `parse_tensors`, for a file that is
/// not a model, and for a version that is newer than this program, with both numbers.
Model parse_model(std::string_view bytes, std::string_view name);
Model read_model(const std::filesystem::path& path);
/// Returns the bytes of a model file. The same model gives the same bytes.
std::string write_model(const Model& model);
/// Returns XXH3 of the bytes of the file in hexadecimal, for the model's card.
std::string model_checksum(std::string_view bytes);

/// The models of one method, or of the step that finds standing feet.
struct ModelKind {
  std::string_view name;        ///< name of the method, or "contacts"
  int version = 1;              ///< version of the tensors and numbers: the newest that is read
  std::string_view trained_by;  ///< the program that fits them: "kinemend train"
  bool is_method = true;        ///< false: it serves a step of cleaning
};
/// Returns the kinds of models that are read: one for each method that works with a model, and that
/// of the contacts.
std::span<const ModelKind> model_kinds();

/// A model that is part of the program.
struct ShippedModel {
  std::string_view method;
  std::string_view bytes;  ///< content of the model file
};
std::vector<ShippedModel> shipped_models();
/// Returns the shipped model of a method, which is parsed once and kept. Errors: `ErrorKind::usage`
/// if no model ships for the method: `method kalman-learned needs a model: --model FILE, made by
/// kinemend train kalman-learned`.
std::shared_ptr<const Model> shipped_model(std::string_view method);

/// Returns the model for a method: `given`, else the model at `path` (the option `model`), or the
/// shipped model if `path` is empty. Errors: as above; `ErrorKind::usage` for a model of another
/// method.
std::shared_ptr<const Model> model_for(std::string_view method, const std::string& path,
                                       std::shared_ptr<const Model> given = nullptr);

}  // namespace kinemend
