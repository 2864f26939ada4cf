# SPDX-License-Identifier: Apache-2.0
# Everything telehug is built from, as Debian 12 packages it (deploy/setup installs the packages).

find_package(Threads REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PkgConfig REQUIRED)
pkg_check_modules(libsystemd REQUIRED IMPORTED_TARGET libsystemd)
pkg_check_modules(gpiod REQUIRED IMPORTED_TARGET libgpiod)  # 1.6 or 2
pkg_check_modules(libevdev REQUIRED IMPORTED_TARGET libevdev)
pkg_check_modules(liblo REQUIRED IMPORTED_TARGET liblo)
pkg_check_modules(libjpeg REQUIRED IMPORTED_TARGET libjpeg)
pkg_check_modules(xcb REQUIRED IMPORTED_TARGET xcb xcb-shm xcb-damage xcb-xfixes xcb-randr xcb-composite xcb-shape
  xcb-keysyms)
pkg_check_modules(pipewire REQUIRED IMPORTED_TARGET libpipewire-0.3)
pkg_check_modules(sdbus REQUIRED IMPORTED_TARGET sdbus-c++)
pkg_check_modules(libpng REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(libqrencode REQUIRED IMPORTED_TARGET libqrencode)

find_library(XNNPACK_LIBRARY XNNPACK REQUIRED)
add_library(xnnpack::xnnpack UNKNOWN IMPORTED GLOBAL)
set_target_properties(xnnpack::xnnpack PROPERTIES IMPORTED_LOCATION ${XNNPACK_LIBRARY})

# OpenCV part by part: the package with the complete CMake description pulls in 40 packages more that nothing here uses.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(part core imgproc objdetect dnn)
  find_library(OPENCV_${part}_LIBRARY opencv_${part} REQUIRED)
  add_library(opencv::${part} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(opencv::${part} PROPERTIES IMPORTED_LOCATION ${OPENCV_${part}_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE_DIR})
endforeach()
# Its headers step backwards by adding a large unsigned offset, which clang's sanitizer takes for a fault.
target_compile_options(opencv::core INTERFACE
  $<$<AND:$<BOOL:${TELEHUG_SANITIZER}>,$<CXX_COMPILER_ID:Clang>>:-fno-sanitize=pointer-overflow>)
target_link_libraries(opencv::imgproc INTERFACE opencv::core)
target_link_libraries(opencv::objdetect INTERFACE opencv::imgproc)
target_link_libraries(opencv::dnn INTERFACE opencv::imgproc)
