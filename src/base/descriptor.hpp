// Owns an open file and closes it.
#pragma once

#include <utility>

#include "base/platform/files.hpp"

namespace kinemend {

/// Closes the file on destruction, but never a standard stream.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ > platform::standard_error) platform::close_file(number_);
  }
  int get() const { return number_; }
  // What is left unwritten on some file systems shows only here.
  bool close() { return platform::close_file(std::exchange(number_, -1)); }

 private:
  int number_;
};

}  // namespace kinemend
