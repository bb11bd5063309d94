// Reads any bytes as a configuration file of `clean`: settings that are printed and read back as
// equal settings, or a one-line error that names the file.
#include "cli/config.hpp"
#include "laws.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  static const cli::Command& clean = *cli::find_command("clean");
  cli::Settings settings;
  try {
    settings = cli::parse_settings(clean, text_of(data, size), "fuzz");
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input, ErrorKind::usage}, "fuzz:");
    return 0;
  }
  const std::string text = cli::settings_text(clean, settings, "Settings.");
  const cli::Settings again = cli::parse_settings(clean, text, "again");
  check(cli::settings_text(clean, again, "Settings.") == text);
  return 0;
}
