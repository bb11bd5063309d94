# The report page: web/ bundled by esbuild, from npm packages that its lock file names.

# Installs the packages into the build folder, once for each state of the lock file, and sets ${problem} where that is not possible.
function(kinemend_web_packages folder problem)
  set(arguments ci --ignore-scripts --prefer-offline)
  # TypeScript and what drives a browser are for tests.
  if(NOT KINEMEND_DEVELOPER OR KINEMEND_SANITIZE)
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

# The bundle becomes part of a room; of a build without it an empty one does, and the program says so when a page is asked for.
function(kinemend_embed_page room)
  set(folder ${PROJECT_BINARY_DIR}/web)
  set(problem "")
  if(NOT KINEMEND_WEB)
    set(problem "KINEMEND_WEB is OFF")
  else()
    find_program(KINEMEND_ESBUILD esbuild)
    find_program(KINEMEND_NPM npm)
    if(NOT KINEMEND_ESBUILD)
      set(problem "there is no esbuild")
    elseif(NOT KINEMEND_NPM)
      set(problem "there is no npm")
    else()
      kinemend_web_packages(${folder} problem)
    endif()
  endif()

  set(output ${PROJECT_BINARY_DIR}/embedded_page.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake)
  set(embed ${CMAKE_COMMAND} -DOUTPUT=${output})
  set(needed ${script} ${PROJECT_SOURCE_DIR}/cmake/bytes_literal.cmake)
  if(problem)
    message(STATUS "Report page: left out, as ${problem}")
    add_custom_command(OUTPUT ${output} COMMAND ${embed} -P ${script} DEPENDS ${needed} VERBATIM)
  else()
    message(STATUS "Report page: built")
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/src/*.ts ${PROJECT_SOURCE_DIR}/web/src/*.css)
    add_custom_command(OUTPUT ${folder}/page.js ${folder}/page.css
      COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${folder}/node_modules
        ${KINEMEND_ESBUILD} ${PROJECT_SOURCE_DIR}/web/src/page.ts --bundle --minify --format=iife --target=es2021
        --charset=ascii --legal-comments=inline --log-level=warning --outfile=${folder}/page.js
      DEPENDS ${sources} ${folder}/installed.txt COMMENT "Report page" VERBATIM)
    add_custom_command(OUTPUT ${output}
      COMMAND ${embed} -DSCRIPT=${folder}/page.js -DSTYLE=${folder}/page.css -DPACKAGES=${folder}/node_modules -P ${script}
      DEPENDS ${needed} ${folder}/page.js ${folder}/page.css VERBATIM)
  endif()
  target_sources(kinemend_${room} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set(KINEMEND_WEB_PROBLEM "${problem}" CACHE INTERNAL "Why there is no report page; empty where there is one")
endfunction()
