# Selects the parts to build besides the program and the library. None of them changes how these two are compiled, so a
# package installed later costs only the compilation of its own part.

# LibTorch's package looks for glog under two names; without this setting CMake would print a warning.
set(FPHSA_NAME_MISMATCHED ON)

# kinemend_optional(<variable> <option> <part> <arguments of find_package>...)
# Sets the variable to ON if the option asks for the part: ON requires the package, AUTO uses it if it is found.
# It is a macro, so that the caller gets the package's variables.
macro(kinemend_optional variable option part package)
  set(${variable} OFF)
  if("${${option}}" STREQUAL "ON")
    find_package(${package} ${ARGN} REQUIRED)
    set(${variable} ON)
  elseif("${${option}}" STREQUAL "AUTO" AND kinemend_takes_all_parts)
    find_package(${package} ${ARGN} QUIET)
    set(${variable} ${${package}_FOUND})
    if(NOT ${variable})
      kinemend_left_out("${part}: CMake does not find ${package}")
    endif()
  endif()
endmacro()

# A build for another system, a sanitised build, and a build as part of another project include only the parts that they
# name.
if(KINEMEND_FOREIGN OR KINEMEND_SANITIZE OR NOT PROJECT_IS_TOP_LEVEL)
  set(kinemend_takes_all_parts OFF)
else()
  set(kinemend_takes_all_parts ON)
endif()

if(KINEMEND_FOREIGN)
  # Its tests need GoogleTest compiled for the same standard library (kinemend_dependencies.cmake).
  set(kinemend_with_tests OFF)
  if(KINEMEND_TESTS STREQUAL "ON")
    set(kinemend_with_tests ON)
  endif()
else()
  # Debian's GoogleTest package stops CMake if GoogleMock's is missing.
  find_path(KINEMEND_GMOCK gmock/gmock.h)
  if(KINEMEND_GMOCK OR KINEMEND_TESTS STREQUAL "ON")
    kinemend_optional(kinemend_with_tests KINEMEND_TESTS "tests" GTest)
  else()
    set(kinemend_with_tests OFF)
    kinemend_left_out("tests: CMake does not find GoogleMock")
  endif()
endif()
