# Decides which parts are built besides the program and the library. None of them changes how the program and the library are
# compiled, so a package that is installed later costs only the compile of its own part.

# LibTorch's package looks for glog under two names; without this CMake warns whoever configures.
set(FPHSA_NAME_MISMATCHED ON)

# kinemend_optional(<variable> <option> <part> <arguments of find_package>...)
# Sets the variable to ON where the option asks for the part: ON requires the package, AUTO takes the part if the package is found.
# A macro, so that the variables of the package reach the caller.
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

# A build for another system, a sanitised build, and a build as a part of another project have only the parts that they name.
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
  # Debian's package of GoogleTest stops CMake where that of GoogleMock is missing.
  find_path(KINEMEND_GMOCK gmock/gmock.h)
  if(KINEMEND_GMOCK OR KINEMEND_TESTS STREQUAL "ON")
    kinemend_optional(kinemend_with_tests KINEMEND_TESTS "tests" GTest)
  else()
    set(kinemend_with_tests OFF)
    kinemend_left_out("tests: CMake does not find GoogleMock")
  endif()
endif()
