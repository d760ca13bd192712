# Builds the page of `lamella studio` from studio/ with npm, for the program to hold. Sets studio_page to its files; to
# none where there is no npm, and the command then says so.
set(studio_page "")
find_program(NPM npm)
if(NOT NPM)
    message(STATUS "npm is missing: lamella studio will have no page")
    return()
endif()
set(studio_build ${PROJECT_BINARY_DIR}/studio)
foreach(name index.html studio.js studio.css icon.svg)
    list(APPEND studio_page ${studio_build}/dist/${name})
endforeach()
file(GLOB_RECURSE studio_sources CONFIGURE_DEPENDS studio/src/*)
set(studio_setup studio/package.json studio/package-lock.json studio/tsconfig.json studio/build.mjs)
list(TRANSFORM studio_setup PREPEND ${PROJECT_SOURCE_DIR}/)
# Installed packages change with the lock file alone.
add_custom_command(OUTPUT ${studio_build}/installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${studio_build}
    COMMAND ${CMAKE_COMMAND} -E copy ${studio_setup} ${studio_build}
    COMMAND ${NPM} ci --omit=dev --no-audit --no-fund --silent
    COMMAND ${CMAKE_COMMAND} -E touch ${studio_build}/installed
    WORKING_DIRECTORY ${studio_build} DEPENDS ${studio_setup} VERBATIM)
add_custom_command(OUTPUT ${studio_page}
    COMMAND ${CMAKE_COMMAND} -E remove_directory ${studio_build}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/studio/src ${studio_build}/src
    COMMAND ${NPM} run build --silent
    WORKING_DIRECTORY ${studio_build} DEPENDS ${studio_build}/installed ${studio_sources} VERBATIM)
