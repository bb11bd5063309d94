# The report page. The program embeds the bundle in web/dist, so that no build of it needs Node or esbuild. `make page` makes this bundle
# anew from web/src: esbuild bundles it with the npm packages that the lock file names. Tests compare the two, and run the page in a
# browser.

# Installs the packages into the build folder, once for each state of the lock file, and sets ${problem} where that is not possible.
function(kinemend_web_packages folder problem)
  set(arguments ci --ignore-scripts --prefer-offline)
  # TypeScript and the browser driver are only for tests.
  if(NOT kinemend_with_tests)
    list(APPEND arguments --omit=dev)
  endif()
  set(state "${arguments}")
  foreach(name package.json package-lock.json .npmrc)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/${name})
    file(SHA256 ${PROJECT_SOURCE_DIR}/web/${name} hash)
    string(APPEND state "\n${hash}")
  endforeach()
  set(installed "")
  if(EXISTS ${folder}/installed.txt)
    file(READ ${folder}/installed.txt installed)
  endif()
  if(installed STREQUAL state)
    return()
  endif()
  file(COPY ${PROJECT_SOURCE_DIR}/web/package.json ${PROJECT_SOURCE_DIR}/web/package-lock.json ${PROJECT_SOURCE_DIR}/web/.npmrc
    DESTINATION ${folder})
  message(STATUS "Report page: installing npm packages")
  execute_process(COMMAND ${KINEMEND_NPM} ${arguments} WORKING_DIRECTORY ${folder}
    RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words TIMEOUT 300)
  if(failed)
    set(${problem} "npm cannot install its packages" PARENT_SCOPE)
  else()
    file(WRITE ${folder}/installed.txt "${state}")
  endif()
endfunction()

# Bundles the page in the build folder for tests, `make page` and the app. The embedded bundle does not depend on it.
function(kinemend_bundle_page)
  set(web ${PROJECT_SOURCE_DIR}/web)
  set(folder ${PROJECT_BINARY_DIR}/web)
  set(made OFF)
  if(KINEMEND_WEB STREQUAL "ON" OR (KINEMEND_WEB STREQUAL "AUTO" AND kinemend_with_tests AND kinemend_takes_all_parts))
    set(problem "")
    find_program(KINEMEND_ESBUILD esbuild)
    find_program(KINEMEND_NPM npm)
    if(NOT KINEMEND_ESBUILD)
      set(problem "there is no esbuild")
    elseif(NOT KINEMEND_NPM)
      set(problem "there is no npm")
    else()
      kinemend_web_packages(${folder} problem)
    endif()
    if(problem)
      kinemend_left_out("bundling of the report page: ${problem}")
    else()
      set(made ON)
    endif()
  endif()

  if(made)
    file(GLOB sources CONFIGURE_DEPENDS ${web}/src/*.ts ${web}/src/*.css)
    set(bundle ${PROJECT_SOURCE_DIR}/cmake/bundle_page.cmake)
    add_custom_command(OUTPUT ${folder}/page.js ${folder}/page.css
      COMMAND ${CMAKE_COMMAND} -DESBUILD=${KINEMEND_ESBUILD} -DSOURCE=${web} -DPACKAGES=${folder}/node_modules -DFOLDER=${folder} -P ${bundle}
      DEPENDS ${bundle} ${sources} ${folder}/installed.txt COMMENT "Report page" VERBATIM)
    add_custom_target(kinemend_page ALL DEPENDS ${folder}/page.js ${folder}/page.css)
  endif()
  set(KINEMEND_WEB_MADE "${made}" CACHE INTERNAL "Whether the page is bundled here, and its packages are installed")
endfunction()

# The bundle in web/dist becomes part of a room.
function(kinemend_embed_page room)
  kinemend_is_imported(kinemend_${room} imported)
  if(imported)
    return()
  endif()
  set(folder ${PROJECT_SOURCE_DIR}/web/dist)
  set(output ${PROJECT_BINARY_DIR}/embedded_page.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake)
  # The JavaScript module writes no pages; pages use it.
  set(parts -DSCRIPT=${folder}/page.js -DSTYLE=${folder}/page.css)
  if(EMSCRIPTEN)
    set(parts "")
  endif()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} ${parts} -DOUTPUT=${output} -P ${script}
    DEPENDS ${script} ${PROJECT_SOURCE_DIR}/cmake/bytes_literal.cmake ${folder}/page.js ${folder}/page.css VERBATIM)
  target_sources(kinemend_${room} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
