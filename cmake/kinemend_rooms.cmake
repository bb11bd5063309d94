# A room is one folder below src/: a static library of its own, tested by one program of its own.

set(KINEMEND_ROOMS "" CACHE INTERNAL "")

# Settings that every target of the project shares.
add_library(kinemend_settings INTERFACE)
# No contraction: the same seed gives the same bytes with and without fused multiply-add.
target_compile_options(kinemend_settings INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang>:-ffp-contract=off>)
if(KINEMEND_DEVELOPER)
  target_compile_options(kinemend_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
  # Of files compiled as one, the names of each are hidden by those of another; the preset `dev` and static analysis look at each alone.
  if(CMAKE_UNITY_BUILD)
    target_compile_options(kinemend_settings INTERFACE -Wno-shadow)
  endif()
  # GCC 12 raises a false alarm about "text" + std::string (its bug 105651).
  target_compile_options(kinemend_settings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endif()
if(KINEMEND_SANITIZE)
  # What is left out costs a fifth of the time; AddressSanitizer finds what these would.
  target_compile_options(kinemend_settings INTERFACE -fsanitize=${KINEMEND_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all)
  target_link_options(kinemend_settings INTERFACE -fsanitize=${KINEMEND_SANITIZE})
endif()

# Where several files are compiled as one (CMAKE_UNITY_BUILD), names of unnamed namespaces must not meet in a room. Left out are files
# that Highway includes again for each instruction set, and those that take long enough to be worth a core of their own.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 30)
function(kinemend_compile_alone)
  foreach(source ${ARGN})
    file(STRINGS ${source} found REGEX "foreach_target.h|unsupported/Eigen" LIMIT_COUNT 1)
    if(found)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# kinemend_room(<name> [USES <room>...] [LINK <target>...])
function(kinemend_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(kinemend_${name} STATIC ${sources})
  kinemend_compile_alone(${sources})
  add_library(kinemend::${name} ALIAS kinemend_${name})
  target_include_directories(kinemend_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(kinemend_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(kinemend_${name} PUBLIC cxx_std_20)
  if(KINEMEND_LIGHT_LEVEL AND name MATCHES "^(live|page|report)$")
    target_compile_options(kinemend_${name} PRIVATE ${KINEMEND_LIGHT_LEVEL})
  endif()
  target_link_libraries(kinemend_${name} PRIVATE $<BUILD_INTERFACE:kinemend_settings> ${ROOM_LINK})
  foreach(used ${ROOM_USES})
    target_link_libraries(kinemend_${name} PUBLIC kinemend_${used})
  endforeach()
  set_target_properties(kinemend_${name} PROPERTIES EXPORT_NAME ${name})
  set(KINEMEND_ROOMS ${KINEMEND_ROOMS} kinemend_${name} CACHE INTERNAL "")
endfunction()

# The files in models/ become part of a room.
function(kinemend_embed_models room)
  file(GLOB models CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/models/*.kmodel)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_models.cmake)
  set(output ${PROJECT_BINARY_DIR}/embedded_models.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/models -DOUTPUT=${output} -P ${script}
    DEPENDS ${script} ${PROJECT_SOURCE_DIR}/cmake/bytes_literal.cmake ${models} COMMENT "Models that ship" VERBATIM)
  target_sources(kinemend_${room} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# kinemend::kinemend is all rooms together, installed with a package file.
function(kinemend_library)
  add_library(kinemend INTERFACE)
  add_library(kinemend::kinemend ALIAS kinemend)
  target_link_libraries(kinemend INTERFACE ${KINEMEND_ROOMS})
  install(TARGETS kinemend ${KINEMEND_ROOMS} EXPORT kinemend ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kinemend DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT kinemend NAMESPACE kinemend:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinemend
    FILE kinemend-targets.cmake)
  include(CMakePackageConfigHelpers)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/kinemend-config.cmake.in
    ${PROJECT_BINARY_DIR}/kinemend-config.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinemend)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/kinemend-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/kinemend-config.cmake ${PROJECT_BINARY_DIR}/kinemend-config-version.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinemend)
endfunction()
