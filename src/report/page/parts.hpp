#pragma once

#include <cstddef>
#include <string_view>

// What cmake/embed_page.cmake makes of the bundle of web/; empty without web/dist.
namespace kinemend::page {

extern const std::string_view script;
extern const std::string_view style;

}  // namespace kinemend::page
