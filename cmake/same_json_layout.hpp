// Included first where clang links rooms that GCC compiled (KINEMEND_OTHER_ROOMS): the JSON library
// asks the compiler about the attribute in a form that clang 14 answers with no, and ordered
// objects would then have another size here than there.
#pragma once
#include <nlohmann/detail/macro_scope.hpp>
#undef JSON_NO_UNIQUE_ADDRESS
#define JSON_NO_UNIQUE_ADDRESS [[no_unique_address]]
