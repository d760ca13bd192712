# Builds for another Debian architecture with Debian's cross compiler, against the packages of that architecture that
# packaging/sysroot.sh unpacked: -DLAMELLA_ARCH=arm64 or armhf, -DLAMELLA_SYSROOT=its folder.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LAMELLA_ARCH LAMELLA_SYSROOT)
set(lamella_triplet_arm64 aarch64-linux-gnu)
set(lamella_triplet_armhf arm-linux-gnueabihf)
set(lamella_processor_arm64 aarch64)
set(lamella_processor_armhf armv7l)
set(lamella_emulator_arm64 qemu-aarch64-static)
set(lamella_emulator_armhf qemu-arm-static)
set(lamella_triplet ${lamella_triplet_${LAMELLA_ARCH}})
if(NOT lamella_triplet)
    message(FATAL_ERROR "LAMELLA_ARCH is '${LAMELLA_ARCH}'; accepted: arm64, armhf")
endif()

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${lamella_processor_${LAMELLA_ARCH}})
set(CMAKE_LIBRARY_ARCHITECTURE ${lamella_triplet})
set(CMAKE_INSTALL_LIBDIR lib/${lamella_triplet} CACHE PATH "Where Debian keeps libraries of this architecture")
set(CMAKE_C_COMPILER ${lamella_triplet}-gcc)
set(CMAKE_CXX_COMPILER ${lamella_triplet}-g++)
set(CMAKE_SYSROOT ${LAMELLA_SYSROOT})
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)  # GCC notes that old versions passed some arguments otherwise
set(CMAKE_CROSSCOMPILING_EMULATOR ${lamella_emulator_${LAMELLA_ARCH}};-L;${CMAKE_SYSROOT})

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/${lamella_triplet}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)

# Libraries of libraries lie in the sysroot, too; those that Debian's alternatives choose have no link there.
set(lamella_link_flags "-Wl,-rpath-link,${CMAKE_SYSROOT}/usr/lib/${lamella_triplet}/blas")
string(APPEND lamella_link_flags " -Wl,-rpath-link,${CMAKE_SYSROOT}/usr/lib/${lamella_triplet}/lapack")
set(CMAKE_EXE_LINKER_FLAGS_INIT ${lamella_link_flags})
