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
  // Returns false on failure: some file systems report failed writes only at closing.
  bool close() { return platform::close_file(std::exchange(number_, -1)); }

 private:
  int number_;
};

}  // namespace kinemend
