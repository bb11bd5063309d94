// Reads any bytes as a request of the page of `view`: a request, or a one-line refusal. Deeply
// nested JSON is refused before it is traversed.
#include "cli/view_asked.hpp"
#include "laws.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  const std::string text = text_of(data, size);
  // Each `~` opens a thousand levels, so that short inputs can be nested deeply.
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
