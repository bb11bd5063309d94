// The part of `stream` without sockets: methods that run live, and the options of a session.
#pragma once

#include <memory>
#include <vector>

#include "command.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::cli {

/// Makes a cleaner that runs live. An option that the method needs for this is set, unless the user
/// has set it. Errors: `ErrorKind::usage` for a method that needs the whole take, with a list of
/// the others; those of a model.
std::unique_ptr<Cleaner> live_cleaner(const Method& method, OptionValues values);

/// The flags of a session: "method", "format", "strength" and so on.
std::vector<Flag> live_flags();
/// Options of the methods that may run live.
std::vector<OptionGroup> live_groups();
/// Converts the values of `live_flags`.
LiveOptions live_options(const Arguments& arguments, const Method& method);

}  // namespace kinemend::cli
