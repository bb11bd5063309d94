// Gives known names to the joints or markers of a take whose own names mean nothing to the program.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace kinemend {

/// Names that are known ("LeftFoot", "LTOE") to names in a take ("bone_17", "M3"); an empty one:
/// the take has no such part. What `parse_name_map` reads.
using KnownNames = std::map<std::string, std::string, std::less<>>;

/// The names of a take, those of the map by what they are known as. A subject stays: "Ann:M3" of
/// "LTOE" is "Ann:LTOE". What bears a name of the map and is another part loses it. Errors:
/// `ErrorKind::usage` for a name that the take does not have, or that several of it have.
std::vector<std::string> known_names(const std::vector<std::string>& names, const KnownNames& map);

}  // namespace kinemend
