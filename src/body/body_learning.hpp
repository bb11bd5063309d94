// The sums over many takes from which a layout is learned.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinemend/extend/body.hpp"

namespace kinemend::representation {

/// Learns a layout from takes of one kind.
class BodyLearning {
 public:
  virtual ~BodyLearning() = default;
  virtual void add(const Take& clip) = 0;
  virtual BodyLayout finish() const = 0;
};

/// `patterns`: names of the joints or markers that may be tracks; empty: all.
std::unique_ptr<BodyLearning> learn_joints(std::vector<std::string> patterns, double trend_s);
std::unique_ptr<BodyLearning> learn_markers(std::vector<std::string> patterns, double trend_s);

}  // namespace kinemend::representation
