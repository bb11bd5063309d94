// The program and the styles of the page, which cmake/embed_page.cmake makes of the bundle of web/;
// empty without web/dist.
#pragma once

#include <cstddef>
#include <string_view>

namespace kinemend::page {

extern const std::string_view script;
extern const std::string_view style;

}  // namespace kinemend::page
