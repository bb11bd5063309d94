// The part of `stream` that needs no socket: methods that run live, and the options of a session.
#pragma once

#include <memory>
#include <vector>

#include "command.hpp"
#include "kinemend/experimental/live.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::cli {

/// A cleaner that runs live: an option without which the method does not is set, unless the user
/// has set it. Errors: `ErrorKind::usage` for a method that needs the whole take, with a list of
/// the others; those of a model.
std::unique_ptr<Cleaner> live_cleaner(const Method& method, OptionValues values);

/// The flags of a session: "method", "format", "strength" and so on.
std::vector<Flag> live_flags();
/// Options of the methods that may run live.
std::vector<OptionGroup> live_groups();
/// What `live_flags` say.
LiveOptions live_options(const Arguments& arguments, const Method& method);

}  // namespace kinemend::cli
