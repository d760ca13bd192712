# Everything comes from Debian packages; packages-build.txt names them. Some ship no CMake package, only
# pkg-config files or bare headers: those get an imported target here.
find_package(Eigen3 REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(pugixml REQUIRED)
find_package(PkgConfig REQUIRED)
if(NOT TARGET glm::glm)
    add_library(glm::glm INTERFACE IMPORTED)
endif()
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET GLOBAL libhwy)
add_library(hwy::hwy ALIAS PkgConfig::hwy)
# On ARM: SVE vectors have no size at compile time, and our kernels keep vectors in structs. NEON of 32 bits has no doubles,
# flushes small numbers to zero, and divides only by about: kernels run without vectors there.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)")
    target_compile_definitions(PkgConfig::hwy INTERFACE
        "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^arm")
    target_compile_definitions(PkgConfig::hwy INTERFACE "HWY_DISABLED_TARGETS=HWY_NEON")
endif()
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET GLOBAL libzip)
add_library(libzip::zip ALIAS PkgConfig::libzip)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET GLOBAL libdeflate)
add_library(libdeflate::libdeflate ALIAS PkgConfig::libdeflate)
pkg_check_modules(polyclipping REQUIRED IMPORTED_TARGET GLOBAL polyclipping)
add_library(polyclipping::polyclipping ALIAS PkgConfig::polyclipping)
# OpenImageIO's own CMake package names programs and OpenCV headers that its development package does not install.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO)
add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::OpenImageIO)
