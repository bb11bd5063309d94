# Permissions that do not depend on the umask.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Debian packages, by `make deb`: kinemend (the program) and libkinemend-dev (library, headers, CMake package).
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/kinemend RENAME copyright COMPONENT program)
# tools/make_deb writes these files: the licences of compiled-in libraries.
foreach(part program development)
  set(package kinemend)
  if(part STREQUAL "development")
    set(package libkinemend-dev)
  endif()
  install(FILES ${PROJECT_BINARY_DIR}/licences/${package}/LICENCES.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${part} OPTIONAL)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/kinemend COMPONENT program
  FILES_MATCHING PATTERN "*.toml")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libkinemend-dev RENAME copyright
  COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/deb)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Kinemend authors <maintainers@kinemend.invalid>")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# dpkg-shlibdeps finds the libraries that the binaries link.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kinemend)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Cleans human motion capture
 Removes jitter and spikes, fills gaps and holds sliding feet in takes of joints
 (BVH, AMC) and markers (C3D, TRC, TSV, CSV), and leaves the rest of each file
 unchanged. Manual page, shell completions and presets are included.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libkinemend-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Library that cleans human motion capture
 The shared library of Kinemend with its C++20 headers and its CMake package:
 find_package(kinemend) and kinemend::kinemend.")
include(CPack)
