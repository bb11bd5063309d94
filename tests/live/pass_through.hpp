// A cleaner that changes nothing, for tests of what is around the cleaning.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "cleaner/live.hpp"

namespace kinemend::test {

/// Changes no sample that was seen, and runs without delay.
class PassThrough final : public Cleaner {
 public:
  std::string_view name() const override { return "pass-through"; }
  OptionValues options() const override { return {}; }
  CleanTrace clean(const TakeView&, const TrackSink&,
                   const std::function<void(double)>&) const override {
    return {};
  }
  LiveSupport live_support(double) const override { return {}; }
  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    return gap_holding_filter(like);
  }
};

}  // namespace kinemend::test
