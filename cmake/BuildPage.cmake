# Bundles the page at build time, that of `asperity serve` or, with MODULE, that of static files:
#   cmake -DSOURCE=bindings/web/page -DWORK=.. -DOUTPUT=.. -DNPM=npm -DNODE=node -DTESTS=ON [-DMODULE=..] -P BuildPage.cmake
# The sources are copied, so that nothing is written beside them. Packages are those of package-lock.json, checked by
# their digests, and run no install scripts; they are fetched again only when the lock file changes. Whatever fails is
# said, and stops nothing: the program does without the page.
function(give_up what log)
  string(REGEX REPLACE "\n+$" "" log "${log}")
  string(LENGTH "${log}" length)
  if(length GREATER 1500)
    math(EXPR from "${length} - 1500")
    string(SUBSTRING "${log}" ${from} -1 log)
  endif()
  message(WARNING "the page is not built: ${what}\n${log}")
endfunction()

file(REMOVE_RECURSE ${WORK}/src)
file(REMOVE ${WORK}/built)
file(COPY ${SOURCE}/src ${SOURCE}/build.mjs ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/tsconfig.json
     DESTINATION ${WORK})

execute_process(COMMAND ${NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
string(REGEX MATCH "[0-9]+" major "${version}")
if(NOT major OR major LESS 18)
  give_up("Node.js 18 or newer is needed, this is ${version}" "")
  return()
endif()

# What only tests and the check of types use is left out where there are none.
set(kinds "")
if(NOT TESTS)
  set(kinds --omit=dev)
endif()
file(SHA256 ${SOURCE}/package-lock.json lock)
set(wanted "${lock} ${kinds}")
set(have "")
if(EXISTS ${WORK}/node_modules/.asperity)
  file(READ ${WORK}/node_modules/.asperity have)
endif()
if(NOT have STREQUAL wanted)
  execute_process(COMMAND ${NPM} ci ${kinds} --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1
                  WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE log ERROR_VARIABLE log)
  if(failed)
    give_up("`npm ci` fetches its packages the first time, and failed" "${log}")
    return()
  endif()
  file(WRITE ${WORK}/node_modules/.asperity "${wanted}")
endif()

execute_process(COMMAND ${NODE} build.mjs ${OUTPUT} ${MODULE} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed
                OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(failed)
  give_up("its sources could not be bundled" "${log}")
  return()
endif()
file(WRITE ${WORK}/built "${log}")
