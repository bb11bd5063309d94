// Stores many takes in bounded memory while a model is trained.
#pragma once

#include <cstddef>
#include <vector>

#include "base/files.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Stores takes: their frames in a spool, all else in memory (some kilobytes per take).
class TakeStore {
 public:
  /// `most_memory`: most bytes of frames in memory.
  explicit TakeStore(std::size_t most_memory) : frames_(most_memory) {}

  /// The take's source document is dropped. Errors: as of `Spool`.
  void add(Take take);
  std::size_t count() const noexcept { return takes_.size(); }
  /// Bit-identical to the take added. Errors: as of `Spool`.
  Take take(std::size_t index) const;

 private:
  struct Entry {
    Take head;  // without frames
    std::size_t first_record = 0;
  };

  std::vector<Entry> takes_;
  Spool frames_;
};

}  // namespace kinemend
