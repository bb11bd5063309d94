# Bundles web/src into FOLDER/page.js and FOLDER/page.css, with the licences of the packages in front, as they require.
#   cmake -DESBUILD=esbuild -DSOURCE=web -DPACKAGES=node_modules -DFOLDER=build/release/web -P bundle_page.cmake
execute_process(COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${PACKAGES}
  ${ESBUILD} ${SOURCE}/src/page.ts --bundle --minify --format=iife --target=es2021 --charset=ascii --legal-comments=inline
    --log-level=warning --outfile=${FOLDER}/page.js
  COMMAND_ERROR_IS_FATAL ANY)
set(licensed "")
foreach(package three uplot)
  file(READ ${PACKAGES}/${package}/LICENSE licence)
  string(REPLACE "*/" "* /" licence "${licence}")
  string(APPEND licensed "/* ${package}:\n${licence}*/\n")
endforeach()
file(READ ${FOLDER}/page.js code)
file(WRITE ${FOLDER}/page.js "${licensed}${code}")
