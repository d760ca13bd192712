# What C++ programs may build on stands in bindings/lamella.hpp. Of the other headers only those are installed that these
# include; they may change from one version to the next.
set(public_headers "")
set(to_read ${PROJECT_SOURCE_DIR}/bindings/lamella.hpp)
while(to_read)
    list(POP_FRONT to_read header)
    file(STRINGS ${header} includes REGEX "^#include \"")
    foreach(include ${includes})
        string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" include ${include})
        if(NOT include IN_LIST public_headers AND EXISTS ${PROJECT_SOURCE_DIR}/${include})
            list(APPEND public_headers ${include})
            list(APPEND to_read ${PROJECT_SOURCE_DIR}/${include})
        endif()
    endforeach()
endwhile()
foreach(header ${public_headers})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lamella/${folder})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/bindings/lamella.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lamella)
install(TARGETS lamella lamella_engine lamella_procedural lamella_printers lamella_recipe EXPORT lamella_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS lamella_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lamella)
if(TARGET lamella_mpi)
    install(TARGETS lamella_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lamella)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/bindings/lamella.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS lamella_c EXPORT lamella_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Where things go is known when they are installed: --prefix may say otherwise than the build did.
set(lamella_pc_input ${PROJECT_SOURCE_DIR}/cmake/lamella.pc.in)
install(CODE "
    set(PROJECT_VERSION ${PROJECT_VERSION})
    set(CMAKE_INSTALL_FULL_INCLUDEDIR \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR})
    set(CMAKE_INSTALL_FULL_LIBDIR \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR})
    configure_file(${lamella_pc_input} ${PROJECT_BINARY_DIR}/lamella.pc @ONLY)")
install(FILES ${PROJECT_BINARY_DIR}/lamella.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
set(LAMELLA_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package is installed to")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/python/lamella DESTINATION ${LAMELLA_PYTHON_FOLDER}
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed")
install(EXPORT lamella_targets NAMESPACE lamella:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
configure_package_config_file(cmake/lamellaConfig.cmake.in ${PROJECT_BINARY_DIR}/lamellaConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lamellaConfig.cmake ${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake
              cmake/Dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
install(TARGETS lamella_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Completion of shells and manual pages, which the command writes when it is installed. One that was built for another
# machine cannot be run here.
if(NOT CMAKE_CROSSCOMPILING)
    set(made_share ${PROJECT_BINARY_DIR}/share)
    install(CODE "
        file(MAKE_DIRECTORY \"${made_share}/man1\")
        execute_process(COMMAND \"$<TARGET_FILE:lamella_command>\" completion bash
                        OUTPUT_FILE \"${made_share}/lamella\" COMMAND_ERROR_IS_FATAL ANY)
        execute_process(COMMAND \"$<TARGET_FILE:lamella_command>\" completion zsh
                        OUTPUT_FILE \"${made_share}/_lamella\" COMMAND_ERROR_IS_FATAL ANY)
        execute_process(COMMAND \"$<TARGET_FILE:lamella_command>\" man -o \"${made_share}/man1\"
                        COMMAND_ERROR_IS_FATAL ANY)")
    install(FILES ${made_share}/lamella DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${made_share}/_lamella DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(DIRECTORY ${made_share}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} FILES_MATCHING PATTERN "*.1")
endif()
