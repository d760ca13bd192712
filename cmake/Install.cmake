foreach(folder engine procedural printers)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lamella
            FILES_MATCHING PATTERN "*.h")
endforeach()
install(TARGETS lamella lamella_engine lamella_procedural lamella_printers EXPORT lamella_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS lamella_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lamella)
install(EXPORT lamella_targets NAMESPACE lamella:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
configure_package_config_file(cmake/lamellaConfig.cmake.in ${PROJECT_BINARY_DIR}/lamellaConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lamellaConfig.cmake ${PROJECT_BINARY_DIR}/lamellaConfigVersion.cmake
              cmake/Dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lamella)
if(TARGET lamella_command)
    install(TARGETS lamella_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
