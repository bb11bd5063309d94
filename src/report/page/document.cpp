// Puts the program, the styles and the data of the page into one document.
#include "report/page/document.hpp"

#include <fmt/format.h>

#include "kinemend/error.hpp"
#include "kinemend/experimental/page.hpp"
#include "kinemend/experimental/svg.hpp"
#include "kinemend/experimental/version.hpp"
#include "report/page/codec.hpp"

namespace kinemend {

bool has_report_page() { return !page::script.empty(); }

namespace page {

namespace {

// Returns the parts as elements of a document.
std::string elements_of(const Parts& parts) {
  std::string html;
  for (const auto& [name, bytes] : parts) {
    html += fmt::format("<script type=\"application/octet-stream\" id=\"data-{}\">", name);
    html += base64(deflated(bytes));
    html += "</script>\n";
  }
  return html;
}

}  // namespace

void check_is_built() {
  if (has_report_page()) return;
  throw Error(ErrorKind::usage,
              "this kinemend was built without its report page: a report can be "
              "written as FILE.json");
}

std::string joined(const Parts& parts) {
  std::string result = "[";
  std::size_t size = 0;
  for (const auto& [name, bytes] : parts) {
    result += fmt::format("{}[\"{}\",{}]", result.size() > 1 ? "," : "", name, bytes.size());
    size += bytes.size();
  }
  result += "]\n";
  result.reserve(result.size() + size);
  for (const auto& part : parts) result += part.second;
  return result;
}

std::string document(std::string_view title, std::string_view summary, const Parts& parts,
                     bool is_served) {
  check_is_built();
  // The policy forbids loading from anywhere else, whatever the data contains.
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:{}\">\n"
      "<meta name=\"generator\" content=\"kinemend {}\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<main id=\"page\"><p class=\"first\">{}</p>\n"
      "<noscript><p>This page needs JavaScript to show the motion.</p></noscript></main>\n",
      is_served ? "; connect-src 'self'" : "", version(), xml_escaped(title), style,
      xml_escaped(summary));
  html += elements_of(parts);
  html += "<script>";
  html += script;
  html += "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace page

std::string served_page(std::string_view title, std::string_view summary,
                        std::span<const std::pair<std::string, std::string>> parts) {
  return page::document(title, summary, {parts.begin(), parts.end()}, true);
}

}  // namespace kinemend
