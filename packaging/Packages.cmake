# Debian packages, made by CPack from what cmake/Install.cmake and this file install: `bash packaging/build.sh` says how.
# LAMELLA_PACKAGES adds what belongs to a system and not to a prefix: menu entry, file types, services, licences.
if(NOT LAMELLA_PACKAGES)
    return()
endif()
set(LAMELLA_MAINTAINER "Lamella maintainers <lamella@users.noreply.github.com>" CACHE STRING "Who made the packages")
set(app_id io.github.lamella.Lamella)
set(here ${PROJECT_SOURCE_DIR}/packaging)
set(share ${CMAKE_INSTALL_DATADIR})

install(FILES ${here}/desktop/${app_id}.desktop DESTINATION ${share}/applications COMPONENT command)
install(FILES ${here}/desktop/${app_id}.xml DESTINATION ${share}/mime/packages COMPONENT command)
install(FILES ${PROJECT_SOURCE_DIR}/studio/src/icon.svg DESTINATION ${share}/icons/hicolor/scalable/apps
        RENAME ${app_id}.svg COMPONENT command)
install(FILES ${here}/systemd/lamella-studio.service ${here}/systemd/lamella-serve.service
        DESTINATION lib/systemd/user COMPONENT command)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/ DESTINATION ${share}/lamella/examples COMPONENT command
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.obj" PATTERN "*.csv" PATTERN "*.png" PATTERN "*.tif" PATTERN "*.ply"
        PATTERN "*.svg" PATTERN "*.md" PATTERN "embedding" EXCLUDE PATTERN "javascript" EXCLUDE PATTERN "plugin" EXCLUDE
        PATTERN "python" EXCLUDE PATTERN "appearance" EXCLUDE)

# The version of the packages, their licences and their changelog come from the project's own.
set(made ${PROJECT_BINARY_DIR}/packages)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
execute_process(COMMAND ${Python3_EXECUTABLE} ${here}/documents.py --version ${PROJECT_VERSION} --app-id ${app_id}
                        --maintainer ${LAMELLA_MAINTAINER} --output ${made} COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${here}/documents.py ${PROJECT_SOURCE_DIR}/CHANGELOG.md
             ${here}/desktop/${app_id}.metainfo.xml ${here}/flatpak/${app_id}.yaml)
install(FILES ${made}/${app_id}.metainfo.xml DESTINATION ${share}/metainfo COMPONENT command)
set(packages_of_command lamella)
set(packages_of_library liblamella1)
set(packages_of_development liblamella-dev)
set(packages_of_python python3-lamella)
set(CPACK_COMPONENTS_ALL command library development python)
foreach(part ${CPACK_COMPONENTS_ALL})
    set(package ${packages_of_${part}})
    string(TOUPPER ${part} PART)
    install(FILES ${made}/changelog.gz ${made}/changelog.Debian.gz ${here}/debian/copyright
            DESTINATION ${share}/doc/${package} COMPONENT ${part})
    set(CPACK_DEBIAN_${PART}_PACKAGE_NAME ${package})
    set(CPACK_DEBIAN_${PART}_FILE_NAME DEB-DEFAULT)
endforeach()
install(FILES ${here}/README.Debian ${here}/60-lamella-serial.rules DESTINATION ${share}/doc/lamella COMPONENT command)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lamella)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_CONTACT ${LAMELLA_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
if(CMAKE_CROSSCOMPILING)
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${LAMELLA_ARCH})
endif()
set(exact "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

set(about "Lamella turns a mesh, a formula or a recipe into printable layers, one at
a time: foams, lattices, skins and supports are computed while the printer
runs, and are never a mesh or a voxel grid. Layers go to mask formats of
resin printers, to G-code, SVG and CLI, into files or straight to a machine.
.")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "streaming layer engine for 3D printing\n${about}
This package has the command, its pages and examples.")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "liblamella1 ${exact}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "python3-lamella")

# Pictures of formats other than PNG need OpenImageIO, which brings 200 packages: no more than recommended.
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "streaming layer engine for 3D printing - library\n${about}
This package has the library for programs that embed Lamella.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
file(WRITE ${made}/shlibs "liblamella 1 liblamella1 (>= ${PROJECT_VERSION})\n")
file(WRITE ${made}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${made}/shlibs ${made}/triggers)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libopenimageio2.4")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_MULTIARCH same)

file(STRINGS cmake/packages-build.txt built_on REGEX "^lib.*-dev$|^nlohmann|^zlib")
list(FILTER built_on EXCLUDE REGEX "avahi|httplib|curl|ssl|boost|cli11")  # of the command alone
list(JOIN built_on ", " built_on)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "streaming layer engine for 3D printing - headers\n${about}
This package has what C and C++ programs are built with: headers, static
libraries, a CMake package and a pkg-config file.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "liblamella1 ${exact}, ${built_on}")

set(CPACK_COMPONENT_PYTHON_DESCRIPTION "streaming layer engine for 3D printing - Python\n${about}
This package has the Python module: layers as contours and arrays.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3:any, python3-numpy, liblamella1 (>= ${PROJECT_VERSION}), liblamella1 (<< ${PROJECT_VERSION}-99)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${here}/debian/postinst ${here}/debian/prerm)
include(CPack)
