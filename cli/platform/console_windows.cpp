// Standard streams on Windows.
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <windows.h>
// This header needs windows.h before it.
#include <shellapi.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "platform/console.hpp"
#include "platform/windows_text.hpp"

namespace kinemend::cli::platform {

std::string utf8_of(const wchar_t* text) {
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  if (size <= 0) return "";
  std::string utf8(static_cast<std::size_t>(size), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text, -1, utf8.data(), size, nullptr, nullptr);
  utf8.pop_back();
  return utf8;
}

std::wstring wide_of(const std::string& text) {
  const int size = ::MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, nullptr, 0);
  if (size <= 0) return L"";
  std::wstring wide(static_cast<std::size_t>(size), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, wide.data(), size);
  wide.pop_back();
  return wide;
}

// The arguments of `main` have lost characters that the system's code page lacks.
std::vector<std::string> program_words(int argc, char** argv) {
  int count = 0;
  wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  if (wide == nullptr) return {argv + 1, argv + argc};
  std::vector<std::string> words;
  for (int i = 1; i < count; ++i) words.push_back(utf8_of(wide[i]));
  ::LocalFree(wide);
  return words;
}

bool open_standard_streams() {
  bool out_was_open = false;
  for (const int stream : {standard_input, standard_output, standard_error}) {
    const bool is_open = ::_get_osfhandle(stream) >= 0;
    if (stream == standard_output) out_was_open = is_open;
    if (!is_open) {
      const int opened = ::_open("NUL", _O_RDWR | _O_BINARY);
      if (opened >= 0 && opened != stream) {
        ::_dup2(opened, stream);
        ::_close(opened);
      }
    }
    ::_setmode(stream, _O_BINARY);
  }
  // The output is UTF-8.
  ::SetConsoleOutputCP(CP_UTF8);
  return out_was_open;
}

void ignore_closed_pipes() {}
void keep_freed_memory() {}

// _isatty would also accept the null device.
bool is_terminal(int stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(reinterpret_cast<HANDLE>(::_get_osfhandle(stream)), &mode) != 0;
}

bool understands_colours(int stream) {
  constexpr DWORD escape_sequences = 0x0004;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(stream));
  DWORD mode = 0;
  if (::GetConsoleMode(handle, &mode) == 0) return false;
  return (mode & escape_sequences) != 0 || ::SetConsoleMode(handle, mode | escape_sequences) != 0;
}

int write_all(int stream, std::string_view text) {
  constexpr std::size_t most = 8192;  // a console takes at most 32,767 bytes at a time
  while (!text.empty()) {
    const int count =
        ::_write(stream, text.data(), static_cast<unsigned>(std::min(text.size(), most)));
    // Writing to a closed pipe fails with EINVAL.
    if (count < 0) return errno == EINVAL ? EPIPE : errno;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

SystemNames system_names() { return {"Windows", "x86_64"}; }

}  // namespace kinemend::cli::platform
#endif
