// Shares what definitions of methods need: a cleaner that takes its options from a table, and the
// row of a method in the table of methods.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

/// A cleaner with the options of a table.
template <class Options>
class OptionedCleaner : public Cleaner {
 public:
  /// `name` and `table` outlive the cleaner. Errors: as of `OptionTable::validate`.
  OptionedCleaner(std::string_view name, const OptionTable<Options>& table, const Options& options)
      : options_(options), name_(name), table_(&table) {
    table.validate(options);
  }

  std::string_view name() const final { return name_; }
  OptionValues options() const final { return table_->values(options_); }

 protected:
  Options options_;

 private:
  std::string_view name_;
  const OptionTable<Options>* table_;
};

/// The row of a method: `make` makes its cleaner from the options of `table`, a function that
/// returns an `OptionTable`.
template <auto table, auto make>
Method method_row(std::string name, std::string summary, std::string paper) {
  return {std::move(name), std::move(summary), std::move(paper), table().specs(),
          [](const OptionValues& values) { return make(table().parse(values)); }};
}

/// The same for a method with a learned model. `make` also takes a model, here none: the cleaner
/// reads the one that its options name, or that ships.
template <auto table, auto make>
Method learned_method_row(std::string name, std::string summary, std::string paper) {
  return {std::move(name),
          std::move(summary),
          std::move(paper),
          table().specs(),
          [](const OptionValues& values) { return make(table().parse(values), nullptr); },
          true};
}

}  // namespace kinemend
