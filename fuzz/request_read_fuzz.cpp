// Any bytes as a request of the page of `view`: a request, or a refusal of one line. JSON that is
// nested deeply is refused before anything walks through it.
#include "cli/view_asked.hpp"
#include "laws.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  const std::string text = text_of(data, size);
  // Short inputs reach a depth that only long ones have: each `~` opens a thousand levels.
  std::string body;
  for (const char c : text) body += c == '~' ? std::string(1000, '[') : std::string(1, c);
  try {
    const cli::ViewAsked asked = cli::parse_view_asked(body);
    check(asked.tab.size() <= 64);
    for (const cli::AskedFlag& flag : asked.flags) check(flag.name.size() <= body.size());
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::usage}, "not a request of the page: ");
  }
  return 0;
}
