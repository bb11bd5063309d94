# A room is a folder below src/, src/methods/ or src/papers/ (methods/auto): a static library with its own test
# program. The library of methods/auto is kinemend_methods_auto. Rooms of lab/ are built alike and not installed.

set(KINEMEND_ROOMS "" CACHE INTERNAL "")
set(KINEMEND_LAB_ROOMS "" CACHE INTERNAL "")

# Settings that every target of the project shares.
add_library(kinemend_settings INTERFACE)
# No contraction: the same seed gives the same bytes with and without fused multiply-add.
target_compile_options(kinemend_settings INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
# Eigen orders the sums of a product by the processor's registers and caches, which it queries; these settings are the
# same everywhere.
target_compile_definitions(kinemend_settings INTERFACE EIGEN_NO_CPUID EIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16)
set(kinemend_warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual)
# In files compiled as one, a name of one file often shadows that of another. Static analysis checks each file alone.
if(CMAKE_UNITY_BUILD)
  list(APPEND kinemend_warnings -Wno-shadow)
endif()
# A user's compiler may know warnings that ours does not, so only continuous integration treats them as errors.
if(KINEMEND_WARNINGS_AS_ERRORS)
  list(APPEND kinemend_warnings -Werror)
endif()
target_compile_options(kinemend_settings INTERFACE "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:${kinemend_warnings}>")
# GCC 12 raises false alarms where it inlines `"text" + string` and `string = "text"` (its bug 105651). The library and the program avoid
# such code where GCC does so; tests and experiments do not.
set(kinemend_false_alarms "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>")
if(KINEMEND_OTHER_ROOMS)
  target_compile_options(kinemend_settings INTERFACE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-include ${PROJECT_SOURCE_DIR}/cmake/same_json_layout.hpp>")
endif()
# Code that does little work is compiled with light optimisation, in half the time.
add_library(kinemend_light INTERFACE)
target_compile_options(kinemend_light INTERFACE $<$<NOT:$<CONFIG:Debug>>:${KINEMEND_LIGHT_LEVEL}>)
add_library(kinemend_sanitizer INTERFACE)
if(KINEMEND_SANITIZE)
  # The disabled checks take a fifth of the time; AddressSanitizer finds the same errors.
  target_compile_options(kinemend_sanitizer INTERFACE -fsanitize=${KINEMEND_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all)
  target_link_options(kinemend_settings INTERFACE -fsanitize=${KINEMEND_SANITIZE})
endif()

# Returns whether a room is sanitised and tested in this build; other builds test every room.
function(kinemend_is_examined name result)
  set(${result} OFF PARENT_SCOPE)
  if(NOT KINEMEND_SANITIZED_ROOMS OR "${name}" IN_LIST KINEMEND_SANITIZED_ROOMS)
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()

# Returns whether the library of a room comes from another build (KINEMEND_OTHER_ROOMS).
function(kinemend_is_imported target result)
  get_target_property(imported ${target} IMPORTED)
  set(${result} ${imported} PARENT_SCOPE)
endfunction()

# Records what this build lacks and why; `make test` prints these notes.
set(left_out_file ${PROJECT_BINARY_DIR}/left_out.txt)
file(WRITE ${left_out_file} "")
function(kinemend_left_out what)
  message(STATUS "Left out: ${what}")
  file(APPEND ${PROJECT_BINARY_DIR}/left_out.txt "Left out: ${what}\n")
endfunction()

# Where several files are compiled as one (CMAKE_UNITY_BUILD), unnamed namespaces of a room must not share names. Files
# that Highway includes again for each instruction set, and files slow enough to use a core of their own, are excluded.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 30)
function(kinemend_compile_alone)
  foreach(source ${ARGN})
    file(STRINGS ${source} found REGEX "foreach_target.h|unsupported/Eigen" LIMIT_COUNT 1)
    if(found)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# Headers that most files include, precompiled once for rooms with the same kinemend_light and kinemend_sanitizer.
function(kinemend_precompiled target)
  list(JOIN ARGN "_" key)
  if(NOT TARGET kinemend_headers_${key})
    # Written only if it differs, so that rerunning CMake recompiles nothing.
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/headers_${key}.cpp CONTENT "// Compiled for its precompiled headers.\n")
    add_library(kinemend_headers_${key} STATIC EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/headers_${key}.cpp)
    target_link_libraries(kinemend_headers_${key} PRIVATE kinemend_settings fmt::fmt ${ARGN})
    target_precompile_headers(kinemend_headers_${key} PRIVATE <fmt/format.h> <algorithm> <array> <cmath> <cstdint> <filesystem>
      <functional> <limits> <map> <memory> <optional> <span> <string> <string_view> <utility> <variant> <vector>)
  endif()
  target_precompile_headers(${target} REUSE_FROM kinemend_headers_${key})
endfunction()

# kinemend_room(<folder> [USES <folder>...] [LINK <target>...])
function(kinemend_room folder)
  cmake_parse_arguments(ROOM "" "" "USES;LINK" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  string(REPLACE "/" "_" ROOM_USES "${ROOM_USES}")
  list(TRANSFORM ROOM_USES PREPEND kinemend_)
  set(source_root ${PROJECT_SOURCE_DIR}/src)
  set(public_headers ${PROJECT_SOURCE_DIR}/include)
  if(folder MATCHES "^lab/")
    set(source_root ${PROJECT_SOURCE_DIR})
    list(APPEND public_headers ${PROJECT_SOURCE_DIR}/lab/include)
    set(KINEMEND_LAB_ROOMS ${KINEMEND_LAB_ROOMS} kinemend_${name} CACHE INTERNAL "")
  else()
    set(KINEMEND_ROOMS ${KINEMEND_ROOMS} kinemend_${name} CACHE INTERNAL "")
  endif()
  kinemend_is_examined(${folder} examined)
  if(KINEMEND_OTHER_ROOMS AND NOT examined)
    # Instrumented and plain code can call each other, so a room that is not examined need not be recompiled.
    add_library(kinemend_${name} STATIC IMPORTED GLOBAL)
    set_target_properties(kinemend_${name} PROPERTIES IMPORTED_LOCATION ${KINEMEND_OTHER_ROOMS}/libkinemend_${name}.a)
    target_include_directories(kinemend_${name} INTERFACE ${public_headers})
    target_link_libraries(kinemend_${name} INTERFACE ${ROOM_LINK} ${ROOM_USES})
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${source_root}/${folder}/*.cpp)
  add_library(kinemend_${name} STATIC ${sources})
  kinemend_compile_alone(${sources})
  add_library(kinemend::${name} ALIAS kinemend_${name})
  target_include_directories(kinemend_${name} PUBLIC ${public_headers})
  target_include_directories(kinemend_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${source_root})
  target_compile_features(kinemend_${name} PUBLIC cxx_std_20)
  set(modes "")
  if(name MATCHES "^(check|lab_damage|lab_synthesis|live|registry|report)$")
    list(APPEND modes kinemend_light)
  endif()
  if(examined)
    list(APPEND modes kinemend_sanitizer)
  endif()
  target_link_libraries(kinemend_${name} PRIVATE kinemend_settings ${modes} ${ROOM_LINK})
  kinemend_precompiled(kinemend_${name} ${modes})
  target_link_libraries(kinemend_${name} PUBLIC ${ROOM_USES})
endfunction()

# The files in models/ become part of a room.
function(kinemend_embed_models folder)
  string(REPLACE "/" "_" room ${folder})
  kinemend_is_imported(kinemend_${room} imported)
  if(imported)
    return()
  endif()
  file(GLOB models CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/models/*.kmodel)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_models.cmake)
  string(REPLACE ";" "|" names "${KINEMEND_MODELS}")  # a list would become several words of the command
  set(output ${PROJECT_BINARY_DIR}/embedded_models.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/models -DNAMES=${names} -DOUTPUT=${output} -P ${script}
    DEPENDS ${script} ${PROJECT_SOURCE_DIR}/cmake/bytes_literal.cmake ${models} COMMENT "Models that ship" VERBATIM)
  target_sources(kinemend_${room} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# kinemend::kinemend is all rooms of src/ together, kinemend::lab those of lab/ with them. One library is installed, kinemend_installed. A shared one contains the
# libraries that the rooms use, so that a project need not find them; the package of a static one finds those that are
# not compiled with the project.
function(kinemend_library)
  add_library(kinemend INTERFACE)
  add_library(kinemend::kinemend ALIAS kinemend)
  target_link_libraries(kinemend INTERFACE ${KINEMEND_ROOMS})
  add_library(kinemend_lab INTERFACE)
  add_library(kinemend::lab ALIAS kinemend_lab)
  target_link_libraries(kinemend_lab INTERFACE ${KINEMEND_LAB_ROOMS} kinemend)

  # All rooms, for a build that reuses some of them from this one.
  add_custom_target(kinemend_rooms DEPENDS ${KINEMEND_ROOMS} ${KINEMEND_LAB_ROOMS})
  # A sanitised library is not installed.
  if(KINEMEND_SANITIZE)
    return()
  endif()

  set(objects ${KINEMEND_ROOMS})
  if(TARGET kinemend_zlib)
    set(packages "")
    set(linked "")
    list(APPEND objects kinemend_zlib)
  else()
    set(packages ZLIB Threads)
    set(linked ZLIB::ZLIB Threads::Threads)
  endif()
  if(KINEMEND_FOREIGN)
    list(APPEND objects kinemend_highway)
  else()
    list(APPEND packages fmt HWY)
    list(APPEND linked fmt::fmt hwy::hwy)
  endif()
  if(KINEMEND_TBB)
    list(APPEND packages TBB)
    list(APPEND linked TBB::tbb)
  endif()
  if(BUILD_SHARED_LIBS)
    set(packages "")
  endif()
  add_library(kinemend_installed)
  foreach(part ${objects})
    target_sources(kinemend_installed PRIVATE $<TARGET_OBJECTS:${part}>)
  endforeach()
  target_link_libraries(kinemend_installed PRIVATE ${linked})
  if(BUILD_SHARED_LIBS)
    target_link_options(kinemend_installed PRIVATE ${KINEMEND_LINK_OPTIONS} $<$<CXX_COMPILER_ID:GNU>:-Wl,--as-needed>)
    set_target_properties(kinemend_installed PROPERTIES VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  else()
    target_link_options(kinemend_installed INTERFACE ${KINEMEND_LINK_OPTIONS})
  endif()
  target_include_directories(kinemend_installed INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(kinemend_installed INTERFACE cxx_std_20)
  set_target_properties(kinemend_installed PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME kinemend EXPORT_NAME kinemend)
  kinemend_install_library("${packages}")
endfunction()

# `packages` are the CMake packages that a project linking the library must find.
function(kinemend_install_library packages)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/kinemend)
  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/kinemend-config-version.cmake COMPATIBILITY SameMinorVersion)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/kinemend-config.cmake.in ${PROJECT_BINARY_DIR}/kinemend-config.cmake @ONLY)
  install(TARGETS kinemend_installed EXPORT kinemend COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kinemend DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT kinemend NAMESPACE kinemend:: DESTINATION ${folder} FILE kinemend-targets.cmake COMPONENT development)
  install(FILES ${PROJECT_BINARY_DIR}/kinemend-config.cmake ${PROJECT_BINARY_DIR}/kinemend-config-version.cmake
    DESTINATION ${folder} COMPONENT development)
  kinemend_install_pkg_config("${packages}")
endfunction()

# Read by `pkg-config kinemend`. Its paths are relative to itself, so that an installed folder may be moved.
function(kinemend_install_pkg_config packages)
  set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  string(REGEX REPLACE "[^/]+" ".." prefix_from_here ${folder})
  set(required "")
  set(flags "")
  # A shared library names its own dependencies; for a static one, the program links them.
  if(NOT BUILD_SHARED_LIBS)
    set(flags " -pthread")
    if("ZLIB" IN_LIST packages)
      set(required " zlib")
    endif()
    if("fmt" IN_LIST packages)
      string(APPEND required " fmt libhwy")
    endif()
    if("TBB" IN_LIST packages)
      string(APPEND required " tbb")
    endif()
    if(KINEMEND_LINK_OPTIONS)
      list(JOIN KINEMEND_LINK_OPTIONS " " options)
      string(APPEND flags " ${options}")
    endif()
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/kinemend.pc.in ${PROJECT_BINARY_DIR}/kinemend.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/kinemend.pc DESTINATION ${folder} COMPONENT development)
endfunction()
