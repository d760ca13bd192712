# What is installed has four parts, which are packages of their own: command, library, development and python.

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
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lamella/${folder}
            COMPONENT development)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/bindings/lamella.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lamella
        COMPONENT development)
install(TARGETS lamella lamella_engine lamella_procedural lamella_printers lamella_recipe EXPORT lamella_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS lamella_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lamella COMPONENT library)
if(TARGET lamella_mpi)
    install(TARGETS lamella_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lamella COMPONENT library)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/bindings/lamella.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS lamella_c EXPORT lamella_targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Where things go is known when they are installed: --prefix may say otherwise than the build did.
set(lamella_pc_input ${PROJECT_SOURCE_DIR}/cmake/lamella.pc.in)
install(CODE "
    set(PROJECT_VERSION ${PROJECT_VERSION})
    set(CMAKE_INSTALL_FULL_INCLUDEDIR \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR})
    set(CMAKE_INSTALL_FULL_LIBDIR \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR})
    configure_file(${lamella_pc_input} ${PROJECT_BINARY_DIR}/lamella.pc @ONLY)" COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/lamella.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
set(LAMELLA_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package is installed to")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/python/lamella DESTINATION ${LAMELLA_PYTHON_FOLDER}
        COMPONENT python FILES_MATCHING PATTERN "*.py" PATTERN "py.typed")
install(EXPORT lamella_targets NAMESPACE lamella:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella
        COMPONENT development)
configure_package_config_file(cmake/lamellaConfig.cmake.in ${PROJECT_BINARY_DIR}/lamellaConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lamellaConfig.cmake ${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake
              cmake/Dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella COMPONENT development)
install(TARGETS lamella_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)

# Completion of shells and manual pages, which the command writes when it is installed. One that was built for another
# machine is run by an emulator, if the toolchain names one.
if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    set(made_share ${PROJECT_BINARY_DIR}/share)
    set(run_command ${CMAKE_CROSSCOMPILING_EMULATOR} "$<TARGET_FILE:lamella_command>")
    list(JOIN run_command "\" \"" run_command)
    install(CODE "
        file(REMOVE_RECURSE \"${made_share}/man1\")
        file(MAKE_DIRECTORY \"${made_share}/man1\")
        foreach(shell bash zsh fish)
            execute_process(COMMAND \"${run_command}\" completion \${shell}
                            OUTPUT_FILE \"${made_share}/lamella.\${shell}\" COMMAND_ERROR_IS_FATAL ANY)
        endforeach()
        execute_process(COMMAND \"${run_command}\" man -o \"${made_share}/man1\"
                        COMMAND_ERROR_IS_FATAL ANY)
        if(\"${LAMELLA_PACKAGES}\" STREQUAL ON)  # Debian packs its pages
            file(GLOB pages \"${made_share}/man1/*.1\")
            execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)
        endif()" COMPONENT command)
    install(FILES ${made_share}/lamella.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
            RENAME lamella COMPONENT command)
    install(FILES ${made_share}/lamella.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _lamella
            COMPONENT command)
    install(FILES ${made_share}/lamella.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
            COMPONENT command)
    install(DIRECTORY ${made_share}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT command
            FILES_MATCHING PATTERN "*.1" PATTERN "*.1.gz")
endif()
