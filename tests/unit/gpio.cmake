# SPDX-License-Identifier: Apache-2.0
telehug_test(test_gpio KIND unit SUBJECT jacket
  SOURCES unit/gpio/emergency_stop_test.cpp unit/gpio/jacket_situation_test.cpp unit/gpio/panel_test.cpp
          unit/gpio/simulated_chip_test.cpp
  DEPS passive_gpio)

# The code for each version of libgpiod, over a fake of that version's functions in place of the library.
function(gpiod_test version)
  telehug_test(test_gpiod_v${version} KIND unit SUBJECT jacket
    SOURCES unit/gpio/gpiod_chip_test.cpp doubles/fake_gpiod_v${version}.cpp
            ${PROJECT_SOURCE_DIR}/passive_side/gpio/gpiod_chip_v${version}.cpp
            ${PROJECT_SOURCE_DIR}/passive_side/gpio/gpio_error.cpp
    DEPS telehug_common fmt::fmt)
  target_include_directories(test_gpiod_v${version} PRIVATE ${CMAKE_BINARY_DIR}/rooms/passive_gpio)
endfunction()
gpiod_test(2)
if(gpiod_VERSION VERSION_LESS 2)
  target_include_directories(test_gpiod_v2 BEFORE PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/doubles/gpiod2)
  gpiod_test(1)
endif()
