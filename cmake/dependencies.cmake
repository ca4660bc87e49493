# SPDX-License-Identifier: Apache-2.0
# Packages of Debian 12 and 13; tools/dependencies.txt names them for installation.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED)
if(Boost_VERSION VERSION_LESS 1.81)
  # Asio of Boost 1.74 (Debian 12) does not include <utility>, which it needs, and takes clang for a compiler without coroutines.
  add_compile_options("SHELL:-include utility")
  add_compile_definitions(BOOST_ASIO_HAS_CO_AWAIT BOOST_ASIO_HAS_STD_COROUTINE)
endif()
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(Eigen3 REQUIRED)
pkg_check_modules(serialport REQUIRED IMPORTED_TARGET libserialport)
pkg_check_modules(gpiod REQUIRED IMPORTED_TARGET libgpiod)
# Linked into the programs: of the shared one navcald needs two functions, and it takes 0.2 MB of its memory.
find_library(NAVCAL_NETTLE libnettle.a REQUIRED)
pkg_check_modules(netcdf REQUIRED IMPORTED_TARGET netcdf)
pkg_check_modules(matio REQUIRED IMPORTED_TARGET matio)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
