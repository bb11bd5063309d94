// Reads any bytes as a file of names (`--map`): names that fit a take, or a one-line error.
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/take.hpp"
#include "laws.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  NameMap map;
  try {
    map = parse_name_map(text_of(data, size), "fuzz");
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::usage, ErrorKind::unreadable_input}, "fuzz:");
    return 0;
  }
  std::string text = "# a name may begin with what a file begins with: a byte order mark\n";
  for (const auto& [model, take] : map) text += model + "," + take + "\n";
  check(parse_name_map(text, "again") == map);
  try {
    const std::vector<std::string> names = {"Hips", "bone_1", "Ann:LTOE", "LTOE", ""};
    check(known_names(names, map).size() == names.size());
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::usage}, "");
  }
  return 0;
}
